// A glTF material, as GpuScene::draw binds it. What few materials have is a variant
// (renderer/frame/gbuffer.h, MaterialFeatures), so that the others do not pay for it.
layout(binding = 0) uniform sampler2D baseColourMap;
layout(binding = 1) uniform sampler2D normalMap;
layout(binding = 2) uniform sampler2D metallicRoughnessMap;
uniform vec4 baseColour; // linear; multiplied with the map
uniform vec4 surface;    // alpha cutoff (0: opaque), metallic, roughness, normal scale (0: no map)

in vec2 materialUv;
#if COLOURED
in vec4 vertexColour; // linear
#endif

#if TRANSFORMED
in vec2 materialUv1;
// Of each map, by its binding: the columns of the matrix; offset, and which set it reads.
uniform vec4 mapMatrix[MAPS];
uniform vec3 mapOffset[MAPS];
vec2 coordinates(int map) {
    vec2 uv = mapOffset[map].z > 0.5 ? materialUv1 : materialUv;
    return mat2(mapMatrix[map]) * uv + mapOffset[map].xy;
}
#else
vec2 coordinates(int map) { return materialUv; }
#endif

// Coordinates are bounded, for on a triangle seen edge-on interpolation can make them as large as
// can be, and llvmpipe's anisotropic filter, which colour has, counts through the texels of a
// footprint in floats: beyond 2^24 it would never end. The loader keeps the coordinates of
// repeating textures far within the bound.
vec4 colourFrom(sampler2D map, vec2 uv) {
    vec2 bound = 16777216.0 / vec2(textureSize(map, 0));
    return texture(map, clamp(uv, -bound, bound));
}

vec4 baseColourHere() {
    vec4 colour = baseColour * colourFrom(baseColourMap, coordinates(0));
#if COLOURED
    colour *= vertexColour;
#endif
    return colour;
}
