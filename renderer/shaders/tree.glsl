// Rays against the scene's triangles, as renderer/frame/triangle_buffers.h lays them out. Nodes come
// in the order of visits, and each knows where to go on if the ray misses it, so no stack is needed;
// for a short ray that may meet anything, no order of visits is better than another.

// The alpha of a texel; `wrapped` places are inside.
float alphaTexel(uint map, ivec2 place, int width) {
    int i = place.x + place.y * width;
    return float((masks[map + 3u + uint(i >> 2)] >> uint(8 * (i & 3))) & 255u) * (1.0 / 255.0);
}
// Wrap: 0 repeats, 1 mirrors, 2 clamps.
int wrapped(float place, float size, uint wrap) {
    float period = wrap == 1u ? 2.0 * size : size;
    if (wrap != 2u)
        place -= period * floor(place / period);
    if (wrap == 1u && place >= size)
        place = period - 1.0 - place;
    return int(clamp(place, 0.0, size - 1.0));
}

// OpenGL 4.5, section 8.14, of level 0.
float alphaAt(uint map, vec2 uv) {
    vec2 size = vec2(masks[map], masks[map + 1u]);
    uint how = masks[map + 2u], across = how & 3u, up = (how >> 2u) & 3u;
    bool nearest = how >= 16u;
    vec2 place = uv * size - (nearest ? 0.0 : 0.5), low = floor(place), part = place - low;
    int width = int(size.x);
    int x0 = wrapped(low.x, size.x, across), x1 = wrapped(low.x + 1.0, size.x, across);
    int y0 = wrapped(low.y, size.y, up), y1 = wrapped(low.y + 1.0, size.y, up);
    float corner = alphaTexel(map, ivec2(x0, y0), width);
    if (nearest)
        return corner;
    return mix(mix(corner, alphaTexel(map, ivec2(x1, y0), width), part.x),
               mix(alphaTexel(map, ivec2(x0, y1), width), alphaTexel(map, ivec2(x1, y1), width),
                   part.x),
               part.y);
}

// Whether the triangle has a hole there; `place` weighs its second and third corner.
bool isHole(uint mask, vec2 place) {
    vec3 a = uintBitsToFloat(uvec3(masks[mask], masks[mask + 1u], masks[mask + 2u])),
         b = uintBitsToFloat(uvec3(masks[mask + 3u], masks[mask + 4u], masks[mask + 5u])),
         c = uintBitsToFloat(uvec3(masks[mask + 6u], masks[mask + 7u], masks[mask + 8u]));
    vec3 here = a * (1.0 - place.x - place.y) + b * place.x + c * place.y;
    uint map = masks[mask + 10u];
    return here.z * (map > 0u ? alphaAt(map, here.xy) : 1.0) < uintBitsToFloat(masks[mask + 9u]);
}

// Moeller and Trumbore 1997.
bool meets(int triangle, vec3 origin, vec3 direction, float radius) {
    vec4 corner = triangles[3 * triangle];
    vec3 along = triangles[3 * triangle + 1].xyz - corner.xyz,
         up = triangles[3 * triangle + 2].xyz - corner.xyz;
    vec3 p = cross(direction, up), from = origin - corner.xyz, q = cross(from, along);
    float inverse = 1.0 / dot(along, p);
    vec2 place = vec2(dot(from, p), dot(direction, q)) * inverse;
    float distance = dot(up, q) * inverse;
    // Written so that a triangle without an area, which gives infinity or NaN, is missed.
    bool hit = place.x >= 0.0 && place.y >= 0.0 && place.x + place.y <= 1.0 && distance > 0.0 &&
               distance < radius;
    return hit && !(corner.w >= 0.0 && isHole(uint(corner.w), place));
}

// Whether a ray from `origin` (world space) meets anything within the radius.
bool isBlocked(vec3 origin, vec3 direction, float radius) {
    vec3 safe = mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    vec3 inverse = 1.0 / safe, start = origin * inverse;
    int end = nodes.length() / 2, node = 0;
    while (node < end) {
        uvec4 low = nodes[2 * node], high = nodes[2 * node + 1];
        if (low.w == 0u) // llvmpipe gives zeros to lanes that cover no pixel; they must end too
            return false;
        vec3 a = uintBitsToFloat(low.xyz) * inverse - start,
             b = uintBitsToFloat(high.xyz) * inverse - start;
        vec3 entry = min(a, b), leaving = max(a, b);
        float enters = max(max(entry.x, entry.y), max(entry.z, 0.0));
        float leaves = min(min(leaving.x, leaving.y), min(leaving.z, radius));
        // Rounding must not lose flat boxes.
        if (enters > leaves * 1.000002 + 1e-30) {
            node = int(low.w);
            continue;
        }
        int first = int(high.w >> 3u), last = first + int(high.w & 7u);
        for (int i = first; i < last; ++i)
            if (meets(i, origin, direction, radius))
                return true;
        ++node;
    }
    return false;
}
