#include "material.glsl"
#if GLOSSINESS
#include "glossiness.glsl"
#endif

in vec3 viewNormal;
in vec4 viewTangent;
in vec3 viewPlace;

uniform int faceNormals; // occlusion normals are the triangle's own

// Targets as in the thesis' table 1, with more bits for the normal, and metallic and roughness in
// the place of the intensity and the power of a highlight.
layout(location = 0) out vec4 albedoOut; // base colour; alpha: metallic
layout(location = 1) out float depthOut;
layout(location = 2) out vec4 normalOut; // alpha: roughness
layout(location = 3) out vec4 occlusionNormalOut;

#if EMISSION
layout(binding = 3) uniform sampler2D emissionMap;
uniform vec4 emission; // linear, multiplied with the map; alpha: 1 where the material is unlit
layout(location = 4) out vec4 emissionOut;
#endif

vec3 shadingNormal() {
    vec3 n = normalize(viewNormal);
    vec3 across = viewTangent.xyz - n * dot(n, viewTangent.xyz);
    // Where the loader found no direction for the map's x, the normal map is not used.
    if (surface.w > 0.0 && dot(across, across) > 1e-8) {
        vec3 mapped = texture(normalMap, coordinates(1)).xyz * 2.0 - 1.0;
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

// The interpolated normal on the side that is seen. Where it faces away from the viewer, as at the
// silhouettes of coarse meshes and where a file's normals contradict its triangles' winding, much
// of its hemisphere lies behind the surface, and a tracer would call that blocked. Such a normal is
// mirrored to the triangle's visible side, and from there bent until it is seen edge on.
// (renderer/reference/sight.cpp does the same.)
vec3 smoothNormal() {
    vec3 n = gl_FrontFacing ? normalize(viewNormal) : -normalize(viewNormal);
    vec3 view = -normalize(viewPlace), face = faceNormal();
    if (dot(n, view) >= 0.0)
        return n;
    n -= 2.0 * min(dot(n, face), 0.0) * face;
    return normalize(n - min(dot(n, view), 0.0) * view);
}

void main() {
    vec4 colour = baseColourHere();
#if GLOSSINESS
    MetallicRoughness is = fromGlossiness(
        colour.rgb, specularGlossiness * colourFrom(metallicRoughnessMap, coordinates(2)));
    albedoOut = vec4(is.baseColour, is.metallic);
    float roughness = is.roughness;
#else
    vec4 metallicRoughness = texture(metallicRoughnessMap, coordinates(2));
    albedoOut = vec4(colour.rgb, surface.y * metallicRoughness.b);
    float roughness = surface.z * metallicRoughness.g;
#endif
    normalOut = vec4(shadingNormal(), clamp(roughness, 0.045, 1.0));
    occlusionNormalOut = vec4(faceNormals != 0 ? faceNormal() : smoothNormal(), 0.0);
    depthOut = -viewPlace.z;
#if EMISSION
    emissionOut = vec4(emission.rgb * colourFrom(emissionMap, coordinates(3)).rgb, 1.0);
    if (emission.a > 0.0) { // shows its colour, and a black metal reflects nothing
        emissionOut.rgb = colour.rgb;
        albedoOut = vec4(0.0, 0.0, 0.0, 1.0);
    }
    emissionOut.rgb = min(emissionOut.rgb, vec3(65504.0)); // the most that the target holds
#endif
}
