#pragma once

#include "renderer/techniques/rows/common.h"

// The ray-traced reference as a technique: it has no passes, renderer/reference/traced.h gives
// visibility.
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

} // namespace obscura::rows::traced
