#pragma once

#include "renderer/techniques/disc_points.h"
#include "renderer/techniques/rows/common.h"

// VAO++ (Bokšanský, Pospíšil, Bittner 2017). Every extension of plain VAO has a switch of its own;
// with `adaptive`, `culling`, `rangeCheck`, `luminanceSensitivity` and `colourBleeding` at 0, plain
// VAO remains.
namespace obscura::rows::vao {

constexpr Parameter vaoPlusPlusParameters[] = {
    samples(
        16, "Bokšanský 2017, table 2: its best setting",
        "lines per pixel at most; 2, 4, 8, 16 and 32 have Poisson sets, other numbers a spiral"),
    radius,
    {"adaptive", Unit::flag, "fewer lines where the ball is small on the screen", 1, 0, 1,
     "Bokšanský 2017, section 4.1"},
    {"adaptiveDiameter", Unit::ratio,
     "the ball's diameter in image heights up to which two lines serve; lines double with its area",
     0.04f, 1e-5f, 16,
     "ours: the paper prints none; on Sponza RMSE stays within 0.0001, SSIM within 0.001 of all 32 "
     "lines'"},
    {"culling", Unit::count,
     "what a pass at an eighth of the resolution finds open: 0 it is not run, 1 greedy, stays "
     "open, 2 careful, gets four lines",
     2, 0, 2, "Bokšanský 2017, section 4.2"},
    {"rangeCheck", Unit::flag, "lines hidden far behind an occluder count as open in part", 1, 0, 1,
     "Bokšanský 2017, section 4.4"},
    {"thickness", Unit::ratio,
     "distance behind an occluder, in radii, up to which a hidden line is all blocked", 0.03f,
     1e-3f, 1e3f, "Bokšanský 2017, section 4.4: u"},
    {"luminanceSensitivity", Unit::count,
     "bright surfaces are spared: 0 no, 1 by luminance, 2 by HSV value", 0, 0, 2,
     "ours: its threshold belongs to a scene's lighting"},
    {"luminanceThreshold", Unit::ratio,
     "brightness (scene radiance, before exposure) at which occlusion has half faded, before its "
     "power",
     0.5f, 0, 1e3f, "Bokšanský 2017, figure 9"},
    {"luminanceWidth", Unit::ratio, "brightness from there to where occlusion is full, or none",
     0.3f, 1e-3f, 1e3f, "Bokšanský 2017, figure 9"},
    {"luminancePower", Unit::ratio, "exponent of the fade", 1, 0.01f, 64,
     "ours: straight; the paper's sigma, several in its figure 9"},
    {"colourBleeding", Unit::count,
     "0 none; otherwise every so-manieth line also tints by the colour it meets", 0, 0, 4,
     "Bokšanský 2017, section 4.7: an option, of a half or a quarter of the lines"},
    {"blur", Unit::count, "edge-aware filter: 0 none, 1 mean over the 3 x 3 noise tile, 2 Gaussian",
     1, 0, 2, "Bokšanský 2017, sections 4.5 and 4.6"},
    {"blurSize", Unit::count, "width of the Gaussian filter's window, pixels", 5, 1, 31,
     "ours: the next after 3; the paper leaves it to the user"},
    {"blurDeviation", Unit::pixel, "standard deviation of the Gaussian", 1.5f, 0.1f, 30,
     "ours: fills that window; the paper leaves it to the user"},
    radiusMultiplier(),
    intensity(),
    power(),
    accumulate};

// A filter along one axis fetches depth of the pixel, and depth and value of each tap.
constexpr Fetches filterTaps = [](const Settings& s) {
    const bool gaussian = s["blur"] > 1.5f;
    return 1 + 2 * (2 * std::floor(gaussian ? s["blurSize"] / 2.0 : s["blur"]) + 1);
};
// Fetches ambient and direct light.
constexpr Fetches brightness = [](const Settings& s) {
    return s["luminanceSensitivity"] > 0 ? 2.0 : 0.0;
};
// Fetches depth and normal of the pixel, and its cell of the culling passes.
constexpr Fetches surfaceAndCells = [](const Settings& s) { return s["culling"] > 0 ? 3.0 : 2.0; };

// The most lines that a pixel takes; culled pixels and small balls need fewer.
constexpr Pass vaoPlusPlusPasses[] = {
    {.name = "cull",
     .format = Format::r16f,
     .enabledBy = "culling",
     .scale = 8,
     .work = Work::prepare,
     .fetches = [](const Settings&) { return 2.0 + 8; }},
    {.name = "mayOcclude",
     .format = Format::r8,
     .enabledBy = "culling",
     .scale = 8,
     .work = Work::prepare,
     .fetches = [](const Settings&) { return 4.0; }},
    {.name = "gather",
     .format = Format::r16f,
     .fetches =
         [](const Settings& s) {
             return surfaceAndCells(s) + s["samples"] + (s["blur"] > 0 ? 0 : brightness(s));
         }},
    {.name = "blurAcross",
     .format = Format::r16f,
     .enabledBy = "blur",
     .work = Work::filter,
     .fetches = filterTaps},
    {.name = "blurDown",
     .format = Format::r16f,
     .enabledBy = "blur",
     .work = Work::filter,
     .fetches = [](const Settings& s) { return filterTaps(s) + brightness(s); }},
    // Fetches the normal twice, and depth and albedo of each line's surface.
    {.name = "tint",
     .format = Format::rgba16f,
     .enabledBy = "colourBleeding",
     .fetches =
         [](const Settings& s) {
             return surfaceAndCells(s) + 1 + 2 * std::ceil(s["samples"] / s["colourBleeding"]);
         }},
    {.name = "tintAcross",
     .format = Format::rgba16f,
     .enabledBy = "colourBleeding",
     .work = Work::filter,
     .fetches = filterTaps},
    // Fetches depth, visibility and ambient light besides.
    {.name = "bleed",
     .format = Format::rgba16f,
     .enabledBy = "colourBleeding",
     .work = Work::filter,
     .fetches = [](const Settings& s) { return filterTaps(s) + 3; }},
};

constexpr Technique vaoPlusPlus{"vao_plus_plus",
                                "VAO++ 2017",
                                "Bokšanský, Pospíšil and Bittner 2017, VAO++: Practical "
                                "Volumetric Ambient Occlusion for Games",
                                normals | light,
                                poissonDiscPoints,
                                vaoPlusPlusParameters,
                                vaoPlusPlusPasses};

} // namespace obscura::rows::vao
