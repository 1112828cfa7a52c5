// The sample kernel that Blizzard's technique and ray-marching share (Jakobsen 2010, section
// 4.3.2.2): points of the unit ball, reflected by the tile's random vector, then flipped to the
// normal's side. In the limit they fill the half-ball evenly.
vec3 hemisphereOffset(vec3 point, vec3 mirror, vec3 normal) {
    vec3 offset = reflect(point, mirror);
    return dot(offset, normal) < 0.0 ? -offset : offset;
}
