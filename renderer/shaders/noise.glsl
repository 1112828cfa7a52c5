// The tiled random vectors that all techniques of the thesis jitter their samples with
// (Jakobsen 2010, section 4.3.1.1): sixteen, repeated every 4 x 4 pixels.

uint hash(uint value) { // Jarzynski and Olano 2020, "pcg"
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

float unitFloat(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

// Frames that are accumulated deal the tile anew, each vector to each pixel once in sixteen frames,
// and have another seed after that.
int tileFrame() { return frame.seed.y & 15; }
uint tileSeed() { return uint(frame.seed.x + (frame.seed.y >> 4)); }

// A unit vector: the sixteen are spread evenly over the sphere (a spherical Fibonacci lattice,
// shifted by the seed) and dealt to the tile in the order of a 4 x 4 Bayer matrix, so that
// neighbouring pixels have unlike vectors.
vec3 tileDirection(ivec2 pixel) {
    const int order[16] = int[16](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);
    int i = (order[(pixel.x & 3) + 4 * (pixel.y & 3)] + 7 * tileFrame()) & 15;
    float turn = unitFloat(hash(tileSeed()));
    float z = 1.0 - (2.0 * float(i) + 1.0) / 16.0;
    float angle = 6.28318531 * fract(float(i) * 0.618033989 + turn);
    return vec3(sqrt(1.0 - z * z) * vec2(cos(angle), sin(angle)), z);
}
