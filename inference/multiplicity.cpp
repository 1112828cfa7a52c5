#include "inference/multiplicity.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace obscura {

namespace {

std::vector<std::size_t> ascending(std::span<const double> p) {
    for (std::size_t i = 0; i < p.size(); ++i)
        if (!(p[i] >= 0 && p[i] <= 1))
            throw Error(fmt::format("expected p values from 0 to 1, found {} as number {}; a test "
                                    "that could not be made has no place in a family",
                                    p[i], i + 1));
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t one, std::size_t other) { return p[one] < p[other]; });
    return order;
}

} // namespace

std::vector<double> holm(std::span<const double> p) {
    const std::vector<std::size_t> order = ascending(p);
    std::vector<double> adjusted(p.size());
    double running = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        running = std::max(running, p[order[i]] * static_cast<double>(order.size() - i));
        adjusted[order[i]] = std::min(running, 1.0);
    }
    return adjusted;
}

std::vector<double> benjaminiHochberg(std::span<const double> p) {
    const std::vector<std::size_t> order = ascending(p);
    std::vector<double> adjusted(p.size());
    const auto m = static_cast<double>(p.size());
    double running = 1;
    for (std::size_t i = order.size(); i-- > 0;) {
        running = std::min(running, p[order[i]] * m / static_cast<double>(i + 1));
        adjusted[order[i]] = running;
    }
    return adjusted;
}

} // namespace obscura
