// What the visibility bitmask and its successor share: 32 sectors of equal weight in each slice,
// and which of them a tap of a certain thickness blocks. Who includes this defines blockedIn().

#include "adaptive.glsl"
#include "edges.glsl"
#include "noise.glsl"
#include "slices.glsl"

// The share of a side's open integral up to the direction of `offset`, which points to that side;
// `whole` from the surface's own plane on.
float shareOf(vec2 offset, vec2 ofTurn, float whole) {
    vec2 ofA = offset * inversesqrt(max(dot(offset, offset), 1e-30));
    return dot(ofA, ofTurn) > 0.0 ? arcWeight(arcCosine(ofA.x), ofA, ofTurn) : whole;
}

uint bitsBetween(int first, int last) {
    uint upTo = last >= 32 ? 0xffffffffu : (1u << uint(max(last, 0))) - 1u;
    return first >= 32 ? 0u : upTo & (0xffffffffu << uint(max(first, 0)));
}

// The sectors that a tap on one side of a slice blocks. They are counted from the end of the
// negative side to that of the positive; `place` is where within each its ray lies. `thickness` is
// in metres along the view.
uint blockedBy(Tap tap, Slice slice, float direction, float place, float thickness) {
    vec2 ofTurn = vec2(slice.cosine, direction * slice.sine);
    vec2 back = tap.offset - vec2(thickness, 0.0);
    float whole = sideWeight(direction * slice.turn, ofTurn);
    vec2 arc = vec2(shareOf(tap.offset, ofTurn, whole), shareOf(back, ofTurn, whole));
    float middle = sideWeight(-slice.turn, vec2(slice.cosine, -slice.sine));
    vec2 ends = 32.0 * slice.perWeight * (middle + direction * arc) + place;
    ivec2 sectors = ivec2(floor(direction > 0.0 ? ends : ends.yx));
    bool near = tap.seen && tap.distance <= settings.radius * settings.radius;
    return near ? bitsBetween(sectors.x, sectors.y) : 0u;
}

// The sectors of a slice that its taps block; `noise` says where along the slice they lie.
uint blockedIn(Point p, Slice slice, float place, float noise, int index);

vec4 openOver(ivec2 pixel, int sliceCount) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    Point p = pointOf(pixel, depth);
    uvec2 random = hilbertBits(pixel);
    vec2 noise = hilbertFloats(random);
    int blocked = 0;
    int i = 0;
    do {
        Slice slice = sliceOf(p, (float(i) + noise.x) / float(sliceCount));
        // Within every sector; not at its ends, where rounding would let a plane block its own.
        float place = mix(0.001, 0.999, unitFloat(hash(random.x + uint(i))));
        blocked += bitCount(blockedIn(p, slice, place, noise.y, i));
    } while (++i < sliceCount);
    return vec4(1.0 - float(blocked) / (32.0 * float(sliceCount)));
}

vec4 survey(ivec2 block) { return openOver(middleOf(block), 1); }
vec4 counts(ivec2 block) { return vec4(slicesFor(surveyResult, block)); }
vec4 gather(ivec2 pixel) { return openOver(pixel, slicesOf(countsResult, pixel)); }

vec4 denoiseOnce(ivec2 pixel) { return denoised(gatherResult, pixel, settings.denoise < 1.5); }
vec4 denoiseTwice(ivec2 pixel) {
    return denoised(denoiseOnceResult, pixel, settings.denoise < 2.5);
}
vec4 denoiseThrice(ivec2 pixel) { return denoised(denoiseTwiceResult, pixel, true); }
