// Volumetric obscurance by point samples (Loos and Sloan 2010): the share of points of a ball
// around the pixel that lie in front of what the depth buffer holds. Depth and normals.
//
// A plane fills half of the ball. clipByNormal flips points to the normal's side; without it
// visibility is doubled and cut at 1. Departure: a bias in radii, for a point is compared with the
// nearest pixel's depth. Unlike Crytek's technique the points are even in volume, the ball has the
// same size in metres everywhere, and there is no range term.
//
// Limit: the open share of the half-ball (or twice the ball's), as volumetric_obscurance. Beside an
// endless wall at c = d / R occlusion is (1 - c)^2 (2 + c) / 4; beside steps of height h, d 0.25 h
// 0.5: 0.2310; 0.5, 0.5: 0.1261; 0.1, 0.2: 0.1290; 0.25, 2: 0.3164 (R = 1).

#include "blur_normal.glsl"
#include "hemisphere.glsl"
#include "noise.glsl"

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    bool clipped = settings.clipByNormal > 0.5;
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalOf(pixel);
    vec3 mirror = tileDirection(pixel);

    int count = int(settings.samples);
    float bias = settings.bias * settings.radius;
    int open = 0;
    for (int i = 0; i < count; ++i) {
        vec3 offset = clipped ? hemisphereOffset(points[i].xyz, mirror, normal)
                              : reflect(points[i].xyz, mirror);
        vec3 point = position + offset * settings.radius;
        if (depthAt(uvFromView(point)) >= -point.z - bias)
            ++open;
    }
    float visibility = float(open) / float(count);
    return vec4(clipped ? visibility : min(2.0 * visibility, 1.0));
}

vec4 blurTile(ivec2 pixel) { return blurByDepthAndNormal(gatherResult, pixel); }
