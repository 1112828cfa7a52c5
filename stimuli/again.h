#pragma once

#include "protocols/reader/manifest.h"
#include "renderer/render.h"

#include <string>
#include <vector>

namespace obscura {

// Images of a manifest made again, and held against their files.

// Of two recipes, what may differ and leave the image as it is: our code, shaders, the program's
// version. The pixels decide.
bool decidedByPixels(const std::string& difference);

// A file of an image whose pixels are not those of the rendering. Colours and visibility of 8 bits
// count as 0 ... 1.
struct OtherPixels {
    FileRecord file;
    double rms = 0, largest = 0; // of the difference; infinite where the sizes differ
};

// Of the image that was rendered and of its layers; none where all are the same.
std::vector<OtherPixels> otherPixels(const Manifest& manifest, const ImageRecord& record,
                                     const Rendering& now);

} // namespace obscura
