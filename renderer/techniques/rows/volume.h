#pragma once

#include "renderer/techniques/rows/common.h"

// Techniques that measure how much of a ball is open: Loos and Sloan's around the pixel, by points,
// lines or one area, and Szirmay-Kalos' on the surface.
namespace obscura::rows::volume {

constexpr Parameter clipByNormal{
    "clipByNormal",
    Unit::flag,
    "1: only the ball's half above the surface is measured; 0: the whole ball, and visibility is "
    "doubled, so that a plane is open",
    1,
    0,
    1,
    "ours: the paper has the normal as an option; without it convex edges hide occlusion"};

constexpr Parameter obscuranceParameters[] = {
    samples(9, "Loos and Sloan 2010, figure 1b", "lines through the ball per pixel"),
    radius,
    clipByNormal,
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

constexpr Parameter obscurancePointsParameters[] = {
    samples(33, "Loos and Sloan 2010, figure 1a"),
    radius,
    clipByNormal,
    {"bias", Unit::ratio, "distance behind the surface, in radii, that is ignored", 0.02f, 0, 1,
     "ours: clears the rounding to whole pixels on slanted surfaces"},
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

constexpr Parameter obscuranceAreaParameters[] = {radius, radiusMultiplier(), intensity(), power(),
                                                  downscale};

// A level takes mean and variance of four texels twice; where its size is odd, the last one takes
// six or nine, which is not counted. Nine texels of each of two levels are gathered.
constexpr Pass obscuranceAreaPasses[] = {
    {.name = "moments",
     .format = Format::rg32f,
     .levels = 12,
     .work = Work::prepare,
     .fetches = one,
     .levelFetches = [](const Settings&) { return 2.0 * 4; }},
    {.name = "gather",
     .format = Format::r16f,
     .fetches = [](const Settings&) { return 1.0 + 2 * 9; }},
};

constexpr Parameter vaoParameters[] = {
    samples(16, "Boksansky et al. 2017: the count of most of its timings",
            "lines through the ball per pixel"),
    radius,
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

constexpr Technique obscurance{"volumetric_obscurance",
                               "Volumetric obscurance, lines",
                               "Loos and Sloan 2010, line samples",
                               normals,
                               goldenDirections,
                               obscuranceParameters,
                               surfaceGatherAndBlur};
constexpr Technique obscurancePoints{"volumetric_obscurance_points",
                                     "Volumetric obscurance, points",
                                     "Loos and Sloan 2010, point samples",
                                     normals,
                                     ballPoints,
                                     obscurancePointsParameters,
                                     surfaceGatherAndBlur};
constexpr Technique obscuranceArea{"volumetric_obscurance_area",
                                   "Volumetric obscurance, one area",
                                   "Loos and Sloan 2010, area sample",
                                   depthOnly,
                                   nullptr,
                                   obscuranceAreaParameters,
                                   obscuranceAreaPasses};
constexpr Technique vao{"vao",
                        "Volumetric ambient occlusion 2010",
                        "Szirmay-Kalos, Umenhoffer, Toth, Szecsi, Sbert 2010",
                        normals,
                        goldenDirections,
                        vaoParameters,
                        surfaceGatherAndBlur};

} // namespace obscura::rows::volume
