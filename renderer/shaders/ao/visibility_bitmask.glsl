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
// Limit: cosine-weighted visibility where the surface of every pixel within the radius is a sheet
// of that thickness along the view; per slice, 1 - the share of the union of the taps' arcs. With
// thickness without end, GTAO's with a hard radius.

#include "edges.glsl"
#include "noise.glsl"
#include "slices.glsl"

// The share of a side's open integral up to the direction of `offset`.
float shareOf(vec2 offset, float turn) {
    float a = atan(offset.y, offset.x);
    return a >= turn + 0.5 * pi ? sideWeight(turn) : arcWeight(a, normalize(offset), turn);
}

uint bitsBetween(int first, int last) {
    uint upTo = last >= 32 ? 0xffffffffu : (1u << uint(max(last, 0))) - 1u;
    return first >= 32 ? 0u : upTo & (0xffffffffu << uint(max(first, 0)));
}

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    Point p = pointOf(pixel, depth);
    vec2 noise = hilbertNoise(pixel);
    int sliceCount = int(settings.slices), steps = int(settings.steps);
    float thickness = settings.thickness * settings.radius;

    int blocked = 0;
    for (int i = 0; i < sliceCount; ++i) {
        Slice slice = sliceOf(p, (float(i) + noise.x) / float(sliceCount));
        // Within every sector; not at its ends, where rounding would let a plane block its own.
        float place = mix(0.001, 0.999, unitFloat(hash(hilbertBits(pixel).x + uint(i))));
        // Sectors are counted from the end of the negative side to that of the positive.
        float middle = sideWeight(-slice.turn);
        uint bits = 0u;
        for (float direction = -1.0; direction < 2.0; direction += 2.0) {
            vec3 side = direction * slice.side;
            float turn = direction * slice.turn;
            March march = marchOf(p, side);
            for (int j = 0; j < steps && march.reach >= 1.0; ++j) {
                Tap tap;
                if (!tapAt(p, slice, march, tapPlace(noise.y, i, j), side, tap) ||
                    tap.distance > settings.radius)
                    continue;
                vec2 arc = vec2(shareOf(tap.offset, turn),
                                shareOf(tap.offset - vec2(thickness, 0.0), turn));
                vec2 ends = 32.0 * (middle + direction * arc) / slice.weight + place;
                ivec2 sectors = ivec2(floor(direction > 0.0 ? ends : ends.yx));
                bits |= bitsBetween(sectors.x, sectors.y);
            }
        }
        blocked += bitCount(bits);
    }
    return vec4(1.0 - float(blocked) / (32.0 * float(sliceCount)));
}

vec4 denoiseOnce(ivec2 pixel) { return denoised(gatherResult, pixel, settings.denoise < 1.5); }
vec4 denoiseTwice(ivec2 pixel) {
    return denoised(denoiseOnceResult, pixel, settings.denoise < 2.5);
}
vec4 denoiseThrice(ivec2 pixel) { return denoised(denoiseTwiceResult, pixel, true); }
