#include "inference/sums.h"

#include "base/error.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <numeric>

namespace obscura {

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sumOfSquares(std::span<const double> values, double centre) {
    return std::accumulate(values.begin(), values.end(), 0.0, [&](double sum, double value) {
        return sum + (value - centre) * (value - centre);
    });
}

void checkFinite(std::span<const double> values) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            throw Error(
                fmt::format("expected finite numbers, found {} as number {}; leave out what "
                            "was not measured",
                            values[i], i + 1));
}

} // namespace obscura
