// Two numbers per pixel that neighbours have in common as little as possible: the R2 sequence
// (Roberts 2018) dealt along a Hilbert curve of 64 x 64 pixels, so that pixels near each other are
// near in the sequence, whose successive members are spread evenly (XeGTAO).

uint hilbertIndex(ivec2 pixel) {
    uvec2 p = uvec2(pixel) & 63u;
    uint index = 0u;
    for (uint level = 32u; level > 0u; level >>= 1u) {
        uvec2 upper = uvec2((p.x & level) > 0u, (p.y & level) > 0u);
        index += level * level * ((3u * upper.x) ^ upper.y);
        if (upper.y == 0u) { // turn the quadrant to where the curve enters it
            if (upper.x == 1u)
                p = 63u - p;
            p = p.yx;
        }
    }
    return index;
}

// The seed moves along the sequence by 288, XeGTAO's step from frame to frame. Multiplying whole
// numbers takes the fraction without rounding, however large the seed.
uvec2 hilbertBits(ivec2 pixel) {
    uint index = hilbertIndex(pixel) + 288u * uint(frame.seed.x);
    return index * uvec2(3242174889u, 2447445414u); // 2^32 / 1.3247, 2^32 / 1.3247^2
}

vec2 hilbertNoise(ivec2 pixel) { return vec2(hilbertBits(pixel) >> 8u) * (1.0 / 16777216.0); }
