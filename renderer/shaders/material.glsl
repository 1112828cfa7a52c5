// A glTF metallic-roughness material, as GpuScene::draw binds it.
layout(binding = 0) uniform sampler2D baseColourMap;
layout(binding = 1) uniform sampler2D normalMap;
layout(binding = 2) uniform sampler2D metallicRoughnessMap;
uniform vec4 baseColour; // linear; multiplied with the map
uniform vec4 surface;    // alpha cutoff (0: opaque), metallic, roughness, normal scale (0: no map)

// The base colour at uv; where the material has a hole, nothing is drawn.
vec4 cutOut(vec2 uv) {
    vec4 colour = baseColour * texture(baseColourMap, uv);
    if (colour.a < surface.x)
        discard;
    return colour;
}
