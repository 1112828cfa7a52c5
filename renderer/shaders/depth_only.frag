// Depth alone. Where a masked material has a hole, nothing is drawn.
#if MASKED
#include "material.glsl"

in vec2 materialUv;

void main() {
    if (baseColourAt(materialUv).a < surface.x)
        discard;
}
#else
void main() {}
#endif
