// Blizzard 2008 (StarCraft II) as printed in Jakobsen 2010, appendix B. Depth and normals.
//
// Limits: a plane seen face-on is open (1). On a symmetric groove whose sides rise at 45 degrees,
// seen from straight above, a point of the half-ball |x| aside meets a surface |x| nearer, and |x|
// has density 3/2 (1 - x^2): visibility at the bottom is the mean of accessibility(|x|) over that.

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

    int count = int(settings.samples);
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 offset = hemisphereOffset(points[i].xyz, mirror, normal) * settings.radius;
        float sceneDepth = depthAt(uvFromView(position + offset));
        sum += accessibility(max(depth - sceneDepth, 0.0) / settings.radius);
    }
    return vec4(sum / float(count));
}

vec4 blurTile(ivec2 pixel) { return blurByDepthAndNormal(gatherResult, pixel); }
