#pragma once

#include "renderer/techniques/rows/common.h"

// Techniques that read more of the scene than its depth and normals: its light, or spheres in its
// stead.
namespace obscura::rows::lit {

constexpr Parameter ssdoParameters[] = {
    samples(16, "ours: the thesis' noise tile makes 256 of them"),
    radius,
    {"bias", Unit::ratio, "distance behind the surface's plane, in radii, that is ignored", 0.01f,
     0, 1, "ours: clears the rounding of normals"},
    {"thickness", Unit::ratio,
     "depth behind the surface, in radii, from which a point counts as open again", 2, 0.01f, 1000,
     "ours: the ball's diameter, instead of the paper's second depth layer"},
    {"directional", Unit::flag,
     "open directions let in the environment's light of that direction, not the mean", 1, 0, 1,
     "Ritschel et al. 2009, equation 1"},
    {"bounce", Unit::flag, "blocked directions let in the light of the surface that blocks them", 1,
     0, 1, "Ritschel et al. 2009, equation 2"},
    {"bounceStrength", Unit::ratio, "factor on the bounced light", 1, 0, 10,
     "neutral; Ritschel et al. 2009 adjust it by hand"},
    {"nearestSender", Unit::ratio,
     "distance, in radii, from which nearer surfaces send light too, lest it grow without bound",
     0.25f, 0.01f, 1,
     "ours: in a right-angled corner, what blocks then sends about as much as it blocks"},
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    accumulate,
};

// Fetches of the blurred result of a pass, or of the result itself where nothing is blurred.
constexpr Fetches maybeBlurred = [](const Settings& s) {
    return s["blur"] > 0 ? normalBlur(s) : 1;
};

// The pass gather fetches depth and normal of the pixel and, of each sample, depth and (only where
// it is near enough to block) the normal. The pass bounce reads those that block again: depth,
// normal, direct and ambient light, and the share of the ambient light that arrives.
constexpr Pass ssdoPasses[] = {
    {.name = "gather",
     .format = Format::rgba16f,
     .fetches = [](const Settings& s) { return 2.0 + 2 * s["samples"]; }},
    {.name = "bounce",
     .format = Format::rgba16f,
     .enabledBy = "bounce",
     .fetches = [](const Settings& s) { return 2.0 + (2 + 5) * s["samples"]; }},
    {.name = "shade",
     .format = Format::rgba16f,
     .work = Work::filter,
     .fetches =
         [](const Settings& s) { // depths, normals, ambient light, bounced light, albedo
             const bool blurs = s["blur"] > 0;
             const double values = blurs ? 16 : 1;
             return 4.0 + (blurs ? 17 : 0) + values + 1 + (s["bounce"] > 0 ? values + 1 : 0);
         }},
};

constexpr Technique ssdo{"ssdo",
                         "Screen-space directional occlusion",
                         "Ritschel, Grosch and Seidel 2009",
                         normals | light,
                         rayPoints,
                         ssdoParameters,
                         ssdoPasses};

constexpr Parameter proxySpheresParameters[] = {
    samples(32, "ours: the thesis' noise tile makes 512 of them",
            "neighbouring pixels read per pixel, at most"),
    radius,
    {"detail", Unit::flag, "high-frequency pass: occlusion by neighbouring pixels", 1, 0, 1,
     "Shanmugam and Arikan 2007, both passes"},
    {"distant", Unit::flag, "low-frequency pass: occlusion by spheres fitted to the scene", 1, 0, 1,
     "Shanmugam and Arikan 2007, both passes"},
    {"pixelsPerTap", Unit::pixel,
     "area of the search disc on the screen for each pixel read, so that far surfaces read fewer",
     64, 1, 1e5f, "ours: all of 32 up to 15 metres away with the default radius, at 720 lines"},
    {"proxySize", Unit::ratio,
     "radius of a pixel's sphere, relative to the disc that is its share of the search disc", 1,
     0.01f, 10, "ours: the discs' areas add up to the search disc's"},
    {"distantReach", Unit::ratio,
     "distance from a fitted sphere, in radii, at which its effect has faded to nothing", 2, 0.1f,
     100, "ours: beyond what details reach; farther, the sum counts what lies behind walls"},
    {"sphereSize", Unit::ratio,
     "radius of a fitted sphere, relative to the one that encloses what it stands for", 0.55f,
     0.01f, 1, "ours: enclosing discs have 1.6 times the surface's area, half of which faces away"},
    {"nearFade", Unit::ratio,
     "distance outside a sphere, in its own radii, over which its effect fades in", 1, 0, 10,
     "ours: nearer, its cap is wider than half of the hemisphere, and no surface's"},
    {"bias", Unit::ratio, "cosine that is ignored: caps at the horizon do not count", 0.05f, 0, 1,
     "ours: clears the rounding of depth and the facets of round meshes"},
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

// Far pixels take fewer samples; a sphere out of reach needs no normal.
constexpr Pass proxySpheresPasses[] = {
    {.name = "detail", .format = Format::r16f, .enabledBy = "detail", .fetches = surfaceAndSamples},
    {.name = "distant",
     .format = Format::r32f,
     .enabledBy = "distant",
     .stage = Stage::splat,
     .fetches = [](const Settings&) { return 2.0; }},
    {.name = "combine",
     .format = Format::r16f,
     .work = Work::filter,
     .fetches =
         [](const Settings& s) {
             return 1.0 + (s["detail"] > 0 ? maybeBlurred(s) : 0) + (s["distant"] > 0 ? 1 : 0);
         }},
};

constexpr Technique proxySpheresTechnique{
    "proxy_spheres", "Proxy spheres 2007",   "Shanmugam and Arikan 2007", normals | spheres,
    squarePoints,    proxySpheresParameters, proxySpheresPasses};

} // namespace obscura::rows::lit
