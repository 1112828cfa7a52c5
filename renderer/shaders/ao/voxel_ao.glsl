// Ambient occlusion by voxel cone tracing (Crassin et al. 2011, "Interactive indirect illumination
// using voxel cone tracing", sections 6 and 7): the hemisphere is split into a few cones, and each
// gathers the opacity of ever larger voxels along its axis. The scene's voxels
// (renderer/scene/voxels.h) do not depend on the view and are made once for a radius.
//
// Departures:
// - Opacity counts in full within the radius and not at all beyond, for the integral that all rows
//   are measured by; the paper's falls off as 1 / (1 + lambda t).
// - Opacities are added up along a cone, to 1 at most, and not composited: filtering spreads a wall
//   over two voxels, and composited they let through an eighth of the light however small they are;
//   added, weighted by the way through them, they come to 1.
// - Cones have equal weights and axes spread as the cosine is, turned from pixel to pixel of the
//   4 x 4 noise tile and blurred over it, in the place of fixed cones of 60 degrees.
// - A dense grid with opacities along three axes in the place of an octree with six directions.
// - A sample's centre is kept `bias` voxels of its size above the tangent plane, lest wide cones
//   meet the surface that they start from.
//
// Limit, for infinitely many cones, steps and voxels: the cosine-weighted occlusion within the
// radius, I1.

#include "blur_normal.glsl"
#include "noise.glsl"

// Surfaces met on the way through a voxel of a level: lines along each axis meet as many as it is
// opaque to them, and a line along `direction` covers the part |direction| of its way along each.
float metIn(vec3 position, vec3 direction, float level) {
    vec3 opacity =
        textureLod(voxelOpacity, (position - voxelPlace.xyz) * voxelScale.xyz, level).rgb;
    return dot(opacity, abs(direction));
}

// Visibility of one cone. Its steps grow evenly with distance, from half a voxel on.
float coneVisibility(vec3 position, vec3 normal, vec3 direction, float jitter) {
    float side = voxelPlace.w, from = 0.5 * side;
    float growth = pow(settings.radius / from, 1.0 / settings.steps);
    float width = 2.0 * inversesqrt(settings.cones); // of the cone, at distance 1
    float cosine = dot(normal, direction), met = 0.0;
    for (int i = 0; i < int(settings.steps); ++i) {
        float to = from * growth, along = mix(from, to, jitter);
        float level = round(log2(max(max(width * along, to - from) / side, 1.0)));
        float size = side * exp2(level);
        float lift = max(settings.bias * size - cosine * along, 0.0);
        met += metIn(position + along * direction + lift * normal, direction, level) * (to - from) /
               size;
        from = to;
    }
    return max(1.0 - met, 0.0);
}

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    mat3 rotation = mat3(frame.worldFromView);
    vec3 position = rotation * viewPosition(uvOf(pixel), depth) + frame.worldFromView[3].xyz;
    vec3 normal = rotation * normalOf(pixel);
    vec3 across = normalize(abs(normal.x) < 0.7 ? cross(normal, vec3(1.0, 0.0, 0.0))
                                                : cross(normal, vec3(0.0, 1.0, 0.0)));
    vec3 up = cross(normal, across);
    vec3 tile = tileDirection(pixel);
    float turn = atan(tile.y, tile.x), jitter = 0.5 + 0.5 * tile.z;
    float visibility = 0.0;
    for (int i = 0; i < int(settings.cones); ++i) {
        float angle = 2.39996323 * float(i) + turn; // the golden angle
        float squared = (float(i) + 0.5) / settings.cones;
        vec2 flat_ = sqrt(squared) * vec2(cos(angle), sin(angle));
        vec3 direction = flat_.x * across + flat_.y * up + sqrt(1.0 - squared) * normal;
        visibility += coneVisibility(position, normal, direction, jitter);
    }
    return vec4(visibility / settings.cones);
}

vec4 blurTile(ivec2 pixel) { return vec4(blurByDepthAndNormal(gatherResult, pixel)); }
