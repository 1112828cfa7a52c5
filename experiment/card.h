#pragma once

#include "gl/window.h"

#include <filesystem>

namespace obscura {

// ISO/IEC 7810, ID-1: bank cards, driving licences.
constexpr double cardWidthMm = 85.60, cardHeightMm = 53.98;

// Shows a rectangle that arrow keys and the mouse make as large as such a card held to the screen,
// and keeps how many pixels a millimetre has, in the data folder's screen file. False when Escape
// ended it before.
bool measureCard(const gl::WindowOptions& window, const std::filesystem::path& data);

} // namespace obscura
