// Line samples of a ball: each line of sight crosses it from one depth to another, and the depth
// buffer says how much of that is in front of the scene (Loos and Sloan 2010; Szirmay-Kalos et al.
// 2010; both cut lines parallel to the view axis).
//
// The line belongs to the centre of the pixel whose depth is read, not to the exact sample point.
// So a plane is behind all of every line at any tilt and distance, and no bias is needed. For the
// same reason depths are kept relative to the pixel's own: their differences are exact.

#include "depth.glsl"

struct Ball {
    vec2 uv;       // of the pixel whose surface it belongs to
    float depth;   // there
    vec3 toCentre; // from the surface, view space
    float radius;
};

// Of volumetric ambient occlusion (Szirmay-Kalos et al. 2010): half the radius, touching the
// surface from above, so that a plane leaves all of it open.
Ball tangentBall(ivec2 pixel, float depth, vec3 normal) {
    float radius = 0.5 * settings.radius;
    return Ball(uvOf(pixel), depth, normal * radius, radius);
}

// From the surface to the ray of `uv` where it has the ball's depth.
vec3 asideOf(Ball ball, vec2 uv) {
    return vec3((uv - ball.uv) * frame.viewFromUv.xy * ball.depth, 0.0);
}

// Depths, less the ball's, at which the line of sight through `uv` enters and leaves the ball, not
// behind the camera; equal where it misses.
vec2 lineThrough(Ball ball, vec2 uv) {
    vec3 ray = viewPosition(uv, 1.0); // per unit of depth
    float rise = -ball.toCentre.z;
    // From the centre to the ray's point at the centre's depth.
    vec3 aside = asideOf(ball, uv) + ray * rise - ball.toCentre;
    vec3 moment = cross(ray, aside);
    float square = dot(ray, ray);
    float middle = rise - dot(ray, aside) / square;
    float extent =
        sqrt(max(square * ball.radius * ball.radius - dot(moment, moment), 0.0)) / square;
    return max(vec2(middle - extent, middle + extent), vec2(-ball.depth));
}

// How much of the line is in front of the scene's depth, which is relative to the ball's too.
float openLength(vec2 line, float scene) { return clamp(scene - line.x, 0.0, line.y - line.x); }

// The part of a line on the normal's side of the surface's plane.
vec2 clippedLine(vec2 line, Ball ball, vec2 uv, vec3 normal) {
    float facing = dot(normal, viewPosition(uv, 1.0));
    if (abs(facing) < 1e-6)
        return line;
    float plane = -dot(normal, asideOf(ball, uv)) / facing;
    return facing < 0.0 ? min(line, plane) : max(line, plane);
}
