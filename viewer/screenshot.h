#pragma once

#include "image/image.h"
#include "renderer/techniques/settings.h"
#include "viewer/picture.h"

#include <filesystem>
#include <string>

namespace obscura {

// A file name without extension that tells what a picture shows: scene and camera (sceneName()),
// technique and what its settings differ in, what is shown of it unless that is the lit picture:
// "sponza-nave_gtao-high_slices-6_occlusion".
std::string screenshotName(const View& view, const Settings& settings, Show show);

struct Screenshot {
    std::filesystem::path png; // as shown, sRGB
    std::filesystem::path exr; // visibility, linear, half floats in channel V; "" without
};

// Writes NAME.png and, where there is visibility, NAME-visibility.exr; NAME-2 and so on where
// either is there already: no file is ever replaced.
Screenshot writeScreenshot(const std::filesystem::path& folder, const std::string& name,
                           const Image8& shown, const Image& visibility = {});

} // namespace obscura
