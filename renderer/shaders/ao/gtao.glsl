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
// Ours: with `layers` above 1 a tap raises the horizon to the highest of its layers. What lies
// behind never blocks more than what it lies behind, unless that is too near to the camera to
// count: then it stands in.
//
// Limit with a hard radius (falloff 0): the cosine-weighted share of directions above the horizon,
// the highest thing within the radius, slice by slice. Beside a curb of height h at distance d,
// seen from above, with tan a = d / (h cos phi) where the rim is within the radius, and pi/2
// elsewhere:
//   visibility = 1 - (mean over 0 < phi < pi/2 of cos^2 a) / 2
// (occlusion 0.2676, 0.1273, 0.2760, 0 for the curbs of sheet A.3). It differs from ray-tracing the
// depth buffer as a height field only where the rim lies beyond the radius. With falloff, each
// tap's cosine c becomes mix(cosine of the plane, c, weight) before the maximum is taken.

#include "adaptive.glsl"
#include "edges.glsl"
#include "layers.glsl"
#include "slices.glsl"

// Int_0^a of cos(t - turn) sin t times sin t and cos t: how far directions up to `a` lean to the
// side and to the view. Their sum over both sides is a slice's share of the bent normal. Angles are
// given by cosine and sine.
vec2 arcLean(vec2 ofA, vec2 ofTurn) {
    vec2 parts = ofA * ofTurn.yx; // cos a sin t, sin a cos t
    float cosines = ofA.x * ofTurn.x, sines = ofA.y * ofTurn.y;
    float square = 4.0 * ofA.x * ofA.x;
    float tripleSine = parts.y * (square - 1.0) - parts.x * (square - 3.0);
    float tripleCosine = cosines * (square - 3.0) + sines * (square - 1.0);
    return vec2(6.0 * (parts.y - parts.x) - tripleSine - 3.0 * (parts.y + parts.x) + 8.0 * ofTurn.y,
                4.0 * ofTurn.x - tripleCosine - 3.0 * (cosines - sines)) /
           12.0;
}

// A tap's cosine of the angle from the view, faded towards the plane's.
float faded(Tap tap, float plane) {
    float stretch = (1.0 + settings.thinOccluder) * (1.0 + settings.thinOccluder) - 1.0;
    float distance = sqrt(tap.distance + stretch * tap.along * tap.along);
    float fade = settings.radius * max(settings.falloff, 1e-4);
    float weight = clamp((settings.radius - distance) / fade, 0.0, 1.0);
    float cosine = tap.offset.x * inversesqrt(max(dot(tap.offset, tap.offset), 1e-30));
    return tap.seen ? mix(plane, cosine, weight) : plane;
}

// The highest of a tap's layers, as a cosine.
float highest(Point p, Slice slice, float direction, float reach, float place, float plane) {
    Tap tap = tapAt(p, slice, direction, reach, place);
    float cosine = faded(tap, plane);
    for (int i = 1; i < int(settings.layers); ++i)
        cosine = max(cosine, faded(tapBehind(p, slice, direction, reach, tap, i), plane));
    return cosine;
}

// The cosines of the angles from the view to the highest thing on both sides of a slice; cos(turn +
// pi/2) where that is the surface's own plane.
vec2 horizonsOf(Point p, Slice slice, float noise, int index) {
    vec2 plane = vec2(-slice.sine, slice.sine), horizons = plane, reaches = reachesOf(p, slice);
    int j = 0;
    do {
        float place = tapPlace(noise, index, j);
        horizons = max(horizons, vec2(highest(p, slice, 1.0, reaches.x, place, plane.x),
                                      highest(p, slice, -1.0, reaches.y, place, plane.y)));
    } while (++j < int(settings.steps));
    return horizons;
}

// What one side of a slice adds to visibility and, as a vector in view space, to the mean open
// direction.
float openOf(Slice slice, float direction, vec2 horizon) {
    return arcWeight(arcCosine(horizon.x), horizon, vec2(slice.cosine, direction * slice.sine));
}
vec3 leanOf(Point p, Slice slice, float direction, vec2 horizon) {
    vec2 lean = arcLean(horizon, vec2(slice.cosine, direction * slice.sine));
    return lean.x * direction * slice.side + lean.y * p.view;
}

// The minimum is meant for the final visibility. It becomes the bound of v that gives it.
float atLeastMinimum(float v) {
    float minimum = settings.minimumVisibility;
    if (settings.power < 0.0)
        minimum = max(minimum, 1e-6); // nothing becomes 0, and pow(0) would be undefined
    float least = pow(minimum, 1.0 / settings.power);
    return max(v, 1.0 - sign(settings.power) * (1.0 - least) / max(settings.intensity, 1e-6));
}

// Visibility, and where bent normals are asked for the mean open direction (view space;
// cosine-weighted, so of length 2/3 when all is open).
vec4 openOver(ivec2 pixel, int sliceCount, bool bent) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0, 0.0, 0.0, 0.0);
    Point p = pointOf(pixel, depth);
    vec2 noise = hilbertNoise(pixel);
    vec4 sum = vec4(0.0);
    int i = 0;
    do {
        Slice slice = sliceOf(p, (float(i) + noise.x) / float(sliceCount));
        vec2 horizons = horizonsOf(p, slice, noise.y, i);
        vec2 sines = sqrt(max(1.0 - horizons * horizons, 0.0));
        vec2 ahead = vec2(horizons.x, sines.x), behind = vec2(horizons.y, sines.y);
        sum.x += slice.perWeight * (openOf(slice, 1.0, ahead) + openOf(slice, -1.0, behind));
        if (bent)
            sum.yzw +=
                slice.perWeight * (leanOf(p, slice, 1.0, ahead) + leanOf(p, slice, -1.0, behind));
    } while (++i < sliceCount);
    return sum / float(sliceCount);
}

vec4 survey(ivec2 block) { return openOver(middleOf(block), 1, false); }
vec4 counts(ivec2 block) { return vec4(slicesFor(surveyResult, block)); }

vec4 bounded(vec4 open, bool last) { return last ? vec4(atLeastMinimum(open.r), open.gba) : open; }
vec4 gathered(ivec2 pixel, bool bent) {
    return bounded(openOver(pixel, slicesOf(countsResult, pixel), bent), settings.denoise < 0.5);
}
vec4 gather(ivec2 pixel) { return gathered(pixel, false); }
vec4 gatherWide(ivec2 pixel) { return gathered(pixel, true); }

vec4 denoiseOnce(ivec2 pixel) {
    bool last = settings.denoise < 1.5;
    return bounded(denoised(gatherResult, pixel, last), last);
}
vec4 denoiseOnceWide(ivec2 pixel) {
    bool last = settings.denoise < 1.5;
    return bounded(denoisedAll(gatherResult, pixel, last), last);
}
vec4 denoiseTwice(ivec2 pixel) {
    bool last = settings.denoise < 2.5;
    return bounded(denoised(denoiseOnceResult, pixel, last), last);
}
vec4 denoiseTwiceWide(ivec2 pixel) {
    bool last = settings.denoise < 2.5;
    return bounded(denoisedAll(denoiseOnceResult, pixel, last), last);
}
vec4 denoiseThrice(ivec2 pixel) { return bounded(denoised(denoiseTwiceResult, pixel, true), true); }
vec4 denoiseThriceWide(ivec2 pixel) {
    return bounded(denoisedAll(denoiseTwiceResult, pixel, true), true);
}

vec4 denoisedGather(ivec2 pixel) {
    if (settings.denoise < 0.5)
        return texelFetch(gatherResult, pixel, 0);
    if (settings.denoise < 1.5)
        return texelFetch(denoiseOnceResult, pixel, 0);
    return settings.denoise < 2.5 ? texelFetch(denoiseTwiceResult, pixel, 0)
                                  : texelFetch(denoiseThriceResult, pixel, 0);
}

// The light to add: the scattered ambient light around the mean open direction less that around the
// normal, which the composite adds by itself; what metals mirror stays. Both are multiplied by the
// final visibility, so that hardly a sum is negative.
vec4 bentLight(ivec2 pixel) {
    vec4 denoised = denoisedGather(pixel);
    float v = denoised.r;
    vec3 bent = denoised.gba;
    if (isEmpty(depthOf(pixel)) || dot(bent, bent) < 1e-12)
        return vec4(v, vec3(0.0));
    mat3 worldFromView = mat3(frame.worldFromView);
    vec3 fromBent = irradianceAt(worldFromView * normalize(bent));
    vec3 fromNormal = irradianceAt(worldFromView * texelFetch(normalBuffer, pixel, 0).xyz);
    vec4 albedo = texelFetch(albedoBuffer, pixel, 0); // alpha: metallic
    return vec4(v, albedo.rgb * (1.0 - albedo.a) * (fromBent - fromNormal) / pi *
                       finalVisibility(v));
}
