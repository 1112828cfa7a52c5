// Line samples of a ball: each line of sight crosses it from one depth to another, and the depth
// buffer says how much of that is in front of the scene (Loos and Sloan 2010; Szirmay-Kalos et al.
// 2010; both cut lines parallel to the view axis).
//
// The line belongs to the centre of the pixel whose depth is read, not to the exact sample point.
// So a plane is behind all of every line at any tilt and distance, and no bias is needed. For the
// same reason depths are kept relative to the pixel's own: their differences are exact.

#include "depth.glsl"

struct Ball {
    ivec2 pixel;   // whose surface it belongs to
    float depth;   // there
    vec3 toCentre; // from the surface, view space
    float radius;
};

// Of volumetric ambient occlusion (Szirmay-Kalos et al. 2010): half the radius, touching the
// surface from above, so that a plane leaves all of it open.
Ball tangentBall(ivec2 pixel, float depth, vec3 normal) {
    float radius = 0.5 * settings.radius;
    return Ball(pixel, depth, normal * radius, radius);
}

vec3 surfaceOf(Ball ball) { return viewPosition(uvOf(ball.pixel), ball.depth); }

// x and y of the line of sight through a pixel, per unit of depth, less those of the ball's own.
vec2 turnTo(Ball ball, ivec2 tap) {
    return vec2(tap - ball.pixel) * (frame.size.zw * frame.viewFromUv.xy);
}

// Depths, less the ball's, at which the line of sight through a pixel enters and leaves the ball,
// not behind the camera; equal where it misses.
vec2 lineThrough(Ball ball, ivec2 tap) {
    vec2 own = viewPosition(uvOf(ball.pixel), 1.0).xy, turn = turnTo(ball, tap), ray = own + turn;
    float rise = -ball.toCentre.z;
    // From the centre to the ray's point at the centre's depth; z is 0, the ray's is -1.
    vec2 aside = turn * (ball.depth + rise) + (own * rise - ball.toCentre.xy);
    float square = 1.0 + dot(ray, ray), moment = ray.x * aside.y - ray.y * aside.x;
    float within = square * (ball.radius * ball.radius) - dot(aside, aside) - moment * moment;
    float inverse = 1.0 / square, middle = rise - dot(ray, aside) * inverse;
    float extent = sqrt(max(within, 0.0)) * inverse;
    return max(vec2(middle - extent, middle + extent), vec2(-ball.depth));
}

// How much of the line is in front of the scene's depth, which is relative to the ball's too.
float openLength(vec2 line, float scene) { return clamp(scene - line.x, 0.0, line.y - line.x); }

// The part of a line on the normal's side of the surface's plane.
vec2 clippedLine(vec2 line, Ball ball, ivec2 tap, vec3 normal) {
    float facing = dot(normal, viewPosition(uvOf(tap), 1.0));
    if (abs(facing) < 1e-6)
        return line;
    float plane = -dot(normal.xy, turnTo(ball, tap)) * ball.depth / facing;
    return facing < 0.0 ? min(line, plane) : max(line, plane);
}
