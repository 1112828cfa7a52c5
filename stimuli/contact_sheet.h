#pragma once

#include "protocols/manifest.h"
#include "renderer/image.h"

namespace obscura {

// All pairs on one page, a row each: both images, both visibility buffers, and the absolute
// difference of the images' code values, times four. Reads the files that the manifest names.
Image8 contactSheet(const Manifest& manifest);

} // namespace obscura
