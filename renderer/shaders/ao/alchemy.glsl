// Alchemy ambient obscurance (McGuire, Osman, Bukowski and Hennessy 2011), the form that shipped:
//     A = max(0, 1 - 2 sigma / s  sum max(0, v . n + z beta) / (v . v + epsilon))^k
// over s surface points seen at taps spread evenly over a disc of world radius R that faces the
// camera. Sigma is the common `intensity` and k the common `power`. Each term is 1 / length: here
// v is in radii, hence sigma too.
//
// Departures: the taps are Vogel's spiral (r^2 and angle in equal steps), turned per pixel; taps
// that see no surface occlude nothing; `insideSphere` adds form 1's H(R - |v|), which this form
// dropped; contrast is applied after the filter. (The Leeds thesis adds z beta to each component of
// n instead of to v . n, which is another method.)
//
// Limit: with h the height, above the pixel's plane, of what is seen at a place of the disc,
// A = 1 - 2 sigma (mean over the disc of h / (r^2 + h^2)). At distance d from a step of height h,
// seen from above, A = 1 - (4 sigma / pi) times the integral over r from d to 1 of
// arccos(d / r) h r / (r^2 + h^2). It is not bounded: sigma decides where it clamps to black.

#include "blur_normal.glsl"
#include "obscurance.glsl"
#include "spiral.glsl"

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalOf(pixel);
    float turn = pixelTurn(pixel);
    float bias = settings.bias * depth / settings.radius; // -z beta: grows as depth's rounding does
    float reach = settings.insideSphere > 0.0 ? 1.0 : 1e30;

    int count = int(settings.samples);
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 v = towardsSurface(position, discOffset(i, count, turn));
        float square = dot(v, v);
        if (square <= reach)
            sum += max(dot(v, normal) - bias, 0.0) / (square + settings.epsilon);
    }
    return visibilityOf(2.0 * sum / float(count));
}
