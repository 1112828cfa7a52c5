#include "report/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

std::string readable(double value, int digits) {
    if (std::isnan(value))
        return "–";
    if (std::isinf(value))
        return value < 0 ? "−∞" : "∞";
    const std::string shortest = fmt::format("{:.{}e}", std::abs(value), digits - 1);
    const int magnitude = value == 0 ? 0 : std::stoi(shortest.substr(shortest.find('e') + 1));
    const std::string text =
        fmt::format("{:.{}f}", std::abs(value), std::max(digits - 1 - magnitude, 0));
    return value < 0 ? "−" + text : text;
}

} // namespace obscura
