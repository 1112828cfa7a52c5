// Where line samples are taken: pixels of a disc through a ball's centre (Loos and Sloan 2010;
// Szirmay-Kalos et al. 2010). Both papers lay the disc across the view axis. Ours lies across the
// way to the ball: near the image's border theirs would shear the ball into its own plane.

#include "depth.glsl"
#include "noise.glsl"

struct Disc {
    vec3 centre, across, up; // both of the ball's radius, turned by the tile's vector
    float shift;             // 0 ... 1, of the tap's place between one ring and the next
};

Disc discOf(vec3 centre, float radius, ivec2 pixel) {
    vec3 axis = centre / max(length(centre), 1e-20);
    float side = axis.z >= 0.0 ? 1.0 : -1.0; // Duff et al. 2017, a basis without bad directions
    float a = -1.0 / (side + axis.z), b = axis.x * axis.y * a;
    vec3 first = vec3(1.0 + side * axis.x * axis.x * a, side * b, -side * axis.x);
    vec3 second = vec3(b, side + axis.y * axis.y * a, -axis.y);
    // The turn comes from the heights of the tile's sixteen vectors, which are evenly spaced, and
    // the shift from their azimuths. Azimuths cannot make the turn: they are golden angles, as
    // those between taps are, so that turned discs would fall onto each other.
    vec3 random = tileDirection(pixel);
    float angle = 3.14159265 * random.z + 6.28318531 * unitFloat(hash(tileSeed() + 1u));
    vec2 turn = radius * vec2(cos(angle), sin(angle));
    return Disc(centre, first * turn.x + second * turn.y, second * turn.x - first * turn.y,
                atan(random.y, random.x) / 6.28318531 + 0.5);
}

// Taps are even over the disc's area: rings of equal area, one golden angle apart.
vec2 discUv(Disc disc, int i, int count) {
    vec2 point = points[i].xy * sqrt((float(i) + disc.shift) / float(count));
    return uvFromView(disc.centre + disc.across * point.x + disc.up * point.y);
}

bool isOutside(vec2 uv) {
    return any(lessThan(uv, vec2(0.0))) || any(greaterThanEqual(uv, vec2(1.0)));
}
