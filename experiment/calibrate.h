#pragma once

#include "gl/window.h"

#include <filesystem>

namespace obscura {

// Measures a screen's curve, first by eye (a patch is made as bright as a field of black and bright
// lines, for grey and each channel), then with a photometer (greys that fill the screen, their
// readings typed), and keeps it in the data folder's screen file. False when Escape ended it
// before.
bool calibrate(const gl::WindowOptions& window, const std::filesystem::path& data);

} // namespace obscura
