// Slices where they are needed, after the adaptive quality of ASSAO (Strugar 2016) and CACAO (AMD
// 2020): the importance of a block of pixels is the range of a cheap estimate in and around it.
//
// Departures: they take the range of a first result at full resolution, to which they then add
// taps; we take that of one slice in the middle of each block of 4 x 4. Slices of unlike directions
// differ wherever more of them would lessen noise, so that range is of the estimator's variance and
// not of the picture alone. All pixels of a block have one count: GPUs and SIMD drivers run
// neighbours together, for as long as the slowest.

const int blockSize = 4; // scale of both passes

ivec2 middleOf(ivec2 block) {
    return min(block * blockSize + blockSize / 2, ivec2(frame.size.xy) - 1);
}

// How many slices the pixels of the middle one of 3 x 3 blocks get, from the blocks' visibility by
// a single slice each.
float slicesFor(sampler2D surveyed, ivec2 block) {
    ivec2 last = textureSize(surveyed, 0) - 1;
    float least = 1.0, most = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 other = clamp(block + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        float visibility = texelFetch(surveyed, other, 0).r;
        least = min(least, visibility);
        most = max(most, visibility);
    }
    float wanted = ceil(settings.slices * (most - least) / settings.adaptiveRange);
    return clamp(wanted, 1.0, settings.slices);
}

int slicesOf(sampler2D counts, ivec2 pixel) {
    return int(settings.adaptive < 0.5 ? settings.slices
                                       : texelFetch(counts, pixel / blockSize, 0).r);
}
