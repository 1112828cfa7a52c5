// A buffer as the viewer shows it: sRGB code values of 8 bits, the very ones that image files get.
// WHAT names what is shown.
#define LIT 0        // source: display-linear colour
#define GREY 1       // source: visibility
#define ALBEDO 2     // source: colour
#define NORMALS 3    // source: view space
#define DEPTH 4      // source: view depth
#define ERROR 5      // source: visibility; other: the reference's
#define JOD 6        // source: 1 - JOD / 10
#define DIFFERENCE 7 // source and other: visibility
#define LUMA 8       // source and other: pictures of code values

#include "view.glsl"

layout(binding = 0) uniform sampler2D source;
layout(binding = 1) uniform sampler2D other;
layout(binding = 2) uniform sampler2D depthBuffer;
layout(binding = 3) uniform sampler2D colours; // one row of code values / 255
layout(binding = 4) uniform sampler2D steps;   // [k]: the least linear value with code k

uniform int guard;      // pixels that `source` is wider on every side
uniform int otherGuard; // and `other`
uniform float scale;    // what gets the last colour
uniform vec4 range;     // of depth: nearest, softening (metres), logarithm of their ratio

layout(location = 0) out vec4 shown;

const vec3 nothing = vec3(30.0, 30.0, 34.0) / 255.0; // where no surface is

// A shader's pow need not round as a processor's does; the table decides between neighbours.
float codeOf(float linear) {
    linear = clamp(linear, 0.0, 1.0);
    float srgb = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
    int code = clamp(int(srgb * 255.0 + 0.5), 0, 255);
    if (code < 255 && linear >= texelFetch(steps, ivec2(code + 1, 0), 0).r)
        ++code;
    else if (code > 0 && linear < texelFetch(steps, ivec2(code, 0), 0).r)
        --code;
    return float(code) / 255.0;
}

vec3 codesOf(vec3 linear) { return vec3(codeOf(linear.r), codeOf(linear.g), codeOf(linear.b)); }

// Of 0 ... 1.
vec3 colourOf(float share) {
    int last = textureSize(colours, 0).x - 1;
    return texelFetch(colours, ivec2(int(clamp(share, 0.0, 1.0) * float(last) + 0.5), 0), 0).rgb;
}

// A technique that has no passes has one texel.
float visibilityIn(sampler2D values, ivec2 pixel) {
    return texelFetch(values, min(pixel, textureSize(values, 0) - 1), 0).r;
}

vec3 shownAt(ivec2 pixel) {
#if WHAT == LIT
    return codesOf(texelFetch(source, pixel, 0).rgb);
#elif WHAT == GREY
    return vec3(codeOf(visibilityIn(source, pixel + guard)));
#elif WHAT == LUMA
    vec3 change = texelFetch(source, pixel, 0).rgb - texelFetch(other, pixel, 0).rgb;
    return colourOf(0.5 + 0.5 * dot(change, vec3(0.2126, 0.7152, 0.0722)) / scale);
#elif WHAT == JOD
    return colourOf(texelFetch(source, pixel, 0).r / scale);
#else
    float depth = texelFetch(depthBuffer, pixel, 0).r;
    if (isEmpty(depth))
        return nothing;
#if WHAT == ALBEDO
    return codesOf(texelFetch(source, pixel, 0).rgb);
#elif WHAT == NORMALS
    return mat3(frame.worldFromView) * normalize(texelFetch(source, pixel, 0).xyz) * 0.5 + 0.5;
#elif WHAT == DEPTH
    return colourOf(log((depth + range.y) / (range.x + range.y)) / range.z);
#elif WHAT == ERROR
    float missing = visibilityIn(other, pixel) - visibilityIn(source, pixel + guard);
    return colourOf(0.5 + 0.5 * missing / scale);
#elif WHAT == DIFFERENCE
    float change = visibilityIn(source, pixel + guard) - visibilityIn(other, pixel + otherGuard);
    return colourOf(0.5 + 0.5 * change / scale);
#endif
#endif
}

void main() { shown = vec4(shownAt(ivec2(gl_FragCoord.xy)), 1.0); }
