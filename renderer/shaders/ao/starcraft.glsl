// StarCraft II's technique (Filion and McNaughton 2008) in the form that de Vries' LearnOpenGL
// (2020) gave it and Puri 2024 (Leeds), section 3.3, measured. Depth and normals.
//
// Departures: the kernel and the tile's vectors are well-spread instead of drawn by chance
// (renderer/techniques/points.h, noise.glsl); the bias is in radii. The range check is kept with its fault: a
// surface R in front of the pixel still counts in full, one at 2 R by half, one at 3 R by 0.26.
//
// Limit: with L and w the kernel's lengths and directions, a plane is open, and beside a step of
// height h at distance d on a floor seen from above, occlusion is smoothstep(R / h) times
// P(L w_x > d and L w_z < h). For R = 1, by 20 million random points: d 0.25 h 0.5: 0.0517; 0.5,
// 0.5: 0.0088; 0.1, 0.2: 0.1028; endless walls at 0.1 and 0.25: 0.1613, 0.0559. A step of 2 gives
// half of the endless wall's, for the check compares what is seen with the floor, not with the
// sample.

#include "box_blur.glsl"
#include "noise.glsl"

// Section 3.3, "Sample kernel": turned about the normal by the tile's vector, made perpendicular to
// it (Gram-Schmidt). The vector lies in the image plane, so a slanted surface's turns are uneven.
mat3 tangentFrame(vec3 normal, vec2 random) {
    vec3 tangent = vec3(random, 0.0) - normal * dot(random, normal.xy);
    float size = length(tangent); // 0 where the normal is the vector; +z is then perpendicular
    tangent = size > 1e-3 ? tangent / size : vec3(0.0, 0.0, 1.0);
    return mat3(tangent, cross(normal, tangent), normal);
}

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = texelFetch(normalBuffer, pixel, 0).xyz;
    mat3 frameOfSurface = tangentFrame(normal, normalize(tileDirection(pixel).xy));

    int count = int(settings.samples);
    float bias = settings.bias * settings.radius;
    float occlusion = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 point = position + frameOfSurface * points[i].xyz * settings.radius;
        float sceneDepth = depthAt(uvFromView(point));
        if (sceneDepth <= -point.z - bias) {
            float apart = max(abs(depth - sceneDepth), 1e-6 * settings.radius);
            occlusion += smoothstep(0.0, 1.0, settings.radius / apart);
        }
    }
    return vec4(1.0 - occlusion / float(count));
}

vec4 blurTile(ivec2 pixel) { return blurByBox(gatherResult, pixel); }
