// One rectangle per proxy sphere, around the pixels that may lie within `radius` x `distantReach`
// of it once it is `sphereSize` as large.
#include "view.glsl"

flat out vec4 sphere; // view space

void main() {
    vec4 world = spheres[gl_InstanceID];
    sphere = vec4((frame.viewFromWorld * vec4(world.xyz, 1.0)).xyz,
                  world.w * settings.sphereSize);
    float reach = sphere.w + settings.radius * settings.distantReach;
    float nearest = -sphere.z - reach, farthest = -sphere.z + reach;
    // The box around the ball; each side is widest at the nearer or the farther depth.
    vec2 low = sphere.xy - reach, high = sphere.xy + reach;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec2 side = mix(low, high, corner);
    vec2 depths = vec2((side.x < 0.0) == (corner.x == 0.0) ? nearest : farthest,
                       (side.y < 0.0) == (corner.y == 0.0) ? nearest : farthest);
    vec2 uv = (side / depths - frame.viewFromUv.zw) / frame.viewFromUv.xy;
    if (nearest < frame.depth.x) // around the camera: everything
        uv = corner;
    gl_Position = vec4(clamp(uv, 0.0, 1.0) * 2.0 - 1.0, 0.0, farthest < frame.depth.x ? -1.0 : 1.0);
}
