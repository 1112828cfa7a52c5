// A glTF metallic-roughness material, as GpuScene::draw binds it.
layout(binding = 0) uniform sampler2D baseColourMap;
layout(binding = 1) uniform sampler2D normalMap;
layout(binding = 2) uniform sampler2D metallicRoughnessMap;
uniform vec4 baseColour; // linear; multiplied with the map
uniform vec4 surface;    // alpha cutoff (0: opaque), metallic, roughness, normal scale (0: no map)

// Coordinates are bounded, for on a triangle seen edge-on interpolation can make them as large as
// can be, and llvmpipe's anisotropic filter counts through the texels of a footprint in floats:
// beyond 2^24 it would never end. The loader keeps the coordinates of repeating textures far within
// the bound.
vec4 baseColourAt(vec2 uv) {
    vec2 bound = 16777216.0 / vec2(textureSize(baseColourMap, 0));
    return baseColour * texture(baseColourMap, clamp(uv, -bound, bound));
}
