// Blizzard 2008 with an occlusion curve that keeps Filion and McNaughton's three rules: a surface
// behind the sample point occludes nothing, one a little in front of it fully, one far in front
// nothing again. The depth difference is taken from the sample point itself.
//
// Limit with fullUntil large: the open fraction of the half-ball of radius R; for a wall at c R,
// visibility 1 - (1 - c)^2 (2 + c) / 4.

#include "blur_normal.glsl"
#include "hemisphere.glsl"
#include "noise.glsl"

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalOf(pixel);
    vec3 mirror = tileDirection(pixel);

    int count = int(settings.samples);
    float fadeEnd = max(settings.noneFrom, settings.fullUntil + 1e-3);
    float occlusion = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 point = position + hemisphereOffset(points[i].xyz, mirror, normal) * settings.radius;
        float sceneDepth = depthAt(uvFromView(point));
        float behind = (-point.z - sceneDepth) / settings.radius;
        if (behind > settings.bias)
            occlusion += clamp((fadeEnd - behind) / (fadeEnd - settings.fullUntil), 0.0, 1.0);
    }
    return vec4(1.0 - occlusion / float(count));
}

vec4 blurTile(ivec2 pixel) { return blurByDepthAndNormal(gatherResult, pixel); }
