// One box per triangle, seen from within: its far sides. They cover each pixel behind which the box
// lies once, wherever the camera is.

flat out vec4 a, b, c; // view space; as in Occluder

void main() {
    Occluder triangle = occluders[gl_VertexID / 36];
    a = vec4((frame.viewFromWorld * vec4(triangle.a.xyz, 1.0)).xyz, triangle.a.w);
    b = vec4((frame.viewFromWorld * vec4(triangle.b.xyz, 1.0)).xyz, triangle.b.w);
    c = vec4((frame.viewFromWorld * vec4(triangle.c.xyz, 1.0)).xyz, triangle.c.w);

    vec3 sides[3] = vec3[3](b.xyz - a.xyz, c.xyz - b.xyz, a.xyz - c.xyz);
    vec3 squared = vec3(dot(sides[0], sides[0]), dot(sides[1], sides[1]), dot(sides[2], sides[2]));
    bool first = squared.x >= squared.y && squared.x >= squared.z;
    vec3 along = normalize(first ? sides[0] : squared.y >= squared.z ? sides[1] : sides[2]);
    vec3 facing = normalize(cross(sides[0], sides[1]));
    vec3 across = cross(facing, along);
    mat3 axes = mat3(along, across, facing);
    vec3 places[3] = vec3[3](a.xyz * axes, b.xyz * axes, c.xyz * axes); // along each axis
    vec3 low =
        min(places[0], min(places[1], places[2])) - settings.radius * vec3(1.0, 1.0, triangle.b.w);
    vec3 high = max(places[0], max(places[1], places[2])) + settings.radius;

    // Two triangles for each of the six sides, with the clock as seen from outside.
    const int corners[6] = int[6](0, 1, 2, 2, 1, 3);
    int corner = gl_VertexID % 36, side = corner / 6, axis = side >> 1;
    int at = corners[corner % 6];
    bool top = (side & 1) == 1;
    if (top)
        at = (at & 1) * 2 + (at >> 1); // the other way round
    bvec3 isHigh;
    isHigh[axis] = top;
    isHigh[(axis + 1) % 3] = (at & 1) == 0;
    isHigh[(axis + 2) % 3] = (at & 2) == 0;
    gl_Position = frame.clipFromView * vec4(axes * mix(low, high, isHigh), 1.0);
}
