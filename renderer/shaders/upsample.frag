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

float inverseDepth(ivec2 pixel) { return 1.0 / depthOf(pixel); }

// Of the two sides the flatter: the other may lie across an edge.
float slope(float centre, float before, float after) {
    float down = centre - before, up = after - centre;
    return abs(down) < abs(up) ? down : up;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depthOf(pixel);
    if (isEmpty(depth)) {
        visibilityOut = vec4(1.0);
        return;
    }
    float centre = 1.0 / depth;
    vec2 slopes =
        vec2(slope(centre, inverseDepth(pixel - ivec2(1, 0)), inverseDepth(pixel + ivec2(1, 0))),
             slope(centre, inverseDepth(pixel - ivec2(0, 1)), inverseDepth(pixel + ivec2(0, 1))));
    vec2 place = vec2(pixel - factor / 2) / float(factor); // in picked pixels
    ivec2 corner = ivec2(floor(place));
    vec2 part = place - vec2(corner);
    ivec2 last = textureSize(pickedDepth, 0) - 1;
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 tap = clamp(corner + side, ivec2(0), last);
        vec2 away = vec2(tap * factor + factor / 2 - pixel);
        float off = 1.0 / texelFetch(pickedDepth, tap, 0).r - centre - dot(slopes, away);
        float surface = 1.0 + off * off * depth * depth / (tolerance * tolerance);
        vec2 near = mix(1.0 - part, part, vec2(side));
        float weight = (near.x * near.y + 0.001) / (surface * surface);
        sum += weight * texelFetch(pickedVisibility, tap, 0).r;
        weights += weight;
    }
    visibilityOut = vec4(sum / weights);
}
