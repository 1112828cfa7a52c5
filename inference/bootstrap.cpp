#include "inference/bootstrap.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/percentile.h"
#include "base/random.h"

#include "inference/link.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

using Figures = std::optional<Eigen::VectorXd>;

std::vector<int> drawn(int observers, std::uint64_t seed, int sample) {
    Random random(seed, fmt::format("bootstrap/{}", sample));
    std::vector<int> times(static_cast<std::size_t>(observers));
    for (int draw = 0; draw < observers; ++draw)
        ++times[random.below(static_cast<std::uint32_t>(observers))];
    return times;
}

std::vector<Figures> resample(int observers, const Resampled& statistic,
                              const BootstrapSettings& settings) {
    std::vector<Figures> results(static_cast<std::size_t>(settings.samples));
    forEachInParallel(
        settings.samples,
        [&](int sample) {
            results[static_cast<std::size_t>(sample)] =
                statistic(drawn(observers, settings.seed, sample));
        },
        {}, settings.threads);
    return results;
}

std::vector<Figures> jackknife(int observers, const Resampled& statistic, int threads) {
    std::vector<Figures> results(static_cast<std::size_t>(observers));
    forEachInParallel(
        observers,
        [&](int left) {
            std::vector<int> times(static_cast<std::size_t>(observers), 1);
            times[static_cast<std::size_t>(left)] = 0;
            results[static_cast<std::size_t>(left)] = statistic(times);
        },
        {}, threads);
    return results;
}

std::vector<double> column(const std::vector<Figures>& samples, Eigen::Index figure) {
    std::vector<double> values;
    for (const Figures& sample : samples)
        if (sample)
            values.push_back((*sample)(figure));
    return values;
}

// Efron and Tibshirani, equation 14.15: the skewness of the jackknife's values over 6.
double acceleration(const std::vector<double>& left) {
    double mean = 0, squares = 0, cubes = 0;
    for (const double value : left)
        mean += value / static_cast<double>(left.size());
    for (const double value : left) {
        squares += (mean - value) * (mean - value);
        cubes += std::pow(mean - value, 3);
    }
    return squares > 0 ? cubes / (6 * std::pow(squares, 1.5)) : 0;
}

// Equations 14.9 to 14.14. A value that equals the estimate counts half below it, so that discrete
// statistics are not pushed aside; the share stays within what so many samples can show.
Interval bcaInterval(const std::vector<double>& samples, double estimate,
                     const std::vector<double>& left, double tail) {
    double below = 0;
    for (const double value : samples)
        below += value < estimate ? 1 : value == estimate ? 0.5 : 0;
    const auto count = static_cast<double>(samples.size());
    const double bias =
        quantile(Link::probit, std::clamp(below / count, 0.5 / count, 1 - 0.5 / count));
    const double skew = acceleration(left);
    const auto limit = [&](double share) {
        const double z = bias + quantile(Link::probit, share);
        const double scale = 1 - skew * z;
        // Beyond the pole the transformation has no meaning; its limit is the outermost sample.
        const double corrected =
            scale > 0 ? distribution(Link::probit, bias + z / scale).below : (z > 0 ? 1.0 : 0.0);
        return percentile(samples, corrected);
    };
    return {limit(tail), limit(1 - tail)};
}

double deviation(const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (const double value : values)
        mean += value / static_cast<double>(values.size());
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

void check(int observers, const BootstrapSettings& settings) {
    if (observers < 2)
        throw Error(fmt::format("expected at least 2 observers to draw from, found {}", observers));
    if (settings.samples < 100)
        throw Error(
            fmt::format("expected at least 100 bootstrap samples, found {}", settings.samples));
    if (!(settings.confidence >= 0.5 && settings.confidence <= 0.999))
        throw Error(
            fmt::format("expected a confidence from 0.5 to 0.999, found {}", settings.confidence));
}

} // namespace

std::optional<Bootstrap> bootstrap(int observers, const Resampled& statistic,
                                   const BootstrapSettings& settings) {
    check(observers, settings);
    const Figures estimate = statistic(std::vector<int>(static_cast<std::size_t>(observers), 1));
    if (!estimate)
        return std::nullopt;
    const auto samples = resample(observers, statistic, settings);
    const auto failed = std::count(samples.begin(), samples.end(), std::nullopt);
    if (failed * 100 > settings.samples)
        return std::nullopt;
    const auto left = jackknife(observers, statistic, settings.threads);
    const bool hasBca = std::count(left.begin(), left.end(), std::nullopt) == 0;

    Bootstrap result;
    result.estimate = *estimate;
    result.standardErrors.resize(estimate->size());
    result.failed = static_cast<int>(failed);
    if (hasBca)
        result.bca.emplace();
    const double tail = (1 - settings.confidence) / 2;
    for (Eigen::Index figure = 0; figure < estimate->size(); ++figure) {
        const std::vector<double> values = column(samples, figure);
        result.standardErrors(figure) = deviation(values);
        result.percentile.push_back({percentile(values, tail), percentile(values, 1 - tail)});
        if (hasBca)
            result.bca->push_back(
                bcaInterval(values, (*estimate)(figure), column(left, figure), tail));
    }
    return result;
}

Wins pooled(std::span<const Wins> observers, std::span<const int> times) {
    if (observers.empty() || observers.size() != times.size())
        throw Error(fmt::format("expected a number of times for each of at least one observer, "
                                "found {} for {}",
                                times.size(), observers.size()));
    Wins sum = Wins::Zero(observers.front().rows(), observers.front().cols());
    for (std::size_t observer = 0; observer < observers.size(); ++observer) {
        if (observers[observer].rows() != sum.rows() || observers[observer].cols() != sum.cols())
            throw Error("expected wins of the same items from all observers, found others");
        sum += times[observer] * observers[observer];
    }
    return sum;
}

} // namespace obscura
