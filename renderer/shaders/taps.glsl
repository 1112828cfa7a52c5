// Depth taps along straight lines of the image, the sampling that HBAO (Bavoil, Sainz and Dimitrov
// 2008) and HBAO+ share: directions evenly around the pixel, equal steps along each, both turned
// and shifted by the 4 x 4 noise tile.
//
// Lines run over a lattice of every `stride`-th pixel through the centre one: 1 is the full image,
// 2 a half-resolution copy of it, 4 one of the sixteen deinterleaved layers. Where depths lie is
// the including file's affair: it defines tapDepth().

#include "noise.glsl"
#include "view.glsl"

// Depth of the pixel at `place` of the stride x stride cell number `cell`, both from the corner.
float tapDepth(ivec2 cell, ivec2 place, int stride);

// Beyond the border the border's depth goes on, as with gl_ssao's clamped textures; each lattice
// has its own border, so that a layer never needs another layer.
float clampedTapDepth(ivec2 pixel, int stride) {
    ivec2 place = pixel & (stride - 1);
    ivec2 last = (ivec2(frame.size.xy) - 1 - place) / stride;
    return tapDepth(clamp((pixel - place) / stride, ivec2(0), last), place, stride);
}

struct Lines {
    ivec2 pixel;
    int stride;
    int steps;                   // 0: the radius is smaller than one step of the lattice
    float spacing, jitter, turn; // strides; share of a step; share of the angle between lines
};

// `tile` is the pixel's place in the noise tile. As in NVIDIA's samples, R is divided by one more
// than the steps, so that W does not weigh the last tap down to nothing, and no step is shorter
// than the lattice's (SDK 11, ComputeSteps; gl_ssao has only the former).
Lines linesFrom(ivec2 pixel, ivec2 tile, float depth, float radius, int stride) {
    float share = min(radius * frame.depth.w / depth, settings.screenReach);
    float reach = share * frame.size.y / float(stride);
    int steps = int(min(floor(reach), settings.steps));
    // The tile's sixteen unit vectors have heights and longitudes that fill both intervals evenly.
    vec3 random = tileDirection(tile);
    return Lines(pixel, stride, steps, reach / float(steps + 1), 0.5 - 0.5 * random.z,
                 fract(atan(random.y, random.x) * 0.159154943 + 1.0));
}

vec2 lineDirection(Lines lines, int i) {
    float angle = 6.28318531 * (float(i) + lines.turn) / settings.directions;
    return vec2(cos(angle), sin(angle));
}

// The pixel of a step, rounded to the lattice.
ivec2 tapPixel(Lines lines, vec2 direction, int i) {
    float along = 1.0 + (float(i) + lines.jitter) * lines.spacing;
    return lines.pixel + lines.stride * ivec2(round(along * direction));
}

// The surface there; false where there is none.
bool tapSurface(ivec2 pixel, int stride, out vec3 position) {
    float depth = clampedTapDepth(pixel, stride);
    position = viewPosition(uvOf(pixel), depth);
    return !isEmpty(depth);
}
