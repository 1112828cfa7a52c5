// What the two forms of Crytek's technique share: cube corners turned by the noise tile, with
// lengths growing geometrically, tested against the depth buffer (Jakobsen 2010, appendix A, after
// Kajalin, ShaderX7 2009). The forms differ in the ball's length along the view, in its width, and
// in when a nearer surface's sample fades to neutral.
float ballLength();
float tooNear(float depth, float sceneDepth);

#include "blur.glsl"
#include "noise.glsl"

// Step A1: the rotation that the tile's random vector stands for.
mat3 tileRotation(vec3 v) {
    float h = 1.0 / (1.0 + v.z);
    return mat3(h * v.y * v.y + v.z, -h * v.y * v.x, -v.x, // first row of the appendix
                -h * v.y * v.x, h * v.x * v.x + v.z, -v.y, //
                v.x, v.y, v.z);
}

vec4 boostedAccessibility(ivec2 pixel) {
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
        float pointDepth = depth + offset.z * ballLength() * depth;
        float sceneDepth = depthAt(uv + offset.xy * uvScale);
        float open = sceneDepth > pointDepth ? 1.0 : 0.0;
        accessibility += isEmpty(sceneDepth) ? 1.0 : mix(open, 0.5, tooNear(depth, sceneDepth));
    }
    accessibility /= float(count);
    return vec4(clamp(accessibility * accessibility + accessibility, 0.0, 1.0));
}
