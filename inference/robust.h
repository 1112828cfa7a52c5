#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace obscura {

// Summaries of response times and the like, of which a few may be wild. Values that are NaN or
// infinite are an Error in all of them. The unit is that of the values, ms for FlagRule::fast.

struct Summary {
    std::size_t count = 0;
    double mean = 0;
    std::optional<double> sd; // of the sample (n - 1); absent for one value
    double median = 0;
    double mad = 0; // 1.4826 x the median distance from the median (R's mad): sd of a normal
    std::optional<double> geometricMean; // absent unless all values are positive
    double trimmedMean = 0; // without the lowest and the highest tenth (R's mean(trim = .1))
};

// Absent without values.
std::optional<Summary> summary(std::span<const double> values);

// Quantiles at shares 0 to 1, Hyndman and Fan's type 7 as R has it; none without values.
std::vector<double> quantiles(std::span<const double> values, std::span<const double> shares);

// What is to be looked at. A flag never deletes: show results with and without. On the log scale a
// value that is not positive is flagged, and is no part of centre and spread.
enum class FlagRule {
    fast,   // below 200
    sd,     // more than 3 sd from the mean
    sdLog,  // the same of logarithms
    mad,    // more than 2.5 mad from the median (Leys et al., J. Exp. Soc. Psychol. 49 (2013) 764)
    madLog, // the same of logarithms; the one to prefer for response times
    tukey   // more than 1.5 interquartile ranges outside of the quartiles (type 7)
};

// For each value whether the rule flags it.
std::vector<bool> flags(std::span<const double> values, FlagRule rule);

} // namespace obscura
