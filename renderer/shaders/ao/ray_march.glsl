// Ray-marching (Jakobsen 2010, section 4.3.3 and appendix C): Blizzard's kernel and curve, but each
// offset is walked in equal steps and the first step with a surface in front of the pixel counts,
// so that nearer blockers are found than the end point alone would meet.
//
// Limits: a plane seen face-on is open. On the 45-degree groove of blizzard.glsl, with a
// fullOcclusion of 0, the first step already stops: visibility is the mean of
// accessibility(|x| / steps).

#include "accessibility.glsl"
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

    int count = int(settings.samples), steps = int(settings.steps);
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 stride =
            hemisphereOffset(points[i].xyz, mirror, normal) * (settings.radius / float(steps));
        vec3 point = position;
        float nearer;
        int walked = 0;
        do {
            point += stride;
            nearer = max(depth - depthAt(uvFromView(point)), 0.0) / settings.radius;
        } while (++walked < steps && nearer < settings.fullOcclusion);
        sum += accessibility(nearer);
    }
    return vec4(sum / float(count));
}

vec4 blurTile(ivec2 pixel) { return blurByDepthAndNormal(gatherResult, pixel); }
