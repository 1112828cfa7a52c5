// The light that each surface sends to the camera, and the background where there is none.
#include "environment.glsl"
#include "view.glsl"

layout(binding = 0) uniform sampler2D albedoBuffer;
layout(binding = 1) uniform sampler2D depthBuffer;

layout(location = 0) out vec4 ambientOut;

#if CONSTANT_AMBIENT
uniform vec3 ambient; // radiance, the same from everywhere
uniform vec3 background;
#else
layout(binding = 3) uniform sampler2D panorama;
#endif

#if !CONSTANT_AMBIENT || SUN
layout(binding = 2) uniform sampler2D normalBuffer;
#endif

#if SUN
layout(location = 1) out vec4 directOut;
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

// Lambert plus normalised Blinn-Phong.
vec3 sunReflected(vec4 albedo, vec3 normal, float power, vec3 towardsEye, vec3 world) {
    float cosine = dot(normal, sunDirection);
    if (cosine <= 0.0)
        return vec3(0.0);
    vec3 halfway = normalize(sunDirection + towardsEye);
    float lobe = (power + 8.0) / 25.1327412 * pow(max(dot(normal, halfway), 0.0), power);
    return sunIrradiance * (cosine * sunlight(world, normal)) *
           (albedo.rgb / 3.14159265 + albedo.a * lobe);
}
#endif

#if !CONSTANT_AMBIENT
vec3 radianceFrom(vec3 direction) {
    float longitude = atan(direction.x, -direction.z),
          colatitude = acos(clamp(direction.y, -1.0, 1.0));
    return textureLod(panorama, vec2(longitude / 6.28318531 + 0.5, colatitude / 3.14159265), 0.0)
        .rgb;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depthBuffer, pixel, 0).r;
    vec3 eye = frame.worldFromView[3].xyz;
    vec3 world = (frame.worldFromView * vec4(viewPosition(uvOf(pixel), depth), 1.0)).xyz;
    vec4 albedo = texelFetch(albedoBuffer, pixel, 0);
#if !CONSTANT_AMBIENT || SUN
    vec4 viewNormal = texelFetch(normalBuffer, pixel, 0);
    vec3 normal = normalize(mat3(frame.worldFromView) * viewNormal.xyz);
#endif

    bool empty = isEmpty(depth);
#if CONSTANT_AMBIENT
    ambientOut = vec4(empty ? background : albedo.rgb * ambient, 1.0);
#else
    ambientOut = vec4(empty ? radianceFrom(normalize(world - eye))
                            : albedo.rgb * irradianceAt(normal) / 3.14159265,
                      1.0);
#endif
#if SUN
    directOut =
        vec4(empty ? vec3(0.0)
                   : sunReflected(albedo, normal, viewNormal.w, normalize(eye - world), world),
             1.0);
#endif
}
