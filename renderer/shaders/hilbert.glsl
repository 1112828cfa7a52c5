// Two numbers for each pixel, as unlike those of its neighbours as possible: the R2 sequence
// (Roberts 2018) dealt along a Hilbert curve of 64 x 64 pixels, so that pixels near each other are
// near in the sequence, whose successive members are spread evenly (XeGTAO).

uint hilbertIndex(ivec2 pixel) {
    uvec2 p = uvec2(pixel);
    uint index = 0u;
    for (int level = 5; level >= 0; --level) {
        uvec2 upper = (p >> level) & 1u;
        index = 4u * index + ((3u * upper.x) ^ upper.y);
        // Turn the quadrant to where the curve enters it; only lower bits matter from here on.
        p ^= 0u - (upper.x & ~upper.y);
        uint swap = (p.x ^ p.y) & (upper.y - 1u);
        p ^= swap;
    }
    return index;
}

// Seed and accumulated frames move along the sequence by 288, XeGTAO's step. Multiplying whole
// numbers takes the fraction without rounding, however large the seed.
uvec2 hilbertBits(ivec2 pixel) {
    uint index = hilbertIndex(pixel) + 288u * uint(frame.seed.x + frame.seed.y);
    return index * uvec2(3242174889u, 2447445414u); // 2^32 / 1.3247, 2^32 / 1.3247^2
}

vec2 hilbertFloats(uvec2 bits) { return vec2(bits >> 8u) * (1.0 / 16777216.0); }
vec2 hilbertNoise(ivec2 pixel) { return hilbertFloats(hilbertBits(pixel)); }
