// Occlusion by spheres (Shanmugam and Arikan 2007). One formula serves both of the paper's passes:
// a sphere of radius r at distance d blocks the cap of 2 pi (1 - cos asin(r / d)) steradians, all
// of it under the cosine of the direction to its centre; contributions are summed, divided by pi.
// High frequency ("detail"): neighbouring pixels stand for themselves, each as a sphere whose disc
// is its share of the search disc, so that its effect falls with the square of the distance. The
// nearer the camera, the more of them. Low frequency ("distant"): spheres fitted to the scene's
// meshes (renderer/scene/proxies.h) are splatted over the pixels that they may reach.
//
// Facts are from Jakobsen 2010, chapter 2, and other later accounts: the paper itself was not at
// hand. The sum forgets that occluders hide each other: it double-counts, the paper's known fault,
// kept. Departures:
// - A surface must not occlude itself by its own sphere. Fitted spheres have their centres on or
//   inside what they stand for, so their cosine is 0 or less there; and every sphere counts nothing
//   inside itself and fades in over `nearFade` radii outside, where its caps are too wide to be
//   true.
// - A splat must end somewhere: its effect fades to nothing at `distantReach`. Details end at the
//   radius.
// - Fitted spheres enclose patches, and those of a wall's far side count too; `sphereSize` makes up
//   for that.
//
// Limits: one sphere, far inside all fades: visibility 1 - 2 (1 - sqrt(1 - r^2/d^2)) cos.
// Infinitely many pixels, bias 0: occlusion proxySize^2 / pi times the integral of cos / d^2 over
// the area that faces the camera, of what lies within the radius. It has no bound in a crease.

#include "blur_normal.glsl"
#include "noise.glsl"

// Of a sphere at `centre`, seen from the origin.
float capOcclusion(vec3 centre, float radius, vec3 normal) {
    float distance = max(length(centre), 1e-12);
    float sine = min(radius / distance, 1.0);
    float cosine = max(dot(normal, centre) / distance - settings.bias, 0.0);
    float outside = (distance - radius) / max(settings.nearFade * radius, 1e-12);
    return 2.0 * (1.0 - sqrt(1.0 - sine * sine)) * cosine * clamp(outside, 0.0, 1.0);
}

vec4 detail(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalOf(pixel);
    vec3 tile = tileDirection(pixel);
    float turn = atan(tile.y, tile.x);

    float pixels = settings.radius / depth * frame.depth.w * frame.size.y; // the disc's radius
    float wanted = 3.14159265 * pixels * pixels / settings.pixelsPerTap;
    int count = int(min(settings.samples, max(wanted, 4.0)));
    float size = settings.proxySize * inversesqrt(float(count)); // of a sphere, in radii
    float occlusion = 0.0;
    for (int i = 0; i < count; ++i) {
        float angle = 6.28318531 * points[i].x + turn;
        float reach = sqrt(fract(points[i].y + 0.5 * tile.z));
        vec2 offset = reach * vec2(cos(angle), sin(angle));
        vec3 tap = surfaceOver(uvFromView(position + vec3(offset * settings.radius, 0.0)));
        vec3 towards = (tap - position) / settings.radius;
        if (dot(towards, towards) < 1.0)
            occlusion += capOcclusion(towards, size, normal);
    }
    return vec4(1.0 - min(occlusion, 1e3));
}

vec4 distant(ivec2 pixel, vec4 sphere) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(0.0);
    vec3 centre = (sphere.xyz - viewPosition(uvOf(pixel), depth)) / settings.radius;
    float radius = sphere.w / settings.radius;
    float gap = max(length(centre) - radius, 0.0) / settings.distantReach;
    float fade = max(1.0 - gap * gap, 0.0);
    return vec4(fade > 0.0 ? fade * fade * capOcclusion(centre, radius, normalOf(pixel)) : 0.0);
}

vec4 combine(ivec2 pixel) {
    if (isEmpty(depthOf(pixel)))
        return vec4(1.0);
    float visibility = 1.0;
    if (settings.detail > 0.0)
        visibility = settings.blur > 0.0 ? blurByDepthAndNormal(detailResult, pixel).r
                                         : texelFetch(detailResult, pixel, 0).r;
    if (settings.distant > 0.0)
        visibility -= texelFetch(distantResult, pixel, 0).r;
    return vec4(visibility);
}
