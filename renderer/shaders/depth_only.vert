layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 colour;

uniform mat4 clipFromWorld;
invariant gl_Position; // the G-buffer's pass must meet the very same depth

out vec2 materialUv;
#if TRANSFORMED
out vec2 materialUv1;
#endif
#if COLOURED
out vec4 vertexColour;
#endif

void main() {
    materialUv = uv;
#if TRANSFORMED
    materialUv1 = uv1;
#endif
#if COLOURED
    vertexColour = colour;
#endif
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
