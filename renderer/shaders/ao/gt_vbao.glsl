// GT-VBAO (Salm 2024): the visibility bitmask whose sectors hold equal cosine-weighted solid angle
// and whose slices are drawn by weight, so that it equals a ray-marcher with the same taps; our
// visibility_bitmask is that already (sectors.glsl, slices.glsl). What is added is Ottosson's guess
// of thickness (2025): as thick as it is wide. Neighbouring taps of one side belong to one surface
// where depth changes between them by no more than `surfaceSlope` of their distance; the surface
// goes on from a tap to the last such one outwards, and half a gap beyond.
//
// Departures: they count the whole width, which only the outermost tap knows of; going inwards, we
// have what lies outwards of each tap, which is the whole width where it matters, at the inner
// edge. They vary thickness at random, which only added noise here. No surface is thinner than
// `thickness`, for wide gaps between taps make much look thin that is not.
//
// Limit: as the bitmask's, with a thickness of the distance from each point of a surface to where
// it ends outwards along the slice, or `thickness`.

#include "sectors.glsl"

// Of the tap before, farther out on the same side of a slice.
struct Surface {
    vec2 offset; // of that tap
    float end;   // where its surface ends, metres across the view
    bool seen;
};

// Metres, of a tap's surface, which `surface` then describes; `gap` is how far the tap before it
// is.
float widthOf(Tap tap, float gap, inout Surface surface) {
    vec2 step = surface.offset - tap.offset;
    bool same = surface.seen && abs(step.x) <= settings.surfaceSlope * abs(step.y);
    surface = Surface(tap.offset, same ? surface.end : tap.offset.y + 0.5 * gap, tap.seen);
    return surface.end - tap.offset.y;
}

uint blockedAt(Point p, Slice slice, float direction, float reach, float along, float place,
               float gap, inout Surface surface) {
    Tap tap = tapAt(p, slice, direction, reach, along);
    float thickness = max(widthOf(tap, gap, surface), settings.thickness * settings.radius);
    return blockedBy(tap, slice, direction, place, thickness);
}

uint blockedIn(Point p, Slice slice, float place, float noise, int index) {
    vec2 reaches = reachesOf(p, slice);
    Surface ahead = Surface(vec2(0.0), 0.0, false), behind = ahead;
    float before = 1.0;
    uint bits = 0u;
    int j = int(settings.steps);
    do {
        float along = tapPlace(noise, index, --j);
        float gap = (before - along) * settings.radius;
        bits |= blockedAt(p, slice, 1.0, reaches.x, along, place, gap, ahead) |
                blockedAt(p, slice, -1.0, reaches.y, along, place, gap, behind);
        before = along;
    } while (j > 0);
    return bits;
}
