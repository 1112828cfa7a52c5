#pragma once

#include "renderer/techniques/rows/common.h"

// Techniques that trace the scene's triangles. The ray-traced reference has no passes,
// renderer/reference/traced.h gives its visibility; the others start from few rays and filter.
namespace obscura::rows::traced {

constexpr Parameter rayTracedParameters[] = {
    radius,
    {"rays", Unit::count,
     "rays per pixel and jittered frame, rounded up to a power of two, at least 2", 256, 1, 65536,
     "ours: standard error about 0.008 at half-open pixels"},
    {"integral", Unit::count,
     "0: cosine-weighted; 1: uniform over the hemisphere; 2: cosine-weighted, an occluder at "
     "distance t counts 1 - t / radius",
     0, 0, 2, "ours: what ambient light of constant radiance needs"},
    radiusMultiplier(),
    intensity(),
    power(),
};

constexpr Technique rayTraced{
    "ray_traced",
    "Ray-traced reference",
    "cosine-weighted visibility within a radius, after Zhukov et al. 1998; traced with Embree",
    rays,
    nullptr,
    rayTracedParameters,
    {}};

constexpr Parameter rtaoParameters[] = {
    radius,
    {"rays", Unit::count, "rays per pixel", 4, 1, 64,
     "ours: beyond 16, ray_traced is the better choice"},
    {"denoise", Unit::flag,
     "two passes of an edge-aware filter that is guided by the rays' variance", 1, 0, 1, "ours"},
    radiusMultiplier(),
    intensity(),
    power(),
    accumulate,
};

// shaders/ray_filter.glsl reads 3 x 3 pixels.
constexpr Fetches nine = [](const Settings&) { return 9.0; };
constexpr std::array<Pass, 4> gatherAndSmooth(Fetches gather) {
    return {{{.name = "gather", .format = Format::r16f, .fetches = gather},
             {.name = "surfaces",
              .format = Format::rgba32f,
              .enabledBy = "denoise",
              .work = Work::prepare,
              .fetches = [](const Settings&) { return 3.0; }},
             {.name = "smoothNear",
              .format = Format::rgba32f,
              .enabledBy = "denoise",
              .work = Work::filter,
              .fetches = nine},
             {.name = "smoothFar",
              .format = Format::r16f,
              .enabledBy = "denoise",
              .work = Work::filter,
              .fetches = nine}}};
}
constexpr auto rtaoPasses = gatherAndSmooth(one);
// Nodes and triangles are read from buffers.
constexpr auto rtaoBvhPasses = gatherAndSmooth([](const Settings&) { return 2.0; });

constexpr PresetValue presetLow[] = {{"rays", 2}};
constexpr PresetValue presetMedium[] = {{"rays", 4}};
constexpr PresetValue presetHigh[] = {{"rays", 8}};
constexpr Preset rayPresets[] = {
    {"low", presetLow}, {"medium", presetMedium}, {"high", presetHigh}};

constexpr Technique rtao{
    "rtao",
    "Ray-traced AO (Embree)",
    "rays of Zhukov et al. 1998, few a pixel, traced with Embree; filtered after "
    "Dammertz et al. 2010 and Schied et al. 2017",
    normals | obscura::traced,
    nullptr,
    rtaoParameters,
    rtaoPasses,
    rayPresets};
constexpr Technique rtaoBvh{"rtao_bvh",
                            "Ray-traced AO (shader)",
                            "as rtao, traced by a shader in a tree of boxes that Embree builds",
                            normals | tree,
                            nullptr,
                            rtaoParameters,
                            rtaoBvhPasses,
                            rayPresets};

} // namespace obscura::rows::traced
