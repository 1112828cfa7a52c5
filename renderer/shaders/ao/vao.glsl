// Volumetric ambient occlusion (Szirmay-Kalos et al. 2010; retold in Boksansky et al. 2017, section
// 3): the open share of the tangent ball, of half the radius and resting on the surface. The ball
// stands for the cosine: no weights, and a plane never cuts it. Depth and normals.
//
// Departures: rays instead of parallel lines (ball.glsl); taps outside the image are left out of
// both sums, where clamped ones would read the border's depth.
//
// Limit: the open share of the tangent ball. Beside an endless wall at c = d / R it is a cap:
// occlusion (1 - 2 c)^2 (1 + c), zero from c = 1/2 on, half the reach of a cosine-weighted count.
// Beside a step the cap ends at its height: d 0.25 h 0.5: 0.0781; 0.5, 0.5: 0; 0.1, 0.2: 0.0312;
// 0.25, 2: 0.1562 (R = 1).

#include "ball.glsl"
#include "blur_normal.glsl"
#include "disc.glsl"

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    Ball ball = tangentBall(pixel, depth, normalOf(pixel));
    Disc disc = discOf(surfaceOf(ball) + ball.toCentre, ball.radius, pixel);

    int count = int(settings.samples);
    float open = 0.0, whole = 0.0;
    for (int i = 0; i < count; ++i) {
        vec2 uv = discUv(disc, i, count);
        ivec2 tap = pixelOf(uv);
        float weight = isOutside(uv) ? 0.0 : 1.0;
        vec2 line = lineThrough(ball, tap);
        // Equation 1 of 2017, its three cases; equation 2: F from the same taps, whose errors it
        // cancels.
        open += weight * openLength(line, depthInside(tap) - depth);
        whole += weight * (line.y - line.x);
    }
    return vec4(whole > 0.0 ? open / whole : 1.0);
}

vec4 blurTile(ivec2 pixel) { return blurByDepthAndNormal(gatherResult, pixel); }
