// KHR_materials_pbrSpecularGlossiness as metallic and roughness: what reflects like the material
// that the two colours describe, as far as one base colour can say it (Khronos, the extension's
// example "convert-between-workflows").

uniform vec4 specularGlossiness; // linear; multiplied with the map, which has glossiness in alpha

struct MetallicRoughness {
    vec3 baseColour;
    float metallic, roughness;
};

float brightness(vec3 colour) { return sqrt(dot(colour * colour, vec3(0.299, 0.587, 0.114))); }

// The share of metal that a surface of these brightnesses has, where a dielectric reflects 0.04.
float metallicOf(float diffuse, float specular, float left) {
    const float dielectric = 0.04;
    float b = diffuse * left / (1.0 - dielectric) + specular - 2.0 * dielectric;
    float c = dielectric - specular;
    float root = sqrt(max(b * b - 4.0 * dielectric * c, 0.0));
    return specular < dielectric ? 0.0 : clamp((root - b) / (2.0 * dielectric), 0.0, 1.0);
}

MetallicRoughness fromGlossiness(vec3 diffuse, vec4 specular) {
    float left = 1.0 - max(max(specular.r, specular.g), specular.b);
    float metallic = metallicOf(brightness(diffuse), brightness(specular.rgb), left);
    vec3 ofDiffuse = diffuse * left / (0.96 * max(1.0 - metallic, 1e-6)),
         ofSpecular = (specular.rgb - 0.04 * (1.0 - metallic)) / max(metallic, 1e-6);
    vec3 baseColour = clamp(mix(ofDiffuse, ofSpecular, metallic * metallic), 0.0, 1.0);
    return MetallicRoughness(baseColour, metallic, 1.0 - specular.a);
}
