// The technique rtao with its rays traced here, against a tree of the scene's triangles
// (tree.glsl). Its rays are the same, and so is its picture, up to rounding.
//
// Limit with infinitely many rays and no filter: the ray-traced reference itself.

#include "hilbert.glsl"
#include "ray_filter.glsl"
#include "tree.glsl"

// Even over the unit sphere.
vec3 spherePoint(uint index) {
    vec2 point = hilbertFloats(index * uvec2(3242174889u, 2447445414u)); // hilbertBits()
    float ring = 2.0 * sqrt(point.x * (1.0 - point.x)), angle = 6.28318531 * point.y;
    return vec3(ring * vec2(cos(angle), sin(angle)), 1.0 - 2.0 * point.x);
}

// Rays start as those of few_rays.cpp do.
vec4 gather(ivec2 pixel) {
    float depth = depthInside(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    depth -= 0.5 * depth * (frame.depthStep.x + depth * frame.depthStep.y);
    vec3 seen = viewPosition(uvOf(pixel), depth), view = -normalize(seen);
    vec3 normal = texelFetch(normalBuffer, pixel, 0).xyz;
    normal = dot(normal, normal) > 0.9 ? normalize(normal) : view;
    vec3 camera = abs(frame.worldFromView[3].xyz);
    float farthest = max(max(camera.x, camera.y), max(camera.z, frame.depth.y));
    float offset =
        0.008 * depth * abs(frame.viewFromUv.y) * frame.size.w + 9.5367432e-7 * farthest;
    vec3 origin = (frame.worldFromView * vec4(seen + offset * (normal + view), 1.0)).xyz;
    normal = mat3(frame.worldFromView) * normal;
    uint rays = uint(settings.rays);
    uint first = (hilbertIndex(pixel) + 288u * uint(frame.seed.x + frame.seed.y)) * rays;
    float open = 0.0;
    for (uint i = 0u; i < rays; ++i) {
        vec3 ray = normal + spherePoint(first + i);
        ray *= inversesqrt(dot(ray, ray) + 1e-12);
        open += isBlocked(origin, ray, settings.radius) ? 0.0 : 1.0;
    }
    return vec4(open / settings.rays);
}
