// One frame of the final image, and its visibility in alpha.

layout(binding = 0) uniform sampler2D ambientLight;
layout(binding = 1) uniform sampler2D directLight;
layout(binding = 2) uniform sampler2D visibilityBuffer; // of one texel where there is no technique
layout(binding = 3) uniform sampler2D emissionBuffer;

uniform float exposure; // factor
uniform int curve;      // as `Curve` (protocols/reader/study.h)
uniform float white;    // Reinhard's: the luminance that becomes display white
uniform int hasDirect;
uniform int hasEmission;
uniform int occludeDirect;
uniform int sendsLight; // visibilityBuffer's other channels are light to add
uniform int guard;      // pixels that visibilityBuffer is wider on every side

layout(location = 0) out vec4 displayOut;
layout(location = 1) out vec4 linearOut;

// Reinhard et al. 2002, equation 4, on luminance.
vec3 reinhard(vec3 colour) {
    float luminance = dot(colour, vec3(0.2126, 0.7152, 0.0722));
    return luminance > 0.0 ? colour * (1.0 + luminance / (white * white)) / (1.0 + luminance)
                           : colour;
}

// Stephen Hill's fit of the Academy's reference rendering and output transforms for sRGB displays
// (in M. Pettineo's BakingLab, ACES.hlsl, 2016), without any exposure of its own.
vec3 aces(vec3 colour) {
    const mat3 fromSrgb = mat3(0.59719, 0.07600, 0.02840, //
                               0.35458, 0.90834, 0.13383, //
                               0.04823, 0.01566, 0.83777),
               toSrgb = mat3(1.60475, -0.10208, -0.00327, //
                             -0.53108, 1.10813, -0.07276, //
                             -0.07367, -0.00605, 1.07602);
    vec3 v = fromSrgb * colour;
    return toSrgb *
           ((v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081));
}

// Khronos PBR Neutral (Khronos 2024): colours stay as they are but for the 4 % that dielectrics
// reflect, up to 0.8 of display white; beyond, they are compressed and fade to white.
vec3 neutral(vec3 colour) {
    const float start = 0.8 - 0.04, fade = 0.15;
    float least = min(min(colour.r, colour.g), colour.b);
    colour -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    float peak = max(max(colour.r, colour.g), colour.b);
    if (peak < start)
        return colour;
    float room = 1.0 - start, newPeak = 1.0 - room * room / (peak + room - start);
    return mix(colour * (newPeak / peak), vec3(newPeak),
               1.0 - 1.0 / (fade * (peak - newPeak) + 1.0));
}

vec3 displayCurve(vec3 colour) {
    if (curve == 1)
        colour = reinhard(colour);
    else if (curve == 2)
        colour = aces(colour);
    else if (curve == 3)
        colour = neutral(colour);
    return clamp(colour, 0.0, 1.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 occlusion =
        texelFetch(visibilityBuffer, min(pixel + guard, textureSize(visibilityBuffer, 0) - 1), 0);
    float visibility = occlusion.r;
    vec3 colour = texelFetch(ambientLight, pixel, 0).rgb * visibility;
    if (sendsLight != 0)
        colour = max(colour + occlusion.gba, vec3(0.0));
    if (hasDirect != 0)
        colour += texelFetch(directLight, pixel, 0).rgb * (occludeDirect != 0 ? visibility : 1.0);
    if (hasEmission != 0)
        colour += texelFetch(emissionBuffer, pixel, 0).rgb;
    colour *= exposure;
    displayOut = vec4(displayCurve(colour), visibility);
    linearOut = vec4(colour, 1.0);
}
