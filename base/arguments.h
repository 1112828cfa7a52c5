#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace obscura {

// What the arguments of several programs look like.

// NAME=NUMBER: a name, and a finite number that is all of the rest. Anything else ("blur=yes",
// "angleBias=10abc", "=1", "radius=nan") is an Error that gives what stands there, `option` before
// it, and of `names` (when there are any) the nearest to a name that is none of them.
struct NamedNumber {
    std::string name;
    double value = 0;
};
NamedNumber parseNamedNumber(std::string_view option, std::string_view text,
                             std::span<const std::string> names = {});

// Two whole numbers of at least 1 and nothing else, such as the 1280 and 800 of "1280x800".
std::optional<std::pair<int, int>> parsePair(std::string_view text, char separator);

// For CLI11's check(): "" for a number from `low` to `high`, else what was expected and found.
// (CLI11's own range takes NaN for one.)
std::function<std::string(const std::string&)> numberFrom(double low, double high);

} // namespace obscura
