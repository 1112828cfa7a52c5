#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace obscura {

struct NamedNumber {
    std::string name;
    double value = 0;
};

// NAME=NUMBER as every program's arguments have it: a name, and a finite number that is all of the
// rest. Nothing when it is anything else ("blur=yes", "angleBias=10abc", "=1", "radius=nan").
std::optional<NamedNumber> readNamedNumber(std::string_view text);

} // namespace obscura
