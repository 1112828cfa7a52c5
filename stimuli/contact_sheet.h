#pragma once

#include "image/image.h"
#include "protocols/reader/manifest.h"

#include <vector>

namespace obscura {

// All pairs, a row each, on as many pages as that takes: both images, both visibility buffers, and
// the absolute difference of the images' code values, times four. Reads the files that the manifest
// names.
std::vector<Image8> contactSheets(const Manifest& manifest);

} // namespace obscura
