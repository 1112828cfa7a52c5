// Volumetric obscurance by line samples (Loos and Sloan 2010): the open share of a ball around the
// pixel, each tap giving the exact open length of one line through it. Depth and normals.
//
// A plane fills half of the ball. clipByNormal measures the other half alone; without it visibility
// is doubled and cut at 1, which hides occlusion where the surface is convex.
//
// Departures: rays instead of parallel lines (ball.glsl); lines lie evenly on the disc and are
// normalised by their own lengths, where the paper weights lines by their share of the volume;
// taps outside the image are left out. Constant occupancy weight inside the ball, no falloff.
//
// Limit: on a plane 1. Beside an endless wall at c = d / R occlusion is (1 - c)^2 (2 + c) / 4 both
// ways: the wall fills as much of the clipped half as, doubled, of the whole ball; beside steps as
// volumetric_obscurance_points. At the foot of a right-angled groove a quarter of the ball is open,
// half of the half above either side: 1/2 both ways.

#include "ball.glsl"
#include "blur_normal.glsl"
#include "disc.glsl"

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    bool clipped = settings.clipByNormal > 0.5;
    Ball ball = Ball(pixel, depth, vec3(0.0), settings.radius);
    vec3 normal = normalOf(pixel);
    Disc disc = discOf(surfaceOf(ball), ball.radius, pixel);

    int count = int(settings.samples);
    float open = 0.0, whole = 0.0;
    for (int i = 0; i < count; ++i) {
        vec2 uv = discUv(disc, i, count);
        ivec2 tap = pixelOf(uv);
        float weight = isOutside(uv) ? 0.0 : 1.0;
        vec2 line = lineThrough(ball, tap);
        if (clipped)
            line = clippedLine(line, ball, tap, normal);
        open += weight * openLength(line, depthInside(tap) - depth);
        whole += weight * (line.y - line.x);
    }
    float visibility = whole > 0.0 ? open / whole : 1.0;
    return vec4(clipped ? visibility : min(2.0 * visibility, 1.0));
}

vec4 blurTile(ivec2 pixel) { return blurByDepthAndNormal(gatherResult, pixel); }
