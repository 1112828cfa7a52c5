#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace obscura::gl {

// The back buffer of the window whose context is current.

// From now on it is drawn into, all of its width x height pixels, which get this colour.
void clearScreen(int width, int height, std::array<float, 3> colour);

// Its code values: red, green and blue, rows from the bottom.
std::vector<std::uint8_t> readScreen(int width, int height);

} // namespace obscura::gl
