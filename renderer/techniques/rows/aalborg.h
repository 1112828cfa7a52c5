#pragma once

#include "renderer/techniques/rows/common.h"

// The three techniques of Jakobsen 2010 (Aalborg), and the corrected form of one of them.
namespace obscura::rows::aalborg {

constexpr Parameter crytekParameters[] = {
    samples(24, "Jakobsen 2010, section 5.3", "points tested per pixel; whole cubes of eight"),
    radius,
    {"range", Unit::ratio,
     "depth difference, in radii, at which a nearer surface has faded to neutral; the thesis' "
     "normalised depth makes this so large that it never engages",
     200, 0.01f, 1e6f, "Jakobsen 2010, appendix A, in our unit"},
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

// The accessibility curve of appendix B, with lengths in radii instead of the appendix's scene
// units, so that one setting serves scenes of any size.
constexpr std::string_view byEye = "ours: the thesis prints no value; by eye, so that its two "
                                   "hemisphere techniques darken alike";
constexpr Parameter fullOcclusion{
    "fullOcclusion",
    Unit::ratio,
    "depth difference, in radii, below which a surface in front of the pixel is ignored",
    0.02f,
    0,
    10,
    byEye};
constexpr Parameter noOcclusion{
    "noOcclusion",
    Unit::ratio,
    "depth difference, in radii, beyond which a surface in front of the pixel is ignored",
    1.5f,
    0.01f,
    100,
    byEye};
constexpr Parameter attenuation{
    "attenuation",
    Unit::ratio,
    "depth difference, in radii, at which accessibility is one half, before its power",
    0.35f,
    1e-3f,
    1e3f,
    byEye,
    true};
constexpr Parameter accessibilityPower{
    "accessibilityPower", Unit::ratio, "exponent of a sample's accessibility", 2, 0.01f, 64, byEye};

constexpr Parameter blizzardParameters[] = {samples(24, "Jakobsen 2010, section 5.3"),
                                            radius,
                                            fullOcclusion,
                                            noOcclusion,
                                            attenuation,
                                            accessibilityPower,
                                            blur,
                                            radiusMultiplier(),
                                            intensity(),
                                            power(),
                                            downscale,
                                            accumulate};

constexpr Parameter blizzardCorrectedParameters[] = {
    samples(24, "Jakobsen 2010, section 5.3"),
    radius,
    {"fullUntil", Unit::ratio,
     "distance behind the surface, in radii, up to which a point counts as fully occluded", 1, 0,
     100, "ours: half of noneFrom"},
    {"noneFrom", Unit::ratio,
     "distance behind the surface, in radii, from which a point counts as open again", 2, 0.01f,
     1000, "ours: the ball's diameter"},
    {"bias", Unit::ratio, "distance behind the surface, in radii, that is ignored", 0.02f, 0, 1,
     "ours: clears the rounding of a 24-bit depth"},
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

constexpr Parameter rayMarchParameters[] = {
    samples(30, "Jakobsen 2010, section 5.3", "directions per pixel"),
    radius,
    {"steps", Unit::count, "equal steps along each direction", 4, 1, 64,
     "Jakobsen 2010, appendix C"},
    fullOcclusion,
    noOcclusion,
    attenuation,
    accessibilityPower,
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

// A march ends where something blocks it.
constexpr auto rayMarchPasses =
    gatherAndBlur([](const Settings& s) { return 2.0 + s["samples"] * s["steps"]; }, normalBlur);

constexpr Technique crytek{"crytek",
                           "Crytek 2007",
                           "Mittring 2007; Kajalin, ShaderX7 2009; as in Jakobsen 2010, appendix A",
                           depthOnly,
                           nullptr,
                           crytekParameters,
                           crytekPasses};
constexpr Technique blizzard{"blizzard",
                             "Blizzard 2008",
                             "Filion and McNaughton 2008; as printed in Jakobsen 2010, appendix B",
                             normals,
                             ballPoints,
                             blizzardParameters,
                             surfaceGatherAndBlur};
constexpr Technique blizzardCorrected{
    "blizzard_corrected",
    "Blizzard 2008, corrected curve",
    "Filion and McNaughton 2008, their three rules for the occlusion curve",
    normals,
    ballPoints,
    blizzardCorrectedParameters,
    surfaceGatherAndBlur};
constexpr Technique rayMarch{
    "ray_march",   "Ray-marching 2010", "Jakobsen 2010, section 4.3.3 and appendix C",
    normals,       ballPoints,          rayMarchParameters,
    rayMarchPasses};

} // namespace obscura::rows::aalborg
