#pragma once

#include "renderer/techniques/rows/common.h"

// Ground-truth AO in the form of XeGTAO, and the visibility bitmask. Both look along slices through
// the view vector (shaders/slices.glsl) and share their noise, depth levels and denoising.
namespace obscura::rows::gtao {

constexpr Parameter slices{
    "slices", Unit::count,        "planes through the view vector, per pixel", 2, 1,
    64,       "ours: preset high"};
constexpr Parameter slicesSteps{
    "steps", Unit::count, "depth taps along each side of a slice", 5, 1, 256, "ours: preset high"};
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
    "denoise", Unit::count, "passes of the edge-aware 3 x 3 filter: 1 sharp, 2 medium, 3 soft",
    1,         0,           3,
    "XeGTAO"};

constexpr Parameter edgeDepth{
    "edgeDepth",
    Unit::ratio,
    "change of depth, as a part of the depth, that is an edge for the denoiser",
    0.003f,
    1e-4f,
    1,
    "ours: XeGTAO's 0.011 blurs reliefs"};
constexpr Parameter edgeAngle{
    "edgeAngle",
    Unit::degree,
    "angle between the normals of neighbours from which on it is an edge for the denoiser; 180: "
    "none is",
    20,
    1,
    180,
    "ours: XeGTAO has none, and blurs creases"};

constexpr Parameter layersOfDepth{
    "layers",
    Unit::count,
    "of depth that each tap reads: what is seen, and what lies behind it",
    1,
    1,
    3,
    "neither paper peels"};

constexpr Parameter adaptive{
    "adaptive",
    Unit::flag,
    "fewer slices where a survey of every fourth pixel, one slice each, finds visibility to vary "
    "little",
    0,
    0,
    1,
    "XeGTAO has none; after ASSAO 2016 and CACAO 2020"};
constexpr Parameter adaptiveRange{
    "adaptiveRange",
    Unit::ratio,
    "range of the survey's visibility around a pixel from which it gets all slices; less gives "
    "fewer in proportion, down to one",
    0.15f,
    0.01f,
    1,
    "ours: on Sponza from 0.06 to 0.2 equally good"};

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
    layersOfDepth,
    guardBand(0, "XeGTAO and Therrien et al. 2023 have none"),
    adaptive,
    adaptiveRange,
    denoise,
    edgeDepth,
    edgeAngle,
    radiusMultiplier(2, "ours: the fits of presets high and ultra; XeGTAO's 1.457 is for 3 steps"),
    intensity(),
    power(1.35f, "ours: the same; XeGTAO's 2.2 makes up for what 3 steps miss"),
    downscale,
    accumulate};

constexpr Parameter bitmaskParameters[] = {
    radius,
    slices,
    slicesSteps,
    {"thickness", Unit::ratio,
     "how far, in radii, every surface extends behind what is seen of it; light passes behind", 1,
     1e-3f, 1e6f, "ours: best on seven of eight views, and what the depth reference assumes"},
    samplePower,
    levelOffset,
    layersOfDepth,
    guardBand(0, "XeGTAO and Therrien et al. 2023 have none"),
    adaptive,
    adaptiveRange,
    denoise,
    edgeDepth,
    edgeAngle,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

constexpr Parameter gtVbaoParameters[] = {
    radius,
    slices,
    slicesSteps,
    {"thickness", Unit::ratio,
     "how far, in radii, every surface extends at least behind what is seen of it", 0.5f, 1e-3f,
     1e6f, "ours: less makes too much of Sponza thin"},
    {"surfaceSlope", Unit::ratio,
     "change of depth, as a part of the distance between two taps, up to which they are of one "
     "surface, which is as thick as it is wide",
     2, 0, 100, "ours: between 1, best for a room's thin legs, and 4, best for the dragon"},
    samplePower,
    levelOffset,
    guardBand(0, "XeGTAO and Therrien et al. 2023 have none"),
    adaptive,
    adaptiveRange,
    denoise,
    edgeDepth,
    edgeAngle,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

inline double layersOf(const Settings& s) {
    return s.has("layers") ? static_cast<double>(s["layers"]) : 1.0;
}

constexpr Pass depthLevelsPass{.name = "depths",
                               .format = Format::r32f,
                               .levels = 5,
                               .work = Work::prepare,
                               .fetches = one,
                               .levelFetches = [](const Settings&) { return 4.0; }};
constexpr Pass surveyPass{
    .name = "survey",
    .format = Format::r16f,
    .enabledBy = "adaptive",
    .scale = 4,
    .work = Work::prepare,
    .fetches = [](const Settings& s) { return 2.0 + 2 * s["steps"] * layersOf(s); }};
constexpr Pass countsPass{.name = "counts",
                          .format = Format::r16f,
                          .enabledBy = "adaptive",
                          .scale = 4,
                          .work = Work::prepare,
                          .fetches = [](const Settings&) { return 9.0; }};
// Fetches depth and normal of the pixel and how many slices it gets, and the depths of each tap
// along both sides of each slice.
constexpr Fetches slicesTaps = [](const Settings& s) {
    return 2.0 + s["adaptive"] + 2 * s["slices"] * s["steps"] * layersOf(s);
};
constexpr Pass edgesPass{.name = "edges",
                         .format = Format::rgba8,
                         .enabledBy = "denoise",
                         .work = Work::prepare,
                         .fetches = [](const Settings&) { return 10.0; }}; // depths, normals
// Fetches depth of the pixel; edges of it and its four neighbours; and nine values, which take four
// fetches (textureGather) where the texture has one channel.
constexpr Pass denoisePass(std::string_view name, int from, std::string_view widenedBy = {}) {
    return {.name = name,
            .format = Format::r16f,
            .enabledBy = "denoise",
            .from = from,
            .widenedBy = widenedBy,
            .work = Work::filter,
            .fetches = [](const Settings& s) {
                const bool wide = s.has("bentNormals") && s["bentNormals"] > 0;
                return 1.0 + 5 + (wide ? 9 : 4);
            }};
}

// In the widened form of a pass, green, blue and alpha carry the bent normal. The pass bentLight
// reads that, depth, normal and albedo.
constexpr Pass gtaoPasses[] = {
    depthLevelsPass,
    surveyPass,
    countsPass,
    {.name = "gather", .format = Format::r16f, .widenedBy = "bentNormals", .fetches = slicesTaps},
    edgesPass,
    denoisePass("denoiseOnce", 1, "bentNormals"),
    denoisePass("denoiseTwice", 2, "bentNormals"),
    denoisePass("denoiseThrice", 3, "bentNormals"),
    {.name = "bentLight",
     .format = Format::rgba16f,
     .enabledBy = "bentNormals",
     .fetches = [](const Settings&) { return 4.0; }},
};

constexpr Pass bitmaskPasses[] = {
    depthLevelsPass,
    surveyPass,
    countsPass,
    {.name = "gather", .format = Format::r16f, .fetches = slicesTaps},
    edgesPass,
    denoisePass("denoiseOnce", 1),
    denoisePass("denoiseTwice", 2),
    denoisePass("denoiseThrice", 3),
};

// As many taps as XeGTAO's presets of these names have, or about: 4, 8, 20, 54. But few slices of
// many steps, for what a side of a slice steps over is lost, and the denoiser evens out slices.
constexpr PresetValue presetLow[] = {{"slices", 1}, {"steps", 2}};
constexpr PresetValue presetMedium[] = {{"slices", 2}, {"steps", 2}};
constexpr PresetValue presetHigh[] = {{"slices", 2}, {"steps", 5}};
constexpr PresetValue presetUltra[] = {{"slices", 3}, {"steps", 9}};
constexpr Preset slicesPresets[] = {
    {"low", presetLow}, {"medium", presetMedium}, {"high", presetHigh}, {"ultra", presetUltra}};

// XeGTAO's own values.
constexpr std::array<PresetValue, 9> asXeGtao(float sliceCount, float stepCount) {
    return {{{"slices", sliceCount},
             {"steps", stepCount},
             {"falloff", 0.615f},
             {"minimumVisibility", 0.03f},
             {"denoise", 1},
             {"edgeDepth", 0.011f},
             {"edgeAngle", 180},
             {"radiusMultiplier", 1.457f},
             {"power", 2.2f}}};
}
constexpr std::array xeGtaoLow = asXeGtao(1, 2), xeGtaoMedium = asXeGtao(2, 2),
                     xeGtaoHigh = asXeGtao(3, 3), xeGtaoUltra = asXeGtao(9, 3);
constexpr Preset gtaoPresets[] = {{"low", presetLow},          {"medium", presetMedium},
                                  {"high", presetHigh},        {"ultra", presetUltra},
                                  {"xegtao_low", xeGtaoLow},   {"xegtao_medium", xeGtaoMedium},
                                  {"xegtao_high", xeGtaoHigh}, {"xegtao_ultra", xeGtaoUltra}};

constexpr Technique gtao{"gtao",
                         "Ground-truth AO (XeGTAO)",
                         "Jimenez, Wu, Pesce and Jarabo 2016; parameters of XeGTAO 1.30 (Strugar "
                         "and McCalla 2021)",
                         normals | light | layers,
                         nullptr,
                         gtaoParameters,
                         gtaoPasses,
                         gtaoPresets};
constexpr Technique visibilityBitmask{
    "visibility_bitmask",
    "Visibility bitmask 2023",
    "Therrien, Levesque and Gilet 2023, with cosine-weighted sectors",
    normals | layers,
    nullptr,
    bitmaskParameters,
    bitmaskPasses,
    slicesPresets};
constexpr Technique gtVbao{"gt_vbao",
                           "GT-VBAO 2024, thick as wide",
                           "Salm 2024, after Therrien et al. 2023; thickness after Ottosson 2025",
                           normals,
                           nullptr,
                           gtVbaoParameters,
                           bitmaskPasses,
                           slicesPresets};

} // namespace obscura::rows::gtao
