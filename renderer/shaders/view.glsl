// Between pixels, linear view depth and view space (right-handed, camera at the origin looking
// along -z). Depth is the positive distance along the view axis, in metres.

vec2 uvOf(ivec2 pixel) { return (vec2(pixel) + 0.5) * frame.size.zw; }

ivec2 pixelOf(vec2 uv) {
    return clamp(ivec2(floor(uv * frame.size.xy)), ivec2(0), ivec2(frame.size.xy) - 1);
}

vec3 viewPosition(vec2 uv, float depth) {
    return vec3((uv * frame.viewFromUv.xy + frame.viewFromUv.zw) * depth, -depth);
}

// A point behind the nearest plane is projected as if on it.
vec2 uvFromView(vec3 position) {
    float depth = max(-position.z, frame.depth.x);
    return (position.xy / depth - frame.viewFromUv.zw) / frame.viewFromUv.xy;
}

// Pixels that show no surface hold this depth.
bool isEmpty(float depth) { return depth >= frame.depth.y; }
