// What the obscurance estimators of Alchemy and its successors share. Lengths are in radii, so that
// sums that the papers give in 1 / metres do not depend on the scene's size.

#include "depth.glsl"

// From `position` to the surface seen at `offset` on the disc of one radius around it that faces
// the camera. It is the surface of the nearest pixel, at that pixel's centre: with the tap's own
// place its depth would be off by the slope, and planes would shade themselves. Beyond the screen's
// border that is the border's pixel. Zero, which occludes nothing, where no surface is seen.
vec3 towardsSurface(vec3 position, vec2 offset) {
    ivec2 pixel = pixelOf(uvFromView(position + vec3(offset * settings.radius, 0.0)));
    float depth = depthOf(pixel);
    return isEmpty(depth) ? vec3(0.0)
                          : (viewPosition(uvOf(pixel), depth) - position) / settings.radius;
}

// Form 1's term (Alchemy, with the falloff u t / max(u, t)^2), before its factor 2 pi u.
float formOneTerm(vec3 v, vec3 normal, float bias, float u) {
    float square = dot(v, v);
    return square > 1.0 ? 0.0 : max(dot(v, normal) - bias, 0.0) / max(u * u, square);
}

// The papers limit each pixel to max(0, 1 - sigma S) before they filter. Sigma is applied after our
// last pass, so this is the value that it maps to 0. With a power below 0 nothing is; then the limit
// is that of the renderings which such a power is fitted on (matching/match.cpp).
vec4 visibilityOf(float obscurance) {
    float sigma = settings.power < 0.0 ? 0.125 : settings.intensity;
    return vec4(1.0 - min(obscurance, 1.0 / max(sigma, 1e-3)));
}
