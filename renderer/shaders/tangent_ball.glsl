// The ball of volumetric ambient occlusion (Szirmay-Kalos et al. 2010): of radius R / 2, touching
// the surface at the pixel's point and centred above it, so that a plane leaves all of it open. It
// is measured along lines of sight: each crosses the ball from one depth to another, and the depth
// buffer says how much of that is in front of the scene.
//
// The line belongs to the centre of the pixel whose depth is read, not to the exact sample point.
// So a plane is behind all of every line at any tilt and distance, and no bias is needed. For the
// same reason depths are kept relative to the pixel's own: their differences are exact.

#include "depth.glsl"

struct TangentBall {
    vec2 uv;       // of the pixel it touches
    float depth;   // there
    vec3 toCentre; // from the surface, view space
    float radius;
};

TangentBall tangentBall(ivec2 pixel, float depth, vec3 normal, float reach) {
    return TangentBall(uvOf(pixel), depth, normal * (0.5 * reach), 0.5 * reach);
}

// The pixel that shows a point of the disc through the ball's centre, parallel to the screen;
// `offset` in ball radii.
ivec2 discPixel(TangentBall ball, vec2 offset) {
    vec3 centre = viewPosition(ball.uv, ball.depth) + ball.toCentre;
    vec2 uv = uvFromView(centre + vec3(offset * ball.radius, 0.0));
    return pixelOf(clamp(uv, 0.0, 1.0)); // first: a whole number cannot hold just any float
}

// Depths, less the ball's, at which the line of sight through `uv` enters and leaves the ball, not
// behind the camera; equal where it misses.
vec2 lineThrough(TangentBall ball, vec2 uv) {
    vec3 ray = vec3(uv * frame.viewFromUv.xy + frame.viewFromUv.zw, -1.0); // per unit of depth
    float rise = -ball.toCentre.z;
    // From the centre to the ray's point at the centre's depth.
    vec3 aside =
        vec3((uv - ball.uv) * frame.viewFromUv.xy * ball.depth, 0.0) + ray * rise - ball.toCentre;
    vec3 moment = cross(ray, aside);
    float square = dot(ray, ray);
    float middle = rise - dot(ray, aside) / square;
    float extent =
        sqrt(max(square * ball.radius * ball.radius - dot(moment, moment), 0.0)) / square;
    return max(vec2(middle - extent, middle + extent), vec2(-ball.depth));
}

// How much of the line is in front of the scene's depth, which is relative to the ball's too.
float openLength(vec2 line, float scene) { return clamp(scene - line.x, 0.0, line.y - line.x); }
