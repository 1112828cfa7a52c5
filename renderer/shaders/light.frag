// The light that each surface sends to the camera, and the background where there is none.
#include "environment.glsl"
#include "view.glsl"

#define DIRECT (SUN || SCENE_LIGHTS)

layout(binding = 0) uniform sampler2D albedoBuffer;
layout(binding = 1) uniform sampler2D depthBuffer;

layout(location = 0) out vec4 ambientOut;

#if CONSTANT_AMBIENT
uniform vec3 ambient; // radiance, the same from everywhere
uniform vec3 background;
#else
layout(binding = 3) uniform sampler2D panorama; // levels of roughness (renderer/frame/panorama.h)
uniform float sharpLevel, roughLevel;           // those of roughness 0 and 1
layout(binding = 5) uniform sampler2D reflectanceTable;
#endif

#if !CONSTANT_AMBIENT || DIRECT
layout(binding = 2) uniform sampler2D normalBuffer;
#endif

// What one pixel shows, in the world.
struct Surface {
    vec3 place, normal, towardsEye;
    vec3 colour; // a metal's reflectance face-on; another's albedo, which reflects 0.04 face-on
    float metallic, roughness;
};

#if DIRECT
layout(location = 1) out vec4 directOut;

// What a surface sends on of the irradiance that comes from a direction: Lambert plus normalised
// Blinn-Phong, whose power has the lobe width of GGX: 2 / alpha^2 - 2, alpha = roughness^2 (Walter
// et al. 2007).
vec3 sentOn(Surface s, vec3 towardsLight) {
    float alpha = s.roughness * s.roughness;
    float power = clamp(2.0 / (alpha * alpha) - 2.0, 1.0, 2048.0);
    vec3 halfway = normalize(towardsLight + s.towardsEye);
    float lobe = (power + 8.0) / 25.1327412 * pow(max(dot(s.normal, halfway), 0.0), power);
    return s.colour * ((1.0 - s.metallic) / 3.14159265) +
           mix(vec3(0.04), s.colour, s.metallic) * lobe;
}
#endif

#if SUN
layout(binding = 4) uniform sampler2DShadow shadowMap;
uniform mat4 lightFromWorld;
uniform vec3 sunDirection; // towards it, world space
uniform vec3 sunIrradiance;
uniform float shadowTexel; // metres

// The share of sunlight that arrives: the mean of sixteen comparisons on a disc of 2.5 texels
// (Vogel's spiral), each bilinear. The point is moved along the normal to clear its own surface.
float sunlight(vec3 world, vec3 normal) {
    vec3 lifted = world + normal * (1.5 * shadowTexel);
    vec3 light = (lightFromWorld * vec4(lifted, 1.0)).xyz;
    vec2 uv = light.xy * 0.5 + 0.5;
    vec2 texel = 2.5 / vec2(textureSize(shadowMap, 0));
    float sum = 0.0;
    for (int i = 0; i < 16; ++i) {
        float radius = sqrt((float(i) + 0.5) / 16.0), angle = 2.39996323 * float(i);
        vec2 tap = uv + texel * radius * vec2(cos(angle), sin(angle));
        sum += texture(shadowMap, vec3(tap, light.z));
    }
    return sum / 16.0;
}

vec3 fromSun(Surface s) {
    float cosine = dot(s.normal, sunDirection);
    if (cosine <= 0.0)
        return vec3(0.0);
    return sunIrradiance * (cosine * sunlight(s.place, s.normal)) * sentOn(s, sunDirection);
}
#endif

#if SCENE_LIGHTS
struct SceneLight {
    vec4 position;  // .w 0: directional
    vec4 direction; // that the light goes; .w range in metres, 0: none
    vec4 intensity; // candela; lux of a directional one
    vec4 falloff;   // of a spot: .x scale, .y offset of the cosine
};
layout(std430, binding = 5) readonly buffer SceneLights { SceneLight sceneLights[]; };

// KHR_lights_punctual, without shadows.
vec3 fromSceneLight(Surface s, SceneLight light) {
    vec3 way = light.position.xyz - s.place;
    float squared = max(dot(way, way), 1e-8);
    vec3 towards = light.position.w > 0.0 ? way * inversesqrt(squared) : -light.direction.xyz;
    float cosine = dot(s.normal, towards);
    if (cosine <= 0.0)
        return vec3(0.0);
    float arrives = 1.0;
    if (light.position.w > 0.0) {
        float range = light.direction.w, share = squared / (range * range);
        float window = range > 0.0 ? clamp(1.0 - share * share, 0.0, 1.0) : 1.0;
        float cone = clamp(light.falloff.x * dot(light.direction.xyz, -towards) + light.falloff.y,
                           0.0, 1.0);
        arrives = window * cone * cone / squared;
    }
    return light.intensity.rgb * (arrives * cosine) * sentOn(s, towards);
}

vec3 fromSceneLights(Surface s) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < sceneLights.length(); ++i)
        sum += fromSceneLight(s, sceneLights[i]);
    return sum;
}
#endif

#if !CONSTANT_AMBIENT
vec3 radianceFrom(vec3 direction, float level) {
    float longitude = atan(direction.x, -direction.z),
          colatitude = acos(clamp(direction.y, -1.0, 1.0));
    return textureLod(panorama, vec2(longitude / 6.28318531 + 0.5, colatitude / 3.14159265), level)
        .rgb;
}

// Scale and offset of the reflectance face-on, under light from everywhere.
vec2 reflectance(float roughness, float cosine) {
    vec2 size = vec2(textureSize(reflectanceTable, 0));
    return textureLod(reflectanceTable, (vec2(cosine, roughness) * (size - 1.0) + 0.5) / size, 0.0)
        .rg;
}

// The shares of light that a surface mirrors once, and more than once within its roughness: with
// both, a white metal sends on all that arrives (Fdez-Aguera 2019, "A multiple-scattering
// microfacet model for real-time image-based lighting").
struct Mirrored {
    vec3 once, again;
};
Mirrored mirrored(vec3 faceOn, vec2 fit) {
    // Nothing reflects less than 2 %: what does is in the shadow of its own roughness (as Karis).
    float grazing = clamp(50.0 * max(max(faceOn.r, faceOn.g), faceOn.b), 0.0, 1.0);
    vec3 once = max(faceOn * fit.x + grazing * fit.y, vec3(0.0));
    vec3 mean = faceOn + (vec3(grazing) - faceOn) / 21.0; // over all directions
    float lost = 1.0 - fit.x - fit.y;
    return Mirrored(once, lost * once * mean / (1.0 - lost * mean));
}

// What a surface sends on of the light around it: `radiance` comes mirrored, filtered by roughness;
// `irradiance` from all directions. What others than metals do not mirror they scatter.
vec3 fromAround(Surface s, vec3 radiance, vec3 irradiance) {
    vec2 fit = reflectance(s.roughness, clamp(dot(s.normal, s.towardsEye), 0.0, 1.0));
    Mirrored metal = mirrored(s.colour, fit), other = mirrored(vec3(0.04), fit);
    vec3 scattered = s.colour * (1.0 - other.once - other.again);
    return mix(other.once, metal.once, s.metallic) * radiance +
           mix(other.again + scattered, metal.again, s.metallic) * irradiance / 3.14159265;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depthBuffer, pixel, 0).r;
    vec4 albedo = texelFetch(albedoBuffer, pixel, 0);
    bool empty = isEmpty(depth);
#if !CONSTANT_AMBIENT || DIRECT
    vec4 viewNormal = texelFetch(normalBuffer, pixel, 0);
    Surface s;
    s.place = (frame.worldFromView * vec4(viewPosition(uvOf(pixel), depth), 1.0)).xyz;
    s.normal = normalize(mat3(frame.worldFromView) * viewNormal.xyz);
    s.towardsEye = normalize(frame.worldFromView[3].xyz - s.place);
    s.colour = albedo.rgb;
    s.metallic = albedo.a;
    s.roughness = viewNormal.w;
#endif

#if CONSTANT_AMBIENT
    // All of a metal's colour is sent on, for that is what it mirrors of light that is everywhere
    // the same.
    ambientOut = vec4(empty ? background : albedo.rgb * ambient, 1.0);
#else
    vec3 radiance = radianceFrom(empty ? -s.towardsEye : reflect(-s.towardsEye, s.normal),
                                 empty ? 0.0 : mix(sharpLevel, roughLevel, s.roughness));
    ambientOut = vec4(empty ? radiance : fromAround(s, radiance, irradianceAt(s.normal)), 1.0);
#endif
#if DIRECT
    vec3 direct = vec3(0.0);
#if SUN
    direct += fromSun(s);
#endif
#if SCENE_LIGHTS
    direct += fromSceneLights(s);
#endif
    directOut = vec4(empty ? vec3(0.0) : direct, 1.0);
#endif
}
