layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;

uniform mat4 lightFromWorld;
out vec2 materialUv;

void main() {
    materialUv = uv;
    gl_Position = lightFromWorld * vec4(position, 1.0);
}
