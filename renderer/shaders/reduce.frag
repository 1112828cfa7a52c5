// Every nth pixel's depth and normal (renderer/techniques/reduction.h).

layout(binding = 0) uniform sampler2D depthBuffer;
layout(binding = 1) uniform sampler2D normalBuffer;
uniform int factor;
uniform int hasNormals;
layout(location = 0) out float depthOut;
layout(location = 1) out vec4 normalOut;

void main() {
    ivec2 pixel = min(ivec2(gl_FragCoord.xy) * factor + factor / 2, ivec2(frame.size.xy) - 1);
    depthOut = texelFetch(depthBuffer, pixel, 0).r;
    if (hasNormals != 0)
        normalOut = texelFetch(normalBuffer, pixel, 0);
}
