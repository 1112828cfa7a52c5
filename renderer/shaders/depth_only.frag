// Depth alone. Where a masked material has a hole, nothing is drawn; nor is, where layers are
// peeled, what does not lie far enough behind the layer before.
#if MASKED
#include "material.glsl"
#endif

#if PEELED
layout(binding = 4) uniform sampler2D before; // linear view depth
uniform float separation;                     // metres of view depth
layout(location = 0) out float depthOut;      // the same as in the G-buffer
#endif

void main() {
#if PEELED
    depthOut = 1.0 / gl_FragCoord.w;
    if (depthOut < texelFetch(before, ivec2(gl_FragCoord.xy), 0).r + separation)
        discard;
#endif
#if MASKED
    if (baseColourHere().a < surface.x)
        discard;
#endif
}
