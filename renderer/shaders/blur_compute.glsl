// The separable cross-bilateral blur of the CS562 report (Kim 2022), down the columns, then along
// the rows. Each group of 128 pixels of a line first loads what it and its neighbours within the
// kernel's radius hold into shared memory, so that every value is fetched once per line instead of
// once per tap.
//
// Weight of pixel i for a pixel with normal N and depth d, renormalised over the kernel:
//     Gaussian(distance in pixels) x max(0, N_i . N) x exp(-(d_i - d)^2 / 2 s).
// Departures: depth is in radii, which for the report's radius of 1 is the same, so that s need not
// know the scene's size; the report names no width for the Gaussian, here half the kernel's radius;
// pixels that show no surface or lie beyond the border have no weight.

#include "blur_normal.glsl"

// Pixels; the largest blurRadius (renderer/techniques/rows/obscurance.h).
const int group = 128, widest = 32;

shared float lineDepth[group + 2 * widest];
shared uint lineNormal[group + 2 * widest];     // x and y, halves as in the normal buffer
shared uint lineVisibility[group + 2 * widest]; // and the normal's z

void load(sampler2D values, int slot, ivec2 pixel) {
    bool outside =
        any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, textureSize(values, 0)));
    lineDepth[slot] = outside ? frame.depth.y : depthOf(pixel);
    vec3 normal = outside ? vec3(0.0) : normalOf(pixel);
    float visibility = outside ? 1.0 : texelFetch(values, pixel, 0).r;
    lineNormal[slot] = packHalf2x16(normal.xy);
    lineVisibility[slot] = packHalf2x16(vec2(visibility, normal.z));
}

vec4 blurLine(sampler2D values, ivec2 pixel, ivec2 along) {
    int radius = int(settings.blurRadius), place = int(gl_LocalInvocationIndex);
    // Slot 0 is the pixel `radius` before the group's first. Invocations beyond the border load
    // too, because pixels inside the border need what they load.
    for (int slot = place; slot < group + 2 * radius; slot += group)
        load(values, slot, pixel + along * (slot - place - radius));
    barrier();

    int centre = place + radius;
    float depth = lineDepth[centre];
    if (isEmpty(depth))
        return vec4(1.0);
    vec2 own = unpackHalf2x16(lineVisibility[centre]); // visibility, the normal's z
    vec3 normal = vec3(unpackHalf2x16(lineNormal[centre]), own.y);
    float narrowness = -0.5 / (settings.depthVariance * settings.radius * settings.radius);
    float sum = 0.0, weights = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        float other = lineDepth[centre + i];
        if (isEmpty(other))
            continue;
        vec2 value = unpackHalf2x16(lineVisibility[centre + i]);
        float apart = other - depth, steps = 2.0 * float(i) / float(radius);
        float facing = dot(vec3(unpackHalf2x16(lineNormal[centre + i]), value.y), normal);
        float weight = exp(-0.5 * steps * steps + apart * apart * narrowness) * max(facing, 0.0);
        sum += weight * value.x;
        weights += weight;
    }
    return vec4(weights > 0.0 ? sum / weights : own.x);
}

vec4 blurColumns(ivec2 pixel) { return blurLine(gatherResult, pixel, ivec2(0, 1)); }

vec4 blurRows(ivec2 pixel) { return blurLine(blurColumnsResult, pixel, ivec2(1, 0)); }
