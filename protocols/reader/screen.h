#pragma once

#include <array>
#include <optional>

namespace obscura {

class TomlTable;

// From where a study is to be seen, and how large it must then be: [screen]. A session that does
// not meet it is refused; images are never scaled to meet it.
struct ScreenNeeds {
    double distanceCm = 0;                                // from eye to screen; 0: not said
    std::optional<std::array<double, 2>> degrees;         // of an image, across and down
    std::optional<std::array<double, 2>> pixelsPerDegree; // at least and at most
};

ScreenNeeds parseScreenNeeds(TomlTable table);

} // namespace obscura
