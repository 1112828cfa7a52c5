#pragma once

#include "renderer/techniques/rows/common.h"

// Horizon-based ambient occlusion and what its authors made of it. One estimator and one set of
// defaults, so that the rows differ only in what their names say.
namespace obscura::rows::horizon {

constexpr std::string_view horizonSource = "nvpro-samples gl_ssao";

constexpr Parameter horizonDirections{"directions",
                                      Unit::count,
                                      "lines searched around a pixel",
                                      8,
                                      1,
                                      64,
                                      "nvpro-samples gl_ssao; Puri 2024, section 3.4, has 4"};
constexpr Parameter horizonSteps{"steps", Unit::count, "taps along a line", 4,
                                 1,       512,         horizonSource};

constexpr Parameter horizonBias{
    "angleBias", Unit::degree, "angle above the tangent plane below which nothing occludes", 30,
    0,           90,           "NVIDIA SDK 10, HBAO sample by the paper's authors"};

constexpr Parameter horizonAttenuation{
    "attenuation",
    Unit::ratio,
    "a of W = 1 - a (t / R)^2, the weight of an occluder at distance t; 0 leaves only the cut at R",
    1,
    0,
    1,
    "NVIDIA SDK 10, HBAO sample by the paper's authors",
    true};

constexpr Parameter horizonReach{"screenReach",
                                 Unit::ratio,
                                 "longest line on screen, in heights of the image",
                                 1,
                                 0.01f,
                                 100,
                                 "ours: gl_ssao has no bound; NVIDIA SDK 11 has 0.1, which would "
                                 "shorten the radius of near things"};

constexpr Parameter horizonBlur{
    "blur", Unit::flag, "edge-aware Gaussian along rows, then columns", 1, 0, 1, horizonSource};

constexpr Parameter horizonBlurRadius(float value, std::string_view source) {
    return {"blurRadius", Unit::count, "pixels on each side that the blur takes in", value, 1,
            32,           source};
}

// The SDK's contrast of 1.4, which it divides by 1 - sin(bias): the range that the bias leaves to
// the sine.
constexpr Parameter horizonIntensity =
    intensity(2.8f, "NVIDIA SDK 10, HBAO sample: contrast 1.4 / (1 - sin 30 degrees)");

constexpr Parameter hbaoParameters[] = {
    horizonDirections,
    horizonSteps,
    radius,
    horizonBias,
    horizonAttenuation,
    horizonReach,
    {"ownLayer", Unit::flag,
     "taps keep to every fourth pixel, those of the layer that hbao_deinterleaved would have", 0, 0,
     1, "Bavoil, Sainz and Dimitrov 2008: the full image"},
    horizonBlur,
    horizonBlurRadius(3, horizonSource),
    radiusMultiplier(),
    horizonIntensity,
    power(),
    downscale,
    accumulate};

constexpr Parameter hbaoDeinterleavedParameters[] = {
    horizonDirections,  horizonSteps,     radius,      horizonBias,
    horizonAttenuation, horizonReach,     horizonBlur, horizonBlurRadius(3, horizonSource),
    radiusMultiplier(), horizonIntensity, power(),     downscale,
    accumulate};

constexpr Parameter hbaoPlusParameters[] = {
    horizonDirections,
    horizonSteps,
    radius,
    {"lineLength", Unit::ratio, "length of the lines, in radii", 1, 0.05f, 1,
     "HBAO+ 3.0; gl_ssao has 0.5"},
    {"bias", Unit::ratio,
     "part of the cosine between normal and tap that is taken off, against self-occlusion", 0.1f, 0,
     1, "HBAO+ 3.0, README"},
    horizonReach,
    horizonBlur,
    horizonBlurRadius(4, "HBAO+ 3.0, README"),
    radiusMultiplier(),
    intensity(2, "HBAO+ 3.0, CoarseAO: twice the mean"),
    power(2, "HBAO+ 3.0, README"),
    downscale,
    accumulate};

constexpr Parameter multiScaleParameters[] = {
    horizonDirections,
    horizonSteps,
    radius,
    {"detailRadius", Unit::ratio, "radius of the full-resolution pass, in radii", 0.25f, 0.01f, 1,
     "ours: about one step of the coarse pass"},
    horizonBias,
    horizonAttenuation,
    horizonReach,
    {"multiply", Unit::flag,
     "the scales' visibilities are multiplied, which counts near occluders twice; otherwise the "
     "darker wins",
     0, 0, 1, "Hoang and Low 2012: not lighter than the darkest scale"},
    horizonBlur,
    horizonBlurRadius(3, horizonSource),
    radiusMultiplier(),
    horizonIntensity,
    power(),
    downscale,
    accumulate};

// Fetches depth and normal of the pixel, and depth of each tap. Lines of fewer pixels than steps
// have fewer steps.
constexpr Fetches horizonTaps = [](const Settings& s) {
    return 2.0 + s["directions"] * s["steps"];
};
// A blur along one axis fetches depth of the pixel and its two neighbours, and depth and value of
// each tap.
constexpr Pass horizonBlurPass(std::string_view name, int scale = 1) {
    return {.name = name,
            .format = Format::r16f,
            .enabledBy = "blur",
            .scale = scale,
            .work = Work::filter,
            .fetches = [](const Settings& s) { return 3.0 + 2 * (2 * s["blurRadius"] + 1); }};
}

constexpr Pass horizonPasses[] = {
    {.name = "gather", .format = Format::r16f, .fetches = horizonTaps},
    horizonBlurPass("blurAcross"),
    horizonBlurPass("blurDown"),
};

constexpr Pass horizonLayerPasses[] = {
    {.name = "split",
     .format = Format::r32f,
     .scale = 4,
     .layers = 16,
     .work = Work::prepare,
     .fetches = one},
    {.name = "shade", .format = Format::r16f, .scale = 4, .layers = 16, .fetches = horizonTaps},
    {.name = "merge", .format = Format::r16f, .fetches = one},
    horizonBlurPass("blurAcross"),
    horizonBlurPass("blurDown"),
};

// The pass combine fetches depth of the pixel and its four neighbours, normal and detail; then
// depth, normal and value of up to four coarse pixels. Four pixels together have nine coarse ones,
// so the mean is 13.75.
constexpr Pass multiScalePasses[] = {
    {.name = "coarse", .format = Format::r16f, .scale = 2, .fetches = horizonTaps},
    horizonBlurPass("coarseAcross", 2),
    horizonBlurPass("coarseDown", 2),
    {.name = "detail", .format = Format::r16f, .fetches = horizonTaps},
    horizonBlurPass("detailAcross"),
    horizonBlurPass("detailDown"),
    {.name = "combine",
     .format = Format::r16f,
     .fetches = [](const Settings&) { return 7.0 + 4 * 3; }},
};

constexpr Technique hbao{
    "hbao",       "HBAO 2008", "Bavoil, Sainz and Dimitrov 2008; Puri 2024, section 2.4",
    normals,      nullptr,     hbaoParameters,
    horizonPasses};
constexpr Technique hbaoDeinterleaved{
    "hbao_deinterleaved",
    "HBAO, deinterleaved",
    "Bavoil, Sainz and Dimitrov 2008; Bavoil 2014, deinterleaved texturing",
    normals,
    nullptr,
    hbaoDeinterleavedParameters,
    horizonLayerPasses};
constexpr Technique hbaoPlus{
    "hbao_plus",       "HBAO+ 2014", "NVIDIA HBAO+ 3.0; Bavoil 2014, deinterleaved texturing",
    normals,           nullptr,      hbaoPlusParameters,
    horizonLayerPasses};
constexpr Technique multiScale{
    "multi_scale",
    "HBAO at two scales",
    "Bavoil and Sainz 2009, multi-layer dual-resolution SSAO, one layer; Hoang and Low 2012",
    normals,
    nullptr,
    multiScaleParameters,
    multiScalePasses};

} // namespace obscura::rows::horizon
