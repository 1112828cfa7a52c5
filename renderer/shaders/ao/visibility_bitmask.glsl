// Visibility bitmask (Therrien, Levesque and Gilet 2023): instead of two horizons, each slice keeps
// 32 bits, one per sector of the half-plane above the surface. Every tap blocks the sectors between
// its front and a point `thickness` behind it, so light may pass behind it.
//
// Departures. Sectors of equal angle, as in the paper, weigh directions near the view too much
// (an open corner then reads 0.50 to 0.66 by camera, instead of 0.50). Here the sectors' edges are
// warped so that each holds the same cosine-weighted solid angle: the share of a slice below angle
// a is closed (arcWeight of slices.glsl over its total), and only that direction of the mapping is
// needed. Edges are not rounded to whole sectors but compared with one place within each sector,
// drawn anew per slice: every bit is then a ray, and the mean over slices has no rounding bias.
//
// Ours: with `layers` above 1 each further layer of a tap blocks its sectors too, as thick as the
// first.
//
// Limit: cosine-weighted visibility where the surface of every pixel within the radius is a sheet
// of that thickness along the view; per slice, 1 - the share of the union of the taps' arcs. With
// thickness without end, GTAO's with a hard radius.

#include "adaptive.glsl"
#include "edges.glsl"
#include "layers.glsl"
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
// negative side to that of the positive; `place` is where within each its ray lies.
uint blockedBy(Tap tap, Slice slice, float direction, float place) {
    vec2 ofTurn = vec2(slice.cosine, direction * slice.sine);
    vec2 back = tap.offset - vec2(settings.thickness * settings.radius, 0.0);
    float whole = sideWeight(direction * slice.turn, ofTurn);
    vec2 arc = vec2(shareOf(tap.offset, ofTurn, whole), shareOf(back, ofTurn, whole));
    float middle = sideWeight(-slice.turn, vec2(slice.cosine, -slice.sine));
    vec2 ends = 32.0 * slice.perWeight * (middle + direction * arc) + place;
    ivec2 sectors = ivec2(floor(direction > 0.0 ? ends : ends.yx));
    bool near = tap.seen && tap.distance <= settings.radius * settings.radius;
    return near ? bitsBetween(sectors.x, sectors.y) : 0u;
}

// The same of all layers of one tap.
uint blockedAt(Point p, Slice slice, float direction, float reach, float along, float place) {
    Tap tap = tapAt(p, slice, direction, reach, along);
    uint bits = blockedBy(tap, slice, direction, place);
    for (int i = 1; i < int(settings.layers); ++i)
        bits |= blockedBy(tapBehind(p, slice, direction, reach, tap, i), slice, direction, place);
    return bits;
}

uint blockedIn(Point p, Slice slice, float place, float noise, int index) {
    vec2 reaches = reachesOf(p, slice);
    uint bits = 0u;
    int j = 0;
    do {
        float along = tapPlace(noise, index, j);
        bits |= blockedAt(p, slice, 1.0, reaches.x, along, place) |
                blockedAt(p, slice, -1.0, reaches.y, along, place);
    } while (++j < int(settings.steps));
    return bits;
}

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
