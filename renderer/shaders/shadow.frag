#include "material.glsl"

in vec2 materialUv;

void main() {
    cutOut(materialUv);
}
