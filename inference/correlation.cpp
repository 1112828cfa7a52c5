#include "inference/correlation.h"

#include "base/error.h"

#include "inference/ranks.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace obscura {

namespace {

double meanOf(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void check(std::span<const double> x, std::span<const double> y) {
    const auto finite = [](double value) { return std::isfinite(value); };
    if (x.size() != y.size() || !std::all_of(x.begin(), x.end(), finite) ||
        !std::all_of(y.begin(), y.end(), finite))
        throw Error(fmt::format("expected two measures of the same things, all finite; got {} "
                                "values and {}",
                                x.size(), y.size()));
}

std::optional<double> straight(std::span<const double> x, std::span<const double> y) {
    if (x.size() < 3)
        return std::nullopt;
    const double meanX = meanOf(x), meanY = meanOf(y);
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - meanX) * (x[i] - meanX);
        yy += (y[i] - meanY) * (y[i] - meanY);
        xy += (x[i] - meanX) * (y[i] - meanY);
    }
    if (!(xx > 0) || !(yy > 0))
        return std::nullopt;
    return std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
}

// `variance`: of z, times n - 3.
Correlation withInterval(double r, std::size_t things, double variance, double confidence) {
    Correlation result{r, {}, static_cast<int>(things)};
    if (things < 4 || std::abs(r) >= 1)
        return result;
    const double reach =
        probit(0.5 + confidence / 2) * std::sqrt(variance / (static_cast<double>(things) - 3));
    result.interval = {std::tanh(std::atanh(r) - reach), std::tanh(std::atanh(r) + reach)};
    return result;
}

} // namespace

std::optional<Correlation> pearson(std::span<const double> x, std::span<const double> y,
                                   double confidence) {
    check(x, y);
    const auto r = straight(x, y);
    return r ? std::optional(withInterval(*r, x.size(), 1, confidence)) : std::nullopt;
}

std::optional<Correlation> spearman(std::span<const double> x, std::span<const double> y,
                                    double confidence) {
    check(x, y);
    const auto r = straight(rank(x).ranks, rank(y).ranks);
    return r ? std::optional(withInterval(*r, x.size(), 1 + *r * *r / 2, confidence))
             : std::nullopt;
}

} // namespace obscura
