#pragma once

#include "inference/result.h"

#include <optional>
#include <span>

namespace obscura {

// How closely two measures of the same things go together, -1 to 1. The interval takes the things
// for independent.
struct Correlation {
    double value = 0;
    std::optional<Interval> interval; // absent for fewer than 4 things, and at -1 and 1
    int things = 0;
};

// Pearson's, of straight lines, with Fisher's z interval, standard error 1 / sqrt(n - 3) (R's
// cor.test). Absent for fewer than 3 things, or where one measure is the same for all. An Error
// unless both have as many values, all finite.
std::optional<Correlation> pearson(std::span<const double> x, std::span<const double> y,
                                   double confidence = 0.95);

// Spearman's, of ranks, equal values sharing theirs. The interval has the standard error of Bonett
// and Wright, Psychometrika 65 (2000) 23: sqrt((1 + r^2 / 2) / (n - 3)) of z. The rest as for
// pearson().
std::optional<Correlation> spearman(std::span<const double> x, std::span<const double> y,
                                    double confidence = 0.95);

} // namespace obscura
