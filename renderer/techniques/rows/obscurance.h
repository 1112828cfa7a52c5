#pragma once

#include "renderer/techniques/rows/common.h"

// Obscurance from surface points on a disc that faces the camera: Alchemy, a student's version of
// it with a compute-shader blur, and its scalable successor.
namespace obscura::rows::obscurance {

constexpr std::string_view alchemyPaper = "McGuire et al. 2011";

constexpr Parameter depthBias{"bias",
                              Unit::ratio,
                              "height above the pixel's plane, as a part of its depth, that does "
                              "not occlude",
                              0.001f,
                              0,
                              1,
                              alchemyPaper};
constexpr Parameter falloffStart{"falloffStart",
                                 Unit::ratio,
                                 "distance, in radii, from which occlusion falls off (u, or c)",
                                 0.1f,
                                 1e-3f,
                                 10,
                                 "Kim 2022, Ambient Occlusion: 0.1 R"};

// The parameters of blur_compute.glsl.
constexpr Parameter bilateral{"blur",
                              Unit::flag,
                              "separable cross-bilateral blur in compute shaders",
                              1,
                              0,
                              1,
                              "Kim 2022, Bilateral blur"};
constexpr Parameter blurRadius{"blurRadius",
                               Unit::count,
                               "pixels that the blur reaches; its Gaussian has half of that",
                               6,
                               1,
                               32,
                               "ours: by eye; the report gives none"};
constexpr Parameter depthVariance{"depthVariance",
                                  Unit::ratio,
                                  "variance, in radii squared, of depths that blur together (s)",
                                  0.01f,
                                  1e-6f,
                                  1e4f,
                                  "Kim 2022, Bilateral blur, where the radius is 1"};

// Fetches depth, normal and visibility of each of the 128 pixels of a group, and of those that its
// blur reaches beyond either end.
constexpr Fetches groupBlur = [](const Settings& s) {
    return 3 * (128 + 2 * s["blurRadius"]) / 128.0;
};

constexpr Pass gatherAndBilateral[] = {
    {.name = "gather", .format = Format::r16f, .fetches = surfaceAndSamples},
    {.name = "blurColumns",
     .format = Format::r16f,
     .enabledBy = "blur",
     .stage = Stage::columns,
     .work = Work::filter,
     .file = "blur_compute.glsl",
     .fetches = groupBlur},
    {.name = "blurRows",
     .format = Format::r16f,
     .enabledBy = "blur",
     .stage = Stage::rows,
     .work = Work::filter,
     .file = "blur_compute.glsl",
     .fetches = groupBlur},
};

constexpr Parameter alchemyParameters[] = {
    samples(12, "McGuire et al. 2011, figure 1"),
    radius,
    depthBias,
    {"epsilon", Unit::ratio,
     "keeps the distance squared, in radii squared, from zero in the denominator", 1e-4f, 1e-8f, 1,
     alchemyPaper},
    {"insideSphere", Unit::flag,
     "1: surfaces further than the radius from the pixel do not occlude", 0, 0, 1,
     "McGuire et al. 2011: left out of the shipping form"},
    bilateral,
    blurRadius,
    depthVariance,
    radiusMultiplier(),
    intensity(),
    power(1, alchemyPaper),
    downscale,
    accumulate};

constexpr Parameter alchemyFormOneParameters[] = {samples(12, "McGuire et al. 2011, figure 1"),
                                                  radius,
                                                  depthBias,
                                                  falloffStart,
                                                  bilateral,
                                                  blurRadius,
                                                  depthVariance,
                                                  radiusMultiplier(),
                                                  intensity(),
                                                  power(1, alchemyPaper),
                                                  downscale,
                                                  accumulate};

constexpr Parameter alchemyCs562Parameters[] = {
    samples(18, "ours: the spiral's nine directions twice"),
    radius,
    {"bias", Unit::ratio,
     "height above the pixel's plane, as a part of the tap's depth, that does not occlude", 0.001f,
     0, 1, "Kim 2022"},
    falloffStart,
    bilateral,
    blurRadius,
    depthVariance,
    radiusMultiplier(),
    intensity(1, "Kim 2022, first picture"),
    power(1, "Kim 2022, first picture"),
    downscale,
    accumulate};

constexpr std::string_view saoProgram = "the authors' program, for a radius of 1 m";
constexpr Parameter saoParameters[] = {
    samples(11, "the authors' program"),
    radius,
    {"turns", Unit::count, "how often the spiral of taps goes round", 7, 1, 4096,
     "the authors' program, with 11 samples"},
    {"bias", Unit::ratio, "height above the pixel's plane, in radii, that does not occlude", 0.01f,
     0, 1, saoProgram},
    {"epsilon", Unit::ratio,
     "keeps the distance squared, in radii squared, from zero in the denominator", 0.01f, 1e-8f, 1,
     saoProgram},
    {"mipOffset", Unit::count,
     "log2 of the distance in pixels up to which taps read full-resolution depth (q')", 3, 0, 16,
     "McGuire et al. 2012, equation 10"},
    guardBand(0.1f, "ours: McGuire et al. 2012 name none"),
    {"blur", Unit::flag, "two passes of seven taps, keyed on depth", 1, 0, 1,
     "McGuire et al. 2012"},
    {"blurStep", Unit::count, "pixels from one tap of the blur to the next", 2, 1, 8,
     "the authors' program"},
    {"edgeDepth", Unit::ratio, "depth difference, in radii, across which nothing blurs", 0.15f,
     1e-3f, 1e3f, saoProgram},
    radiusMultiplier(),
    intensity(1, "the authors' program"),
    power(),
    downscale,
    accumulate};

// Fetches depth of the pixel, and of each of seven taps depth and value, each in one fetch with
// that of the tap's neighbour in the quad.
constexpr Fetches quadBlur = [](const Settings&) { return 1.0 + 7 * 2; };

constexpr Pass saoPasses[] = {
    {.name = "hierarchy",
     .format = Format::r32f,
     .levels = 6,
     .work = Work::prepare,
     .fetches = one,
     .levelFetches = one},
    // Fetches depth of the pixel, of two neighbours and of each sample.
    {.name = "gather",
     .format = Format::r16f,
     .fetches = [](const Settings& s) { return 3.0 + s["samples"]; }},
    {.name = "blurAcross",
     .format = Format::r16f,
     .enabledBy = "blur",
     .work = Work::filter,
     .fetches = quadBlur},
    {.name = "blurDown",
     .format = Format::r16f,
     .enabledBy = "blur",
     .work = Work::filter,
     .fetches = quadBlur},
};

constexpr Technique alchemy{"alchemy",
                            "Alchemy 2011",
                            "McGuire, Osman, Bukowski and Hennessy 2011, the form that shipped",
                            normals,
                            nullptr,
                            alchemyParameters,
                            gatherAndBilateral};
constexpr Technique alchemyFormOne{"alchemy_form1",
                                   "Alchemy 2011, form 1",
                                   "McGuire, Osman, Bukowski and Hennessy 2011, the first form",
                                   normals,
                                   nullptr,
                                   alchemyFormOneParameters,
                                   gatherAndBilateral};
constexpr Technique alchemyCs562{"alchemy_cs562",
                                 "Alchemy, CS562 2022",
                                 "Kim 2022, CS562 project report, after McGuire et al. 2011",
                                 normals,
                                 nullptr,
                                 alchemyCs562Parameters,
                                 gatherAndBilateral};
constexpr Technique sao{"sao",
                        "Scalable ambient obscurance 2012",
                        "McGuire, Mara and Luebke 2012",
                        depthOnly,
                        nullptr,
                        saoParameters,
                        saoPasses};

} // namespace obscura::rows::obscurance
