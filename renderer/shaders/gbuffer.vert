layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 colour;

uniform mat4 clipFromWorld;
invariant gl_Position;

out vec3 viewNormal;
out vec4 viewTangent;
out vec2 materialUv;
#if TRANSFORMED
out vec2 materialUv1;
#endif
#if COLOURED
out vec4 vertexColour;
#endif
out vec3 viewPlace;

void main() {
    vec4 viewPosition = frame.viewFromWorld * vec4(position, 1.0);
    mat3 rotation = mat3(frame.viewFromWorld);
    viewNormal = rotation * normal;
    viewTangent = vec4(rotation * tangent.xyz, tangent.w);
    materialUv = uv;
#if TRANSFORMED
    materialUv1 = uv1;
#endif
#if COLOURED
    vertexColour = colour;
#endif
    viewPlace = viewPosition.xyz;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
