#include "renderer/builtin/anatomy.h"
#include "renderer/builtin/implicit.h"
#include "renderer/builtin/people.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura::builtin {

namespace {

using glm::vec3;

constexpr std::array readerGirths{Girth{0.00F, {0.285F, 0.265F}}, Girth{0.12F, {0.255F, 0.235F}},
                                  Girth{0.50F, {0.205F, 0.180F}}, Girth{0.92F, {0.178F, 0.142F}},
                                  Girth{1.10F, {0.128F, 0.105F}}, Girth{1.28F, {0.158F, 0.122F}},
                                  Girth{1.38F, {0.172F, 0.106F}}, Girth{1.44F, {0.135F, 0.085F}},
                                  Girth{1.475F, {0.060F, 0.060F}}};

float dress(vec3 p) {
    const float loose = 1 - glm::smoothstep(0.1F, 1.05F, p.y);
    const float depth = 0.003F + 0.055F * loose;
    const float girdle = 0.012F * std::exp(-900 * (p.y - 1.10F) * (p.y - 1.10F));
    return 0.8F * (gown(p, readerGirths) - depth * folds(angleOf(p), p.y, 15) + girdle) -
           0.3F * depth;
}

// A mantle laid over the left shoulder and drawn across to the right hip, folds along its edge.
float mantle(vec3 p) {
    const float slant = p.y - 0.98F - 1.25F * p.x - 0.25F * p.z; // above the lower edge
    const float warp = 2.2F * std::sin(5 * p.x + 3 * p.y) + 1.2F * std::sin(11 * p.x - 7 * p.z);
    const float lines = std::abs(std::sin(24 * slant + warp));
    const float depth = 0.020F + 0.008F * std::sin(7 * p.y + 4 * p.x);
    float d = gown(p, readerGirths) - 0.026F - depth * std::sqrt(lines + 0.05F);
    d = std::max(d, 0.6F * (-0.34F - slant));
    d = std::max(d, 0.6F * (slant - 0.34F));
    return 0.8F * std::max(d, p.y - 1.46F);
}

float veil(vec3 p) { // a hood that falls on the shoulders
    const vec3 q = p - vec3(0, 1.635F, 0);
    float d = ellipsoid(q - vec3(0, 0.012F, -0.020F), {0.110F, 0.130F, 0.130F});
    d = merge(d, limb(q, {0, -0.02F, -0.06F}, {0, -0.30F, -0.075F}, 0.09F, 0.14F), 0.06F);
    const float wave = std::abs(std::sin(9 * std::atan2(q.x, -q.z - 0.02F)));
    d += 0.010F * (1 - std::sqrt(wave)) * glm::smoothstep(0.04F, -0.1F, q.y);
    d = cut(d, ellipsoid(q - vec3(0, -0.035F, 0.075F), {0.074F, 0.108F, 0.125F}), 0.012F);
    return cut(d, limb(q, {0, -0.02F, 0.0F}, {0, -0.30F, 0.06F}, 0.07F, 0.10F), 0.02F);
}

float readerHair(vec3 p) {
    const vec3 q = p - vec3(0, 1.635F, 0);
    const float d = ellipsoid(q - vec3(0, 0.018F, -0.005F), {0.088F, 0.107F, 0.105F}) +
                    0.003F * std::sin(130 * q.x + 30 * q.y * q.x);
    return cut(d, ellipsoid(q - vec3(0, -0.045F, 0.075F), {0.060F, 0.098F, 0.125F}), 0.01F);
}

vec3 inBook(vec3 p) { // one of the two leaves: x from the spine, y up from the page
    const vec3 q = turned(p - vec3(0, 1.165F, 0.285F), 0, 38);
    return turned(mirrored(q), 2, -14);
}
float cover(vec3 p) {
    return roundedBox(inBook(p) - vec3(0.086F, -0.016F, 0), {0.094F, 0.009F, 0.130F}, 0.004F);
}
float pages(vec3 p) {
    const vec3 q = inBook(p);
    const float swell = 0.008F * std::sin(18 * std::min(q.x, 0.16F));
    return roundedBox(q - vec3(0.082F, 0.004F + swell, 0), {0.082F, 0.014F, 0.118F}, 0.004F);
}
vec3 script(vec3 p) {
    const vec3 q = inBook(p);
    const bool line = std::sin(320 * q.z) > 0.1F && std::sin(900 * q.x + 40 * q.z) > -0.8F;
    const bool block = q.x > 0.025F && q.x < 0.145F && std::abs(q.z) < 0.095F && q.y > 0.004F;
    return block && line ? vec3(0.42F, 0.34F, 0.28F) : vec3(0.90F, 0.85F, 0.72F);
}

} // namespace

Body reader() {
    const vec3 gownColour(0.42F, 0.50F, 0.44F), mantleColour(0.58F, 0.24F, 0.20F);
    const auto arms = [](vec3 p) {
        return sleeve(
            mirrored(p),
            {{0.155F, 1.375F, -0.01F}, {0.225F, 1.12F, 0.03F}, {0.135F, 1.10F, 0.20F}, 0.068F});
    };
    const auto hands = [](vec3 p) {
        return hand(mirrored(p), {{0.125F, 1.095F, 0.20F}, {-0.35F, 0.15F, 1}, {-0.35F, 1, 0.1F}});
    };
    const auto neck = [](vec3 p) {
        return limb(p, {0, 1.42F, -0.012F}, {0, 1.60F, 0}, 0.060F, 0.050F);
    };
    const auto inFace = [](vec3 p) { return turned(p - vec3(0, 1.635F, 0.012F), 0, -10); };
    const auto features = [=](vec3 p) { return face(inFace(p)); };
    const auto complexion = [=](vec3 p) { return faceColour(inFace(p)); };
    return {
        {dress, {0, 0.75F, 0}, 0.86F, bordered(gownColour, 0), 0.01F},
        {mantle, {0, 1.05F, 0}, 0.55F, plain(mantleColour), 0.006F},
        {arms, {0, 1.22F, 0.08F}, 0.38F, plain(gownColour), 0.012F},
        {hands, {0, 1.12F, 0.27F}, 0.26F, plain(paint::skin), 0.004F, true},
        {cover, {0, 1.17F, 0.285F}, 0.24F, plain({0.45F, 0.13F, 0.12F}), 0.002F, true},
        {pages, {0, 1.17F, 0.285F}, 0.23F, script, 0.001F, true},
        {neck, {0, 1.5F, 0}, 0.16F, plain(paint::skin), 0.02F, true},
        {features, {0, 1.63F, 0.02F}, 0.15F, complexion, 0.012F, true},
        {readerHair, {0, 1.65F, -0.01F}, 0.12F, plain({0.28F, 0.18F, 0.12F}), 0.004F, true},
        {veil, {0, 1.53F, -0.04F}, 0.33F, plain(paint::linen), 0.004F, true},
    };
}

} // namespace obscura::builtin
