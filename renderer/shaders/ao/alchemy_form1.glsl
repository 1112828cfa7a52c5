// Alchemy ambient obscurance (McGuire, Osman, Bukowski and Hennessy 2011), its first form, whose
// falloff g(t) = u t / max(u, t)^2 cancels the distance in the integral's area sample:
//     A = 1 - 2 pi u / s  sum max(0, v . n - bias) H(R - |v|) / max(u^2, v . v).
// Taps, units and departures as in alchemy.glsl. u is in radii, and u / length makes this form free
// of units by itself. The bias, which this form lacks in the paper, is that of the shipping form.
//
// Limit at distance d from a step of height h, seen from above: A = 1 - 4 u times the integral over
// r from d to sqrt(1 - h^2) of arccos(d / r) h r / max(u^2, r^2 + h^2).

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
    float bias = settings.bias * depth / settings.radius;

    int count = int(settings.samples);
    float sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += formOneTerm(towardsSurface(position, discOffset(i, count, turn)), normal, bias,
                           settings.falloffStart);
    return visibilityOf(6.28318531 * settings.falloffStart * sum / float(count));
}
