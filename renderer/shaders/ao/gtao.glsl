// Ground-truth ambient occlusion: Jimenez et al. 2016 with the parameters, noise, depth levels and
// denoiser of XeGTAO 1.30 (Strugar and McCalla 2021). Along each side of a slice the taps raise a
// horizon; the cosine-weighted integral above both horizons is closed (equations 6 and 7 of the
// paper, here arcWeight; XeGTAO's own form under-occludes oblique surfaces: three.js #33632).
//
// Taps fade out towards the radius by pulling the horizon back to the plane through the pixel, as
// XeGTAO does, and not to the view's far side as in the paper: that depends less on the view.
//
// Departures: slices.glsl draws slices by weight and moves taps into them, so that XeGTAO's pull of
// 5 % on the projected normal's length and its bias on the centre's depth are not needed; its march
// covers the whole sphere and ends at the screen's border. XeGTAO's fade for radii below 10 pixels
// is left out. Power is applied after denoising, and so is the minimum visibility.
//
// Limit with a hard radius (falloff 0): the cosine-weighted share of directions above the horizon,
// the highest thing within the radius, slice by slice. Beside a curb of height h at distance d, seen
// from above, with tan a = d / (h cos phi) where the rim is within the radius, and pi/2 elsewhere:
//   visibility = 1 - (mean over 0 < phi < pi/2 of cos^2 a) / 2
// (occlusion 0.2676, 0.1273, 0.2760, 0 for the curbs of sheet A.3). It differs from ray-tracing the
// depth buffer as a height field only where the rim lies beyond the radius. With falloff, each tap's
// cosine c becomes mix(cosine of the plane, c, weight) before the maximum is taken.

#include "edges.glsl"
#include "slices.glsl"

// Int_0^a of cos(t - turn) sin t times sin t and cos t: how far directions up to `a` lean to the
// side and to the view. Their sum over both sides is a slice's share of the bent normal.
vec2 arcLean(float a, float turn) {
    return vec2(6.0 * sin(a - turn) - sin(3.0 * a - turn) - 3.0 * sin(a + turn) + 8.0 * sin(turn),
                4.0 * cos(turn) - cos(3.0 * a - turn) - 3.0 * cos(a + turn)) /
           12.0;
}

// Visibility, and the mean open direction (view space; cosine-weighted, so of length 2/3 when all
// is open).
vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0, 0.0, 0.0, 0.0);
    Point p = pointOf(pixel, depth);
    vec2 noise = hilbertNoise(pixel);
    int sliceCount = int(settings.slices), steps = int(settings.steps);
    float fade = settings.radius * max(settings.falloff, 1e-4);
    float stretch = (1.0 + settings.thinOccluder) * (1.0 + settings.thinOccluder) - 1.0;

    float visibility = 0.0;
    vec3 bent = vec3(0.0);
    for (int i = 0; i < sliceCount; ++i) {
        Slice slice = sliceOf(p, (float(i) + noise.x) / float(sliceCount));
        for (float direction = -1.0; direction < 2.0; direction += 2.0) {
            vec3 side = direction * slice.side;
            float turn = direction * slice.turn;
            March march = marchOf(p, side);
            float plane = -sin(turn); // cosine of the angle turn + pi/2
            float horizon = plane;
            for (int j = 0; j < steps && march.reach >= 1.0; ++j) {
                Tap tap;
                if (!tapAt(p, slice, march, tapPlace(noise.y, i, j), side, tap))
                    continue;
                float distance =
                    sqrt(tap.distance * tap.distance + stretch * tap.along * tap.along);
                float weight = clamp((settings.radius - distance) / fade, 0.0, 1.0);
                horizon = max(horizon, mix(plane, tap.offset.x / length(tap.offset), weight));
            }
            float sine = sqrt(max(1.0 - horizon * horizon, 0.0));
            float a = atan(sine, horizon); // acos() of software drivers is good to 3e-4 only
            visibility += arcWeight(a, vec2(horizon, sine), turn) / slice.weight;
            vec2 lean = arcLean(a, turn) / slice.weight;
            bent += settings.bentNormals * (lean.x * side + lean.y * p.view);
        }
    }
    return vec4(visibility, bent) / float(sliceCount);
}

vec4 denoiseOnce(ivec2 pixel) { return denoised(gatherResult, pixel, settings.denoise < 1.5); }
vec4 denoiseTwice(ivec2 pixel) {
    return denoised(denoiseOnceResult, pixel, settings.denoise < 2.5);
}
vec4 denoiseThrice(ivec2 pixel) { return denoised(denoiseTwiceResult, pixel, true); }

vec4 denoisedGather(ivec2 pixel) {
    if (settings.denoise < 0.5)
        return texelFetch(gatherResult, pixel, 0);
    if (settings.denoise < 1.5)
        return texelFetch(denoiseOnceResult, pixel, 0);
    return settings.denoise < 2.5 ? texelFetch(denoiseTwiceResult, pixel, 0)
                                  : texelFetch(denoiseThriceResult, pixel, 0);
}

// The minimum is one of the final visibility, 1 - intensity (1 - v) to the power: what v gives it?
vec4 visibility(ivec2 pixel) {
    float least = pow(settings.minimumVisibility, 1.0 / settings.power);
    float v = denoisedGather(pixel).r;
    return vec4(max(v, 1.0 - (1.0 - least) / max(settings.intensity, 1e-6)));
}

// What the ambient light, which the composite takes from the normal's side, lacks of the light
// around the mean open direction. Both times the final visibility, so that the sum is never
// negative.
vec4 bentLight(ivec2 pixel) {
    float v = texelFetch(visibilityResult, pixel, 0).r;
    vec3 bent = denoisedGather(pixel).gba;
    if (isEmpty(depthOf(pixel)) || dot(bent, bent) < 1e-12)
        return vec4(v, vec3(0.0));
    mat3 worldFromView = mat3(frame.worldFromView);
    vec3 fromBent = irradianceAt(worldFromView * normalize(bent));
    vec3 fromNormal = irradianceAt(worldFromView * texelFetch(normalBuffer, pixel, 0).xyz);
    float final = min(pow(max(1.0 - settings.intensity * (1.0 - v), 0.0), settings.power), 1.0);
    return vec4(v, texelFetch(albedoBuffer, pixel, 0).rgb * (fromBent - fromNormal) / pi * final);
}
