#pragma once

#include "renderer/rows/common.h"

// Ground-truth AO in the form of XeGTAO, and the visibility bitmask. Both look along slices through
// the view vector (shaders/slices.glsl) and share their noise, depth levels and denoising.
namespace obscura::rows::gtao {

constexpr Parameter slices{
    "slices", Unit::count,          "planes through the view vector, per pixel", 3, 1,
    64,       "XeGTAO, preset high"};
constexpr Parameter slicesSteps{
    "steps", Unit::count,          "depth taps along each side of a slice", 3, 1,
    256,     "XeGTAO, preset high"};
constexpr Parameter samplePower{
    "samplePower",
    Unit::ratio,
    "exponent of a tap's place along its side; above 1 taps gather near the pixel",
    2,
    1,
    4,
    "XeGTAO, tuned against ray tracing"};
constexpr Parameter levelOffset{
    "levelOffset",
    Unit::ratio,
    "binary logarithm of the distance in pixels up to which taps read full resolution, and beyond "
    "which averaged depth; 16: all do",
    3.3f,
    0,
    16,
    "XeGTAO 1.30"};
constexpr Parameter denoise{
    "denoise", Unit::count, "passes of the edge-aware 3 x 3 filter: 1 sharp, 2 medium, 3 soft",   2,
    0,         3,           "ours: XeGTAO's 1 counts on temporal accumulation, which we have not"};

constexpr Parameter gtaoParameters[] = {
    radius,
    slices,
    slicesSteps,
    {"falloff", Unit::ratio,
     "outer share of the radius over which occluders fade; 0 ends them sharply", 0.615f, 0, 1,
     "XeGTAO, tuned against ray tracing"},
    {"thinOccluder", Unit::ratio,
     "how much farther occluders count as their distance along the view grows, so that thin things "
     "block less",
     0, 0, 0.7f, "XeGTAO, off"},
    {"minimumVisibility", Unit::ratio, "visibility, after its power, that is never undercut", 0.03f,
     0, 1, "XeGTAO"},
    {"bentNormals", Unit::flag,
     "light from the mean open direction instead of the normal's; shows with uneven ambient light "
     "only",
     0, 0, 1, "XeGTAO, off"},
    samplePower,
    levelOffset,
    denoise,
    radiusMultiplier(1.457f, "XeGTAO, tuned against ray tracing"),
    intensity(),
    power(2.2f, "XeGTAO, tuned against ray tracing"),
    downscale};

constexpr Parameter bitmaskParameters[] = {
    radius,
    slices,
    slicesSteps,
    {"thickness", Unit::ratio,
     "how far, in radii, every surface extends behind what is seen of it; light passes behind",
     0.5f, 1e-3f, 1e6f, "Bevy: 0.25 m at our radius of 0.5 m"},
    samplePower,
    levelOffset,
    denoise,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale};

constexpr Pass depthLevelsPass{.name = "depths",
                               .format = Format::r32f,
                               .levels = 5,
                               .work = Work::prepare,
                               .fetches = one,
                               .levelFetches = [](const Settings&) { return 4.0; }};
// Depth and normal of the pixel; of each tap along both sides of each slice, depth.
constexpr Fetches slicesTaps = [](const Settings& s) { return 2.0 + 2 * s["slices"] * s["steps"]; };
constexpr Pass edgesPass{.name = "edges",
                         .format = Format::rgba8,
                         .enabledBy = "denoise",
                         .work = Work::prepare,
                         .fetches = [](const Settings&) { return 5.0; }};
// Depth of the pixel, edges of it and its four neighbours, nine values.
constexpr Pass denoisePass(std::string_view name, int from, Format format) {
    return {.name = name,
            .format = format,
            .enabledBy = "denoise",
            .from = from,
            .work = Work::filter,
            .fetches = [](const Settings&) { return 1.0 + 5 + 9; }};
}

// Green, blue and alpha carry the bent normal up to `visibility`. bentLight reads that, the bent
// normal, depth, normal and albedo.
constexpr Pass gtaoPasses[] = {
    depthLevelsPass,
    {.name = "gather", .format = Format::rgba16f, .fetches = slicesTaps},
    edgesPass,
    denoisePass("denoiseOnce", 1, Format::rgba16f),
    denoisePass("denoiseTwice", 2, Format::rgba16f),
    denoisePass("denoiseThrice", 3, Format::rgba16f),
    {.name = "visibility", .format = Format::r16f, .fetches = one},
    {.name = "bentLight",
     .format = Format::rgba16f,
     .enabledBy = "bentNormals",
     .fetches = [](const Settings&) { return 5.0; }},
};

constexpr Pass bitmaskPasses[] = {
    depthLevelsPass,
    {.name = "gather", .format = Format::r16f, .fetches = slicesTaps},
    edgesPass,
    denoisePass("denoiseOnce", 1, Format::r16f),
    denoisePass("denoiseTwice", 2, Format::r16f),
    denoisePass("denoiseThrice", 3, Format::r16f),
};

// XeGTAO's, in slices and steps.
constexpr PresetValue presetLow[] = {{"slices", 1}, {"steps", 2}};
constexpr PresetValue presetMedium[] = {{"slices", 2}, {"steps", 2}};
constexpr PresetValue presetHigh[] = {{"slices", 3}, {"steps", 3}};
constexpr PresetValue presetUltra[] = {{"slices", 9}, {"steps", 3}};
constexpr Preset slicesPresets[] = {
    {"low", presetLow}, {"medium", presetMedium}, {"high", presetHigh}, {"ultra", presetUltra}};

constexpr Technique gtao{"gtao",
                         "Ground-truth AO (XeGTAO)",
                         "Jimenez, Wu, Pesce and Jarabo 2016; parameters of XeGTAO 1.30 (Strugar "
                         "and McCalla 2021)",
                         normals | light,
                         nullptr,
                         gtaoParameters,
                         gtaoPasses,
                         slicesPresets};
constexpr Technique visibilityBitmask{
    "visibility_bitmask",
    "Visibility bitmask 2023",
    "Therrien, Levesque and Gilet 2023, with cosine-weighted sectors",
    normals,
    nullptr,
    bitmaskParameters,
    bitmaskPasses,
    slicesPresets};

} // namespace obscura::rows::gtao
