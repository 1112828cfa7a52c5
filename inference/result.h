#pragma once

#include <optional>

namespace obscura {

// What statistics give. No value is ever NaN or infinite: what does not exist is absent.

struct Estimate {
    double value = 0, standardError = 0; // the standard error in the units of the value
};

struct Interval {
    double low = 0, high = 1;
};

// A statistic without degrees of freedom is an exact count or a normal deviate; a test without a
// statistic has only its p, 0 to 1.
struct Test {
    std::optional<double> statistic, df;
    double p = 1;
};

} // namespace obscura
