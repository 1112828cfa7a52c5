// A running mean of visibility over frames (renderer/techniques/accumulation.h).

layout(binding = 0) uniform sampler2D depthBuffer;
layout(binding = 1) uniform sampler2D visibility;
// Of the frame before: the mean; its depth, and of how many frames it is the mean, 0 where of none.
layout(binding = 2) uniform sampler2D meanBefore;
layout(binding = 3) uniform sampler2D depthBefore;
uniform mat4 beforeFromView; // view space
uniform vec4 beforeFromUv;   // viewFromUv of the frame before
uniform float frames;        // the mean is of no more
layout(location = 0) out vec4 meanOut;
layout(location = 1) out vec4 depthOut;

#include "depth.glsl"

vec3 positionOf(ivec2 pixel) { return viewPosition(uvOf(pixel), depthOf(pixel)); }

// Along the surface to the next pixel: of both sides the one that changes depth less, for the other
// may lie across an edge.
vec3 alongSurface(ivec2 pixel, vec3 position, ivec2 axis) {
    vec3 before = position - positionOf(pixel - axis), after = positionOf(pixel + axis) - position;
    // At the image's border a neighbour is the pixel itself.
    if (insideOf(pixel - axis) == pixel)
        return after;
    if (insideOf(pixel + axis) == pixel)
        return before;
    return abs(before.z) < abs(after.z) ? before : after;
}

// Nearer to a pixel's centre than a thousandth is at it, so that what stands still is not blurred
// by rounding.
vec2 snapped(vec2 place) {
    vec2 centre = round(place);
    return mix(place, centre, lessThan(abs(place - centre), vec2(1e-3)));
}

struct History {
    vec4 mean;
    float count; // of frames, 0: there is none
};

History historyAt(vec3 position, vec3 normal) {
    vec2 uv = (position.xy / -position.z - beforeFromUv.zw) / beforeFromUv.xy;
    vec2 place = snapped(clamp(uv * frame.size.xy - 0.5, vec2(-4.0), frame.size.xy + 4.0));
    ivec2 corner = ivec2(floor(place));
    vec2 share = place - floor(place);
    vec4 mean = vec4(0.0);
    float count = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1), pixel = corner + side;
        vec2 each = mix(1.0 - share, share, vec2(side));
        float weight = each.x * each.y;
        if (weight <= 0.0 || pixel != insideOf(pixel))
            continue;
        vec2 known = texelFetch(depthBefore, pixel, 0).rg; // depth, count
        vec2 perDepth = uvOf(pixel) * beforeFromUv.xy + beforeFromUv.zw;
        vec3 found = vec3(perDepth, -1.0) * known.x;
        float pixelWidth = known.x * beforeFromUv.y * frame.size.w;
        if (known.y <= 0.0 || abs(dot(normal, found - position)) > 0.5 * abs(pixelWidth))
            continue;
        mean += weight * texelFetch(meanBefore, pixel, 0);
        count += weight * known.y;
        weights += weight;
    }
    return weights > 0.0 ? History(mean / weights, count / weights) : History(vec4(0.0), 0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 value = texelFetch(visibility, pixel, 0);
    float depth = depthInside(pixel);
    if (isEmpty(depth)) {
        meanOut = value;
        depthOut = vec4(depth, 0.0, 0.0, 0.0);
        return;
    }
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalize(cross(alongSurface(pixel, position, ivec2(1, 0)),
                                  alongSurface(pixel, position, ivec2(0, 1))));
    vec3 before = (beforeFromView * vec4(position, 1.0)).xyz;
    History history = History(vec4(0.0), 0.0);
    if (-before.z > frame.depth.x)
        history = historyAt(before, mat3(beforeFromView) * normal);
    float count = min(history.count + 1.0, frames);
    meanOut = mix(history.mean, value, 1.0 / count);
    depthOut = vec4(depth, count, 0.0, 0.0);
}
