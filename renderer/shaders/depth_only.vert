layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;

uniform mat4 clipFromWorld;
out vec2 materialUv;
invariant gl_Position; // the G-buffer's pass must meet the very same depth

void main() {
    materialUv = uv;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
