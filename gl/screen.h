#pragma once

#include "gl/object.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace obscura::gl {

// The back buffer of the window whose context is current.

// From now on it is drawn into, all of its width x height pixels, which get this colour.
void clearScreen(int width, int height, std::array<float, 3> colour);

// Its code values: red, green and blue, rows from the bottom.
std::vector<std::uint8_t> readScreen(int width, int height);

// A texture to be shown, made of RGBA rows from the bottom.
Texture uploaded(int width, int height, std::span<const std::byte> rgba);

} // namespace obscura::gl
