#pragma once

#include "renderer/techniques/rows/common.h"

// Techniques that test points of a volume against the depth buffer, besides the Aalborg thesis'.
namespace obscura::rows::points {

constexpr Parameter starcraftParameters[] = {
    samples(16, "Puri 2024, section 3.4: as many as for its other techniques"),
    radius,
    {"bias", Unit::ratio, "depth, in radii, that a surface must lie in front of a point to count",
     0.02f, 0, 1, "de Vries 2020: 0.025 units, over Puri's radius of 1.3"},
    {"blur", Unit::flag, "plain mean over the 4 x 4 noise tile, across edges too", 1, 0, 1,
     "de Vries 2020; Puri 2024, section 3.3"},
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

constexpr Parameter crytekShaderX7Parameters[] = {
    samples(24, "Jakobsen 2010, section 5.3", "points tested per pixel; whole cubes of eight"),
    radius,
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

constexpr auto starcraftPasses = gatherAndBlur(surfaceAndSamples, boxBlur);

constexpr Technique starcraft{"starcraft",
                              "StarCraft II, LearnOpenGL form",
                              "Filion and McNaughton 2008; de Vries 2020; as in Puri 2024 (Leeds), "
                              "section 3.3",
                              normals,
                              boxKernel,
                              starcraftParameters,
                              starcraftPasses};
constexpr Technique crytekShaderX7{"crytek_shaderx7",
                                   "Crytek 2007, ShaderX7 listing",
                                   "Mittring 2007; Kajalin, ShaderX7 2009",
                                   depthOnly,
                                   nullptr,
                                   crytekShaderX7Parameters,
                                   crytekPasses};

} // namespace obscura::rows::points
