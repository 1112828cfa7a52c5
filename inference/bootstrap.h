#pragma once

#include "inference/result.h"
#include "inference/scales.h"
#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace obscura {

// Any statistics of a sample in which observer o counts times[o] times; absent where they do not
// exist for it. Called from several threads at once, it must not throw, and gives as many figures
// each time, all finite.
using Resampled = std::function<std::optional<Eigen::VectorXd>(std::span<const int> times)>;

struct BootstrapSettings {
    int samples = 2000;       // >= 100
    double confidence = 0.95; // 0.5 to 0.999
    std::uint64_t seed = 1;
    int threads = 0; // 0: one for each core; the result is the same
};

struct Bootstrap {
    Eigen::VectorXd estimate;       // of the observers as they are
    Eigen::VectorXd standardErrors; // standard deviations over the samples
    std::vector<Interval> percentile;
    // Bias-corrected and accelerated; absent where leaving out one observer leaves no statistic.
    std::optional<std::vector<Interval>> bca;
    int failed = 0; // samples without the statistic; the others are reported
};

// Draws observers with replacement, all answers of one together, which no assumption about their
// dependence needs: Efron and Tibshirani, An Introduction to the Bootstrap, 1993, chapters 13
// (percentile) and 14 (BCa, with the jackknife's acceleration). Quantiles are of type 7. Sample s
// depends on the seed and s alone. Absent where the statistic does not exist for the observers as
// they are, or failed for more than 1 % of the samples: their values lie beyond any limit, and
// intervals that pass over them would be too narrow (use a prior, or say that it is unbounded).
// Needs at least 2 observers.
std::optional<Bootstrap> bootstrap(int observers, const Resampled& statistic,
                                   const BootstrapSettings& settings = {});

// Sum of the observers' wins, each so many times.
Wins pooled(std::span<const Wins> observers, std::span<const int> times);

} // namespace obscura
