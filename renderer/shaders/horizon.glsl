// The occlusion of Bavoil, Sainz and Dimitrov 2008 (HBAO): for each direction of the image the
// angle of the tangent plane, t, and of the horizon, h, above the plane through the pixel that
// faces the camera; occlusion is the mean of sin h - sin t, which is the solid angle between them.
// The including file says where taps read depth.
//
// Limit: the uniformly weighted solid angle below the horizon, 1 / 2 pi integral of W (sin h - sin
// t), with W taken where the horizon is raised. Occluders are solid: a horizon blocks all below it.
//
// Where the paper or its samples leave a choice:
// - t + angleBias stops at 90 degrees (with tan(t + bias), as in NVIDIA's SDK, it would turn over).
// - t is that of the tangent plane cut by the plane of eye and line, so a plane reads open wherever
//   it lies in the image.
// - As published, elevation is measured against the camera's axis and not the pixel's line of
//   sight; towards the corners of a wide image the solid angle is thus slightly wrong.

#include "taps.glsl"

vec3 pixelNormal(ivec2 pixel) { return texelFetch(normalBuffer, pixel, 0).xyz; }

// Of the surface at `pixel`, whose place in the noise tile is `tile`.
float horizonOcclusion(ivec2 pixel, ivec2 tile, float depth, float radius, int stride) {
    Lines lines = linesFrom(pixel, tile, depth, radius, stride);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = pixelNormal(pixel);
    // Normals of smooth shading may face away; the tangent plane then stands on edge.
    float facing = min(dot(normal, position), -1e-3 * length(position));
    float bias = radians(settings.angleBias);

    float occlusion = 0.0;
    int directions = int(settings.directions);
    for (int i = 0; i < directions; ++i) {
        vec2 direction = lineDirection(lines, i);
        // One pixel along the line, then along the line of sight onto the tangent plane.
        vec3 across = vec3(direction * frame.size.zw * frame.viewFromUv.xy, 0.0);
        vec3 tangent = across - position * (dot(normal, across) / facing);
        float sinTangent = clamp(tangent.z * inversesqrt(dot(tangent, tangent)), -1.0, 1.0);
        float sinHorizon = sin(min(asin(sinTangent) + bias, 1.57079633));

        for (int step = 0; step < lines.steps; ++step) {
            vec3 surface;
            if (!tapSurface(lines, direction, step, surface))
                continue;
            vec3 to = surface - position;
            float distanceSquared = dot(to, to) / (radius * radius);
            float sinTap = to.z * inversesqrt(max(dot(to, to), 1e-30));
            if (distanceSquared < 1.0 && sinTap > sinHorizon) {
                // W = 1 - (t / R)^2 of each rise of the horizon (SDK 10: times an attenuation).
                float weight = 1.0 - settings.attenuation * distanceSquared;
                occlusion += weight * (sinTap - sinHorizon);
                sinHorizon = sinTap;
            }
        }
    }
    return occlusion / float(directions);
}
