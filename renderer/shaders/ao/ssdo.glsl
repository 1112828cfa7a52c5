// Screen-space directional occlusion (Ritschel, Grosch and Seidel 2009): points in the hemisphere
// at directions w_i and random lengths up to the radius. A point in front of the surface is open
// and lets the environment's light of its direction in (equation 1, rho / pi L_in V cos dw); the
// surface over any other point sends its own light on instead (equation 2, rho / pi L_pixel A_s
// cos_s cos_r / d^2 with A_s = pi radius^2 / samples, a share of the hemisphere's base).
//
// Departures:
// - Equation 1 is written as ambient light x (open sum / sum over all points), channel by channel.
//   Both have the same limit, but this one is the plain ambient image wherever all points are open,
//   whatever their number, and follows normal maps that occlusion does not see.
// - The distance to a sender is at least `nearestSender` radii where the paper says 1 (of its
//   scene's unit): a number that scales with the scene.
// - A surface more than `thickness` in front of a point does not block it; the paper peels a second
//   depth layer for that.
// - Environment light comes from nine spherical harmonics, sent to the shader for ambient light
//   anyway, not from a map per direction. The noise tile and its blur are the thesis' 4 x 4.
//
// Limit, thickness large and bias 0: visibility is (1/pi) times the integral over the hemisphere of
// cos x the share of [0, radius] along w that is not behind the depth buffer; for a wall at c R
// obscurance with a linear falloff, (1/pi) (acos c + c sqrt(1 - c^2) - 2 c acosh(1/c)). Added light
// likewise: equations 1 and 2 with sums over points replaced by means over w and length.

#include "blur_normal.glsl"
#include "hemisphere.glsl"
#include "noise.glsl"

// Whether the surface at `uv`, over which the point lies, is in front of it. How far is measured
// from the surface's plane: by depth alone, a slope would occlude itself where its pixels are
// large, and beyond the screen's border, where its plane goes on.
bool isBlocked(vec3 point, out vec2 uv) {
    uv = uvFromView(point);
    ivec2 tap = pixelOf(uv);
    vec3 away = (viewPosition(uvOf(tap), depthOf(tap)) - point) / settings.radius;
    return away.z > 0.0 && away.z < settings.thickness && dot(normalOf(tap), away) > settings.bias;
}

// Visibility, then the part of the ambient light's red, green and blue that arrives.
vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalOf(pixel);
    vec3 mirror = tileDirection(pixel);

    int count = int(settings.samples);
    vec4 open = vec4(0.0), total = vec4(0.0);
    for (int i = 0; i < count; ++i) {
        vec3 offset = hemisphereOffset(points[i].xyz, mirror, normal);
        vec3 direction = normalize(offset);
        vec4 light = vec4(dot(direction, normal));
        if (settings.directional > 0.0)
            light.gba *= radianceTowards(mat3(frame.worldFromView) * direction);
        vec2 uv;
        if (!isBlocked(position + offset * settings.radius, uv))
            open += light;
        total += light;
    }
    // Without any light in a channel, or with all points on the horizon, a share has no meaning.
    float visibility = total.r > 0.0 ? open.r / total.r : 1.0;
    return mix(vec4(visibility), open / max(total, vec4(1e-9)), greaterThan(total, vec4(1e-9)));
}

// The light that the blocked directions' surfaces send here, before the receiver's own albedo. What
// they send is the first pass's result, as in the paper, and direct light.
vec4 bounce(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(0.0);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalOf(pixel);
    vec3 mirror = tileDirection(pixel);

    int count = int(settings.samples);
    float nearest = settings.nearestSender * settings.nearestSender;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        vec2 uv;
        vec3 point = position + hemisphereOffset(points[i].xyz, mirror, normal) * settings.radius;
        if (!isBlocked(point, uv))
            continue;
        ivec2 tap = pixelOf(uv);
        vec3 towards = (surfaceOver(uv) - position) / settings.radius;
        float squared = dot(towards, towards);
        if (squared > 1.0 || squared == 0.0) // outside the hemisphere no surface sends
            continue;
        float cosines = max(dot(normal, towards), 0.0) * max(-dot(normalOf(tap), towards), 0.0);
        vec3 light = texelFetch(ambientLight, tap, 0).rgb * texelFetch(gatherResult, tap, 0).gba +
                     texelFetch(directLight, tap, 0).rgb;
        sum += light * (cosines / (squared * max(squared, nearest)));
    }
    return vec4(min(settings.bounceStrength / float(count) * sum, vec3(1e4)),
                0.0); // a half's range
}

// All four channels of a pass, blurred alike.
vec4 blurred(sampler2D values, ivec2 pixel, Window window) {
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            ivec2 other = insideOf(window.corners[i] + quadPlaces[j]);
            sum += window.weights[i][j] * texelFetch(values, other, 0);
            weights += window.weights[i][j];
        }
    return weights > 0.0 ? sum / weights : texelFetch(values, pixel, 0);
}

vec4 shade(ivec2 pixel) {
    vec4 depths[4] = depthsAround(pixel);
    if (isEmpty(depths[3].w))
        return vec4(1.0, 0.0, 0.0, 0.0);
    bool blurs = settings.blur > 0.0;
    Window window;
    if (blurs)
        window = windowByNormal(pixel, depths);
    vec4 arriving =
        blurs ? blurred(gatherResult, pixel, window) : texelFetch(gatherResult, pixel, 0);
    vec3 added = texelFetch(ambientLight, pixel, 0).rgb * (arriving.gba - arriving.r);
    if (settings.bounce > 0.0) {
        vec4 sent =
            blurs ? blurred(bounceResult, pixel, window) : texelFetch(bounceResult, pixel, 0);
        added += texelFetch(albedoBuffer, pixel, 0).rgb * sent.rgb;
    }
    return vec4(arriving.r, added);
}
