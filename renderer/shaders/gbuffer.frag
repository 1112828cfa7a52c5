#include "material.glsl"

in vec3 viewNormal;
in vec4 viewTangent;
in vec2 materialUv;
in vec3 viewPlace;

uniform int faceNormals; // occlusion normals are the triangle's own

// Targets as in the thesis' table 1, with more bits for the normal.
layout(location = 0) out vec4 albedoOut; // alpha: specular intensity
layout(location = 1) out float depthOut;
layout(location = 2) out vec4 normalOut; // alpha: specular power
layout(location = 3) out vec4 occlusionNormalOut;

vec3 shadingNormal() {
    vec3 n = normalize(viewNormal);
    vec3 across = viewTangent.xyz - n * dot(n, viewTangent.xyz);
    // Where the loader found no direction for the map's x, the normal map is not used.
    if (surface.w > 0.0 && dot(across, across) > 1e-8) {
        vec3 mapped = texture(normalMap, materialUv).xyz * 2.0 - 1.0;
        mapped.xy *= surface.w;
        vec3 t = normalize(across);
        n = normalize(mat3(t, cross(n, t) * viewTangent.w, n) * mapped);
    }
    return gl_FrontFacing ? n : -n;
}

// The triangle's normal on the side that is seen.
vec3 faceNormal() {
    vec3 n = normalize(cross(dFdx(viewPlace), dFdy(viewPlace)));
    return dot(n, viewPlace) > 0.0 ? -n : n;
}

void main() {
    vec4 colour = baseColourAt(materialUv);
    vec4 metallicRoughness = texture(metallicRoughnessMap, materialUv);
    float metallic = surface.y * metallicRoughness.b;
    float roughness = clamp(surface.z * metallicRoughness.g, 0.045, 1.0);

    // Blinn-Phong's power of the same lobe width: 2 / alpha^2 - 2, alpha = roughness^2 (Walter et
    // al. 2007). A metal keeps its base colour as diffuse albedo, because this lighting model, like
    // the thesis', has no reflected environment that could show it.
    float alpha = roughness * roughness;
    float luminance = dot(colour.rgb, vec3(0.2126, 0.7152, 0.0722));
    albedoOut = vec4(colour.rgb, mix(0.04, luminance, metallic));
    normalOut = vec4(shadingNormal(), clamp(2.0 / (alpha * alpha) - 2.0, 1.0, 2048.0));
    vec3 smoothNormal = gl_FrontFacing ? normalize(viewNormal) : -normalize(viewNormal);
    occlusionNormalOut = vec4(faceNormals != 0 ? faceNormal() : smoothNormal, 0.0);
    depthOut = -viewPlace.z;
}
