#pragma once

#include "renderer/techniques/points.h"
#include "renderer/techniques/settings.h"

#include <algorithm>
#include <cmath>

// Parts that rows of the technique table share (technique.h says what the common parameters do).
namespace obscura::rows {

using gl::Format;

constexpr Parameter radius{"radius",
                           Unit::metre,
                           "how far occluders are looked for",
                           0.5f,
                           1e-4f,
                           1e4f,
                           "ours: the step of a stair; a study sets it for each scene"};

constexpr Parameter radiusMultiplier(float value = 1, std::string_view source = "neutral") {
    return {"radiusMultiplier",
            Unit::ratio,
            "factor on the radius, for methods of unlike reach to be matched by",
            value,
            0.05f,
            20,
            source};
}

constexpr Parameter intensity(float value = 1, std::string_view source = "neutral") {
    return {"intensity", Unit::ratio, "factor on occlusion", value, 0, 100, source};
}

constexpr Parameter power(float value = 1, std::string_view source = "neutral") {
    return {"power",
            Unit::ratio,
            "exponent of visibility; below 0, of 1 plus occlusion, which darkens ever less and "
            "never to black",
            value,
            -64,
            64,
            source};
}

constexpr Parameter downscale{
    "downscale",
    Unit::count,
    "1: works on every pixel; n: on every nth across and down, and is spread back over the rest",
    1,
    1,
    4,
    "the paper, whose passes are all of one size"};

constexpr Parameter guardBand(float value, std::string_view source) {
    return {"guardBand",
            Unit::ratio,
            "share of the image's height that is rendered beyond each border for taps to find",
            value,
            0,
            0.5f,
            source};
}

constexpr Parameter accumulate{
    "accumulate",
    Unit::count,
    "1: each frame stands alone; n: the mean of up to n frames whose noise differs, carried along "
    "with what they show (temporal accumulation)",
    1,
    1,
    64,
    "ours: a single frame is what papers measure"};

constexpr Parameter samples(float value, std::string_view source,
                            std::string_view meaning = "points tested per pixel") {
    return {"samples", Unit::count, meaning, value, 1, 16384, source};
}

constexpr Parameter blur{"blur",
                         Unit::flag,
                         "edge-aware blur over the 4 x 4 noise tile",
                         1,
                         0,
                         1,
                         "Jakobsen 2010, section 4.3.1.1"};

// Texture fetches of shader files (technique.h) where all of their taps lie in the image.

constexpr Fetches one = [](const Settings&) { return 1.0; };
// Fetches depth and normal of the pixel, and depth of each sample.
constexpr Fetches surfaceAndSamples = [](const Settings& s) { return 2.0 + s["samples"]; };
// blur.glsl fetches depths and values of the window's four quads.
constexpr Fetches depthBlur = [](const Settings&) { return 4.0 * 2; };
// blur_normal.glsl fetches besides the normals of the pixel and of each pixel in the window.
constexpr Fetches normalBlur = [](const Settings&) { return 4.0 * 2 + 1 + 16; };
constexpr Fetches boxBlur = [](const Settings&) { return 1.0 + 16; };

constexpr std::array<Pass, 2> gatherAndBlur(Fetches gather, Fetches blurTile) {
    return {{{.name = "gather", .format = Format::r16f, .fetches = gather},
             {.name = "blurTile",
              .format = Format::r16f,
              .enabledBy = "blur",
              .work = Work::filter,
              .fetches = blurTile}}};
}
// crytek.glsl takes whole cubes of eight samples, and no normals.
constexpr auto crytekPasses = gatherAndBlur(
    [](const Settings& s) { return 1 + 8 * std::max(std::floor(s["samples"] / 8.0), 1.0); },
    depthBlur);
constexpr auto surfaceGatherAndBlur = gatherAndBlur(surfaceAndSamples, normalBlur);

} // namespace obscura::rows
