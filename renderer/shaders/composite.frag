// One frame of the final image, and its visibility in alpha.

layout(binding = 0) uniform sampler2D ambientLight;
layout(binding = 1) uniform sampler2D directLight;
layout(binding = 2) uniform sampler2D visibilityBuffer; // of one texel where there is no technique

uniform float exposure; // factor
uniform float white;    // luminance that becomes display white; 0: clamp, no curve
uniform int hasDirect;
uniform int occludeDirect;
uniform int sendsLight; // visibilityBuffer's other channels are light to add
uniform int guard;      // pixels that visibilityBuffer is wider on every side

layout(location = 0) out vec4 displayOut;
layout(location = 1) out vec4 linearOut;

// Reinhard et al. 2002, equation 4, on luminance.
vec3 displayCurve(vec3 colour) {
    float luminance = dot(colour, vec3(0.2126, 0.7152, 0.0722));
    if (white > 0.0 && luminance > 0.0)
        colour *= (1.0 + luminance / (white * white)) / (1.0 + luminance);
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
    colour *= exposure;
    displayOut = vec4(displayCurve(colour), visibility);
    linearOut = vec4(colour, 1.0);
}
