#include "inference/counts.h"

#include "base/error.h"

#include "inference/tails.h"
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace obscura {

namespace {

double totalOf(Votes votes) {
    requireVotes(votes);
    return static_cast<double>(votes.total());
}

double shareOfB(Votes votes) { return static_cast<double>(votes.b) / totalOf(votes); }

// In long double, for at a thousand million votes the terms cancel to a ten thousand millionth.
long double logBeta(long double a, long double b) {
    using boost::math::lgamma;
    return lgamma(a) + lgamma(b) - lgamma(a + b);
}

// Wilson's, at the normal deviate z.
Interval scoreInterval(std::int64_t successes, std::int64_t trials, double z) {
    const double n = totalOf({trials - successes, successes});
    const double share = static_cast<double>(successes) / n, z2 = z * z;
    const double scale = 1 / (1 + z2 / n);
    const double centre = scale * (share + z2 / (2 * n));
    const double reach = scale * z * std::sqrt(share * (1 - share) / n + z2 / (4 * n * n));
    // Without successes, or without failures, one end is exactly 0 or 1; rounding would miss it.
    return {successes == 0 ? 0 : centre - reach, successes == trials ? 1 : centre + reach};
}

} // namespace

void requireVotes(Votes votes) {
    if (votes.a < 0 || votes.b < 0 || votes.total() == 0)
        throw Error(fmt::format("expected at least one vote, and none negative; found {} and {}",
                                votes.a, votes.b));
}

double chiSquare(Votes votes) {
    const auto difference = static_cast<double>(votes.a - votes.b);
    return difference * difference / totalOf(votes);
}

double chiSquareYates(Votes votes) {
    const auto difference =
        static_cast<double>(std::max<std::int64_t>(std::abs(votes.a - votes.b) - 1, 0));
    return difference * difference / totalOf(votes);
}

double exactP(Votes votes) {
    requireVotes(votes);
    return std::min(1.0, 2 * binomialLower(std::min(votes.a, votes.b), votes.total(), 0.5));
}

double midP(Votes votes) {
    requireVotes(votes);
    if (votes.a == votes.b)
        return 1;
    const std::int64_t fewer = std::min(votes.a, votes.b);
    return 2 * binomialLower(fewer, votes.total(), 0.5) - binomialMass(fewer, votes.total(), 0.5);
}

Interval wilson(std::int64_t successes, std::int64_t trials, double confidence) {
    return scoreInterval(successes, trials, probit((1 + confidence) / 2));
}

Interval clopperPearson(std::int64_t successes, std::int64_t trials, double confidence) {
    requireVotes({trials - successes, successes});
    const auto k = static_cast<double>(successes), rest = static_cast<double>(trials - successes);
    const double tail = (1 - confidence) / 2;
    using boost::math::ibeta_inv, boost::math::ibetac_inv;
    return {successes == 0 ? 0 : ibeta_inv(k, rest + 1, tail),
            successes == trials ? 1 : ibetac_inv(k + 1, rest, tail)};
}

Interval jeffreys(std::int64_t successes, std::int64_t trials, double confidence) {
    requireVotes({trials - successes, successes});
    const double k = static_cast<double>(successes) + 0.5;
    const double rest = static_cast<double>(trials - successes) + 0.5;
    const double tail = (1 - confidence) / 2;
    return {boost::math::ibeta_inv(k, rest, tail), boost::math::ibetac_inv(k, rest, tail)};
}

std::optional<EstimatedShare> balancedShare(Votes bFirst, Votes bSecond, double confidence) {
    if (bFirst.total() == 0 || bSecond.total() == 0)
        return std::nullopt;
    const double p = shareOfB(bFirst), q = shareOfB(bSecond), mean = (p + q) / 2;
    const auto intervalAt = [&](double z) {
        const Interval ofP = scoreInterval(bFirst.b, bFirst.total(), z);
        const Interval ofQ = scoreInterval(bSecond.b, bSecond.total(), z);
        return Interval{mean - std::hypot(p - ofP.low, q - ofQ.low) / 2,
                        mean + std::hypot(ofP.high - p, ofQ.high - q) / 2};
    };
    double low = 0,
           high = 40; // deviates: one half is outside of the interval at low, inside at high
    for (int i = 0; i < 60 && mean != 0.5; ++i) {
        const double middle = (low + high) / 2;
        const Interval interval = intervalAt(middle);
        (interval.low > 0.5 || interval.high < 0.5 ? low : high) = middle;
    }
    return EstimatedShare{mean, intervalAt(probit((1 + confidence) / 2)), normalP(low)};
}

double cohenG(Votes votes) { return shareOfB(votes) - 0.5; }

// 2 asin sqrt(p) - pi/2 = asin(2p - 1), which is exactly 0 for an even split.
double cohenH(Votes votes) { return std::asin(2 * shareOfB(votes) - 1); }

double cohenW(Votes votes) { return std::sqrt(chiSquare(votes) / totalOf(votes)); }

std::optional<double> jod(Votes votes) {
    if (votes.a == 0 || votes.b == 0)
        return std::nullopt;
    return probit(shareOfB(votes)) / probit(0.75);
}

JodLimits jodLimits(Interval shares) {
    const auto limit = [](double share) {
        return share > 0 && share < 1 ? std::optional(probit(share) / probit(0.75)) : std::nullopt;
    };
    return {limit(shares.low), limit(shares.high)};
}

double logBayesFactor(Votes votes, double prior) {
    assert(prior > 0);
    const long double a = votes.a, b = votes.b;
    return static_cast<double>(logBeta(b + prior, a + prior) - logBeta(prior, prior) +
                               (a + b) * std::numbers::ln2_v<long double>);
}

// On the side of the mode where the region lies, so that a small probability keeps its digits.
double ropeProbability(Votes votes, double margin, double prior) {
    assert(margin >= 0 && margin <= 0.5 && prior > 0);
    const double b = static_cast<double>(votes.b) + prior;
    const double a = static_cast<double>(votes.a) + prior;
    const double low = 0.5 - margin, high = 0.5 + margin;
    using boost::math::ibeta, boost::math::ibetac;
    return b < a ? ibetac(b, a, low) - ibetac(b, a, high) : ibeta(b, a, high) - ibeta(b, a, low);
}

double probabilityOfMajority(Votes votes, double prior) {
    assert(prior > 0);
    return boost::math::ibetac(static_cast<double>(votes.b) + prior,
                               static_cast<double>(votes.a) + prior, 0.5);
}

} // namespace obscura
