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

#include "layers.glsl"
#include "sectors.glsl"

// The sectors that all layers of one tap block.
uint blockedAt(Point p, Slice slice, float direction, float reach, float along, float place) {
    float thickness = settings.thickness * settings.radius;
    Tap tap = tapAt(p, slice, direction, reach, along);
    uint bits = blockedBy(tap, slice, direction, place, thickness);
    for (int i = 1; i < int(settings.layers); ++i)
        bits |= blockedBy(tapBehind(p, slice, direction, reach, tap, i), slice, direction, place,
                          thickness);
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
