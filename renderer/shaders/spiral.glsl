// The taps of McGuire, Mara and Luebke 2012, equations 6 to 8, which the CS562 report takes over: a
// spiral whose radius grows linearly, so that taps crowd at the centre with a density of 1 / r, not
// evenly over the disc; turned by a hash of the pixel.

#include "noise.glsl"

// phi = (30 x XOR y) + 10 x y radians, as a fraction of a turn. In fixed point (2^32 is a turn),
// because the products reach far beyond what a float's 24 bits tell apart. The seed turns all
// pixels alike, and frames that are accumulated by the golden angle from one to the next.
float pixelTurn(ivec2 pixel) {
    uvec2 p = uvec2(pixel);
    uint radians = ((30u * p.x) ^ p.y) + 10u * p.x * p.y;
    uint turn = hash(uint(frame.seed.x)) + 2654435769u * uint(frame.seed.y);
    return unitFloat(radians * 683565276u + turn);
}

// Tap i of the unit disc. `turns` is how often the spiral goes round, `start` its first direction
// (turns).
vec2 spiralOffset(int i, int count, float turns, float start) {
    float alpha = (float(i) + 0.5) / float(count);
    float angle = 6.28318531 * fract(alpha * turns + start);
    return alpha * vec2(cos(angle), sin(angle));
}

// Tap i of the unit disc, evenly spread over its area (Vogel 1979): the golden angle from one to
// the next.
vec2 discOffset(int i, int count, float start) {
    float angle = 6.28318531 * fract(float(i) * 0.381966011 + start);
    return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}
