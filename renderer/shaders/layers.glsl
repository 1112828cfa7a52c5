// Further layers of depth (renderer/techniques/further_layers.h): what lies behind a tap of
// slices.glsl. They have full resolution alone, for what averaging would join are as often as not
// different things.

#include "slices.glsl"

// The surface of a further layer, 1 for the second, in the pixel that a tap was read in or, where
// that was a level of averaged depth, in one of those around the level's middle.
Tap tapBehind(Point p, Slice slice, float direction, float reach, Tap tap, int further) {
    ivec2 pixel = pixelOf(tap.uv);
    float depth =
        further == 1 ? texelFetch(secondDepth, pixel, 0).r : texelFetch(thirdDepth, pixel, 0).r;
    return tapOver(p, slice, direction, reach, uvOf(pixel), depth);
}
