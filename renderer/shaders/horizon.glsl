// The occlusion of Bavoil, Sainz and Dimitrov 2008 (HBAO): for each direction of the image the
// angle of the tangent plane, t, and of the horizon, h, above the plane through the pixel that
// faces the camera; occlusion is the mean of sin h - sin t, which is the solid angle between them.
// The including file says where taps read depth.
//
// Limit: the uniformly weighted solid angle below the horizon, 1 / 2 pi integral of W (sin h - sin
// t), with W taken where the horizon is raised. Occluders are solid: a horizon blocks all below it.
//
// Where the paper or its samples leave a choice:
// - The tangent is that of the tangent plane under the tap's own pixel, not under the line that the
//   tap was rounded from, so a plane reads open wherever it lies in the image. (NVIDIA's SDKs round
//   the step instead and reuse one tangent.)
// - t + angleBias stops at 90 degrees; tan(t + bias), as in the SDKs, would turn over.
// - As published, elevation is measured against the camera's axis and not the pixel's line of
//   sight; towards the corners of a wide image the solid angle is thus slightly wrong.

#include "blur_normal.glsl"
#include "taps.glsl"

// sin(t + bias) for a tangent vector.
float biasedSine(vec3 tangent, vec2 biasCosSin) {
    float sine = clamp(tangent.z * inversesqrt(dot(tangent, tangent)), -1.0, 1.0);
    return sine >= biasCosSin.x ? 1.0
                                : sine * biasCosSin.x + sqrt(1.0 - sine * sine) * biasCosSin.y;
}

// Of the surface at `pixel`, whose place in the noise tile is `tile`.
float horizonOcclusion(ivec2 pixel, ivec2 tile, float depth, float radius, int stride) {
    Lines lines = linesFrom(pixel, tile, depth, radius, stride);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalOf(pixel);
    // Normals of smooth shading may face away; the tangent plane then stands on edge.
    float facing = min(dot(normal, position), -1e-3 * length(position));
    float bias = radians(settings.angleBias);
    vec2 biasCosSin = vec2(cos(bias), sin(bias));

    float occlusion = 0.0;
    int directions = int(settings.directions);
    for (int i = 0; i < directions; ++i) {
        vec2 direction = lineDirection(lines, i);
        float horizon = 0.0; // the largest sin h - sin(t + bias) so far
        for (int step = 0; step < lines.steps; ++step) {
            ivec2 tap = tapPixel(lines, direction, step);
            vec3 surface;
            if (!tapSurface(tap, stride, surface))
                continue;
            vec3 to = surface - position;
            float squared = dot(to, to) / (radius * radius);
            if (squared >= 1.0)
                continue;
            // From one pixel to the other, then along the line of sight onto the tangent plane.
            vec3 across = vec3((uvOf(tap) - uvOf(pixel)) * frame.viewFromUv.xy, 0.0);
            vec3 tangent = across - position * (dot(normal, across) / facing);
            float rise =
                to.z * inversesqrt(max(dot(to, to), 1e-30)) - biasedSine(tangent, biasCosSin);
            if (rise > horizon) {
                // W = 1 - (t / R)^2 of each rise of the horizon (SDK 10: times an attenuation).
                occlusion += (1.0 - settings.attenuation * squared) * (rise - horizon);
                horizon = rise;
            }
        }
    }
    return occlusion / float(directions);
}
