// Joint bilateral upsampling (Kopf, Cohen, Lischinski and Uyttendaele 2007): of the four picked
// pixels around, those near in the image and on the pixel's own surface weigh most. Inverse depth
// is linear in the image on a plane, so a slope goes on and is no edge.

layout(binding = 0) uniform sampler2D depthBuffer;
layout(binding = 1) uniform sampler2D pickedDepth;
layout(binding = 2) uniform sampler2D pickedVisibility;
uniform int factor;
layout(location = 0) out vec4 visibilityOut;

#include "depth.glsl"

const float tolerance = 0.01; // of depth, at which a neighbour's weight has fallen to a quarter

// The change to the flatter of the two sides, because the other may lie across an edge.
float slope(float centre, float before, float after) {
    float down = centre - before, up = after - centre;
    return abs(down) < abs(up) ? down : up;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    // Depths of two quads: the pixel is the upper right corner of the first and the lower left
    // corner of the second.
    vec4 before = textureGather(depthBuffer, vec2(pixel) * frame.size.zw);
    vec4 after = textureGather(depthBuffer, vec2(pixel + 1) * frame.size.zw);
    float depth = after.w;
    if (isEmpty(depth)) {
        visibilityOut = vec4(1.0);
        return;
    }
    // Inverse depths, relative to the pixel's own.
    vec4 sides = depth / vec4(before.x, after.z, before.z, after.x);
    vec2 slopes = vec2(slope(1.0, sides.x, sides.y), slope(1.0, sides.z, sides.w));
    vec2 place = vec2(pixel - factor / 2) / float(factor); // in picked pixels
    vec2 corner = floor(place), part = place - corner;
    vec2 size = vec2(textureSize(pickedDepth, 0)), uv = (corner + 1.0) / size;
    vec2 low = max(corner, 0.0), high = min(corner + 1.0, size - 1.0);
    vec4 depths = textureGather(pickedDepth, uv), values = textureGather(pickedVisibility, uv);
    // In the order of textureGather: upper left, upper right, lower right, lower left.
    vec4 away = (vec4(low.x, high.x, high.x, low.x) - place.x) * (slopes.x * float(factor)) +
                (vec4(high.y, high.y, low.y, low.y) - place.y) * (slopes.y * float(factor));
    vec4 off = (depth / depths - 1.0 - away) / tolerance;
    vec4 surface = 1.0 + off * off;
    vec4 near = vec4(1.0 - part.x, part.x, part.x, 1.0 - part.x) *
                vec4(part.y, part.y, 1.0 - part.y, 1.0 - part.y);
    vec4 weights = (near + 0.001) / (surface * surface);
    visibilityOut = vec4(dot(weights, values) / dot(weights, vec4(1.0)));
}
