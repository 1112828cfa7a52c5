#pragma once

#include "renderer/techniques/rows/common.h"

// Techniques that work on the scene's objects, and so know what no pixel shows.
namespace obscura::rows::objects {

constexpr Parameter volumesParameters[] = {
    radius,
    {"falloff", Unit::ratio,
     "exponent of 1 - h / radius by which a polygon counts, h being the height above its plane", 1,
     0, 16, "the port of McGuire's shader by speps"},
    radiusMultiplier(),
    intensity(),
    power(),
    downscale};

constexpr Pass volumesPasses[] = {
    {.name = "volumes",
     .format = Format::r32f,
     .stage = Stage::boxes,
     .fetches = [](const Settings&) { return 2.0; }},
    {.name = "combine", .format = Format::r16f, .fetches = one},
};

constexpr Technique volumes{"ambient_occlusion_volumes",
                            "Ambient occlusion volumes",
                            "McGuire 2010",
                            normals | triangles,
                            nullptr,
                            volumesParameters,
                            volumesPasses};

constexpr Parameter voxelParameters[] = {
    radius,
    {"voxels", Unit::count, "voxels along the radius (before it is multiplied)", 8, 1, 256,
     "ours: finer ones do not fit into the memory for Sponza"},
    {"cones", Unit::count, "cones traced per pixel", 6, 1, 255,
     "usual: one along the normal and five around it"},
    {"steps", Unit::count, "voxels read along each cone", 4, 1, 255,
     "ours: on Sponza six are no nearer"},
    {"bias", Unit::ratio,
     "height above the surface's plane, in voxels of the size read, below which none is centred",
     1.5f, 0, 10, "ours"},
    blur,
    radiusMultiplier(),
    intensity(),
    power(),
    downscale,
    accumulate};

constexpr auto voxelPasses =
    gatherAndBlur([](const Settings& s) { return 2.0 + s["cones"] * s["steps"]; }, normalBlur);

constexpr Technique voxelAo{"voxel_ao",
                            "Voxel cone tracing",
                            "Crassin, Neyret, Sainz, Green and Eisemann 2011",
                            normals | voxels,
                            nullptr,
                            voxelParameters,
                            voxelPasses};

} // namespace obscura::rows::objects
