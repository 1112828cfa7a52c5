// Crytek 2007 in the form of Jakobsen 2010, appendix A (after Kajalin, ShaderX7 2009). Depth only.
//
// In the limit it is the open fraction of a ball around the pixel, then a non-linear boost: an open
// plane reads 0.5 -> 0.75, a right-angled convex edge 0.75 -> 1 (the bright edges of the
// technique), a concave one 0.25 -> 0.3125. All three are faithful, not faults of this file.
//
// Two departures, both so that the radius can be matched in metres. The appendix leaves offsets in
// texture coordinates, an ellipse 16/9 wider than tall; ours are round on screen. And it scales the
// depth offset by the depth itself, which is a sphere only at a field of view of 53 degrees; ours is
// a sphere at any. As in the appendix, the ball is constant on screen: it has `radius` metres at
// the focus distance and grows in proportion to depth.

#include "blur.glsl"
#include "noise.glsl"

// Step A1: the rotation that the tile's random vector stands for.
mat3 tileRotation(vec3 v) {
    float h = 1.0 / (1.0 + v.z);
    return mat3(h * v.y * v.y + v.z, -h * v.y * v.x, -v.x, // first row of the appendix
                -h * v.y * v.x, h * v.x * v.x + v.z, -v.y, //
                v.x, v.y, v.z);
}

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    mat3 rotation = tileRotation(tileDirection(pixel));
    vec2 uv = uvOf(pixel);

    // Step A2: cube corners, lengths growing geometrically; the last one is the radius.
    int count = max(int(settings.samples) / 8, 1) * 8;
    float growth = 1.0 + 2.4 / float(count);
    float scale = settings.radius / frame.depth.z * pow(growth, -float(count));
    vec2 uvScale = frame.depth.w * vec2(frame.size.y / frame.size.x, 1.0);

    float accessibility = 0.0;
    for (int i = 0; i < count; ++i) {
        scale *= growth;
        vec3 corner = vec3(ivec3(i >> 2, i >> 1, i) & 1) * 2.0 - 1.0;
        // GLSL's matrices hold columns, HLSL's rows: corner times rotation, as in the appendix.
        vec3 offset = rotation * (corner * (0.577350269 * scale));

        // Step A3: is the point in front of what the depth buffer holds there?
        float pointDepth = depth + offset.z * depth;
        float sceneDepth = depthAt(uv + offset.xy * uvScale);
        float tooNear = clamp((depth - sceneDepth) / (settings.range * settings.radius), 0.0, 1.0);
        float open = sceneDepth > pointDepth ? 1.0 : 0.0;
        accessibility += isEmpty(sceneDepth) ? 1.0 : mix(open, 0.5, tooNear);
    }
    accessibility /= float(count);
    return vec4(clamp(accessibility * accessibility + accessibility, 0.0, 1.0));
}

vec4 blurTile(ivec2 pixel) { return blurByDepth(gatherResult, pixel); }
