// Depth alone. Where a masked material has a hole, nothing is drawn.
#if MASKED
#include "material.glsl"

void main() {
    if (baseColourHere().a < surface.x)
        discard;
}
#else
void main() {}
#endif
