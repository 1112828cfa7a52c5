// Deinterleaved taps (Bavoil 2014, "Deinterleaved texturing for cache-efficient interleaved
// sampling"; nvpro-samples gl_ssao, "cache-aware"): depth is split into sixteen layers, one for
// each place of the 4 x 4 noise tile, each is shaded by itself with one rotation and jitter, and
// the results are put back in place. Neighbours in a layer take the same steps, so their reads are
// neighbours too: the point of it all.
//
// As in gl_ssao and HBAO+, a pixel's taps stay in its own layer, which makes every step a multiple
// of four pixels; the normal is read at full resolution. The pass between split and merge is called
// `shade`.

#include "depth.glsl"
#include "taps.glsl"

ivec2 placeOf(int layer) { return ivec2(layer & 3, layer >> 2); }
int layerOf(ivec2 place) { return place.x + 4 * place.y; }

float tapDepth(ivec2 cell, ivec2 place, int stride) {
    return texelFetch(splitResult, ivec3(cell, layerOf(place)), 0).r;
}

// Layers are rounded up; what they have beyond the image is empty.
vec4 split(ivec2 pixel, int layer) {
    ivec2 full = 4 * pixel + placeOf(layer);
    bool inside = all(lessThan(full, ivec2(frame.size.xy)));
    return vec4(inside ? depthOf(full) : frame.depth.y);
}

vec4 merge(ivec2 pixel) {
    return texelFetch(shadeResult, ivec3(pixel >> 2, layerOf(pixel & 3)), 0);
}
