#include "inference/counts.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace obscura {

namespace {

double shareOfB(Votes votes) {
    assert(votes.a >= 0 && votes.b >= 0 && votes.total() > 0);
    return static_cast<double>(votes.b) / votes.total();
}

double probit(double probability) {
    return boost::math::quantile(boost::math::normal{}, probability);
}

} // namespace

double chiSquare(Votes votes) {
    const double difference = votes.a - votes.b;
    return difference * difference / votes.total();
}

double chiSquareP(double statistic) {
    return boost::math::cdf(boost::math::complement(boost::math::chi_squared(1), statistic));
}

double exactP(Votes votes) {
    const boost::math::binomial guessing(votes.total(), 0.5);
    return std::min(1.0, 2 * boost::math::cdf(guessing, std::min(votes.a, votes.b)));
}

Interval wilson(std::int64_t successes, std::int64_t trials) {
    assert(successes >= 0 && successes <= trials && trials > 0);
    const double n = trials, share = successes / n;
    const double z = probit(0.975), z2 = z * z;
    const double scale = 1 / (1 + z2 / n);
    const double centre = scale * (share + z2 / (2 * n));
    const double reach = scale * z * std::sqrt(share * (1 - share) / n + z2 / (4 * n * n));
    // Without successes, or without failures, one end is exactly 0 or 1; rounding would miss it.
    return {successes == 0 ? 0 : centre - reach, successes == trials ? 1 : centre + reach};
}

double cohenG(Votes votes) { return shareOfB(votes) - 0.5; }

// 2 asin sqrt(p) - pi/2 = asin(2p - 1), which is exactly 0 for an even split.
double cohenH(Votes votes) { return std::asin(2 * shareOfB(votes) - 1); }

double cohenW(Votes votes) { return std::sqrt(chiSquare(votes) / votes.total()); }

std::optional<double> jod(Votes votes) {
    if (votes.a == 0 || votes.b == 0)
        return std::nullopt;
    return probit(shareOfB(votes)) / probit(0.75);
}

std::optional<Frequencies> frequencies(Votes votes) {
    if (votes.total() == 0)
        return std::nullopt;
    const double statistic = chiSquare(votes);
    return Frequencies{.share = shareOfB(votes),
                       .wilson = wilson(votes.b, votes.total()),
                       .chiSquare = statistic,
                       .chiSquareP = chiSquareP(statistic),
                       .exactP = exactP(votes),
                       .g = cohenG(votes),
                       .h = cohenH(votes),
                       .w = cohenW(votes),
                       .jod = jod(votes)};
}

} // namespace obscura
