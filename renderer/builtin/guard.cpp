#include "renderer/builtin/anatomy.h"
#include "renderer/builtin/implicit.h"
#include "renderer/builtin/people.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura::builtin {

namespace {

using glm::vec3;

constexpr std::array guardGirths{Girth{0.46F, {0.225F, 0.190F}}, Girth{0.60F, {0.212F, 0.172F}},
                                 Girth{0.98F, {0.172F, 0.132F}}, Girth{1.08F, {0.158F, 0.120F}},
                                 Girth{1.28F, {0.195F, 0.138F}}, Girth{1.42F, {0.200F, 0.115F}},
                                 Girth{1.49F, {0.150F, 0.098F}}, Girth{1.52F, {0.085F, 0.078F}}};

float tunicAt(vec3 p) {
    const float loose = 1 - glm::smoothstep(0.5F, 1.06F, p.y);
    const float depth = 0.002F + 0.048F * loose;
    float d = gown(p, guardGirths) - depth * folds(angleOf(p) + 1, p.y, 18) - 0.3F * depth;
    return cut(
        0.8F * d,
        0.45F * (gown(p + vec3(0, 0.03F, 0), guardGirths) + 0.03F + 2 * std::max(0.0F, p.y - 0.7F)),
        0.01F);
}

float legs(vec3 p) {
    const vec3 q = mirrored(p);
    float d =
        merge(limb(q, {0.095F, 0.80F, 0}, {0.112F, 0.48F, 0.015F}, 0.088F, 0.062F),
              limb(q, {0.112F, 0.48F, 0.015F}, {0.118F, 0.10F, -0.015F}, 0.060F, 0.046F), 0.03F);
    d = merge(d, ellipsoid(q - vec3(0.114F, 0.33F, -0.03F), {0.052F, 0.10F, 0.05F}), 0.03F);
    return d;
}

float boots(vec3 p) {
    const vec3 q = mirrored(p);
    const vec3 foot = turned(q - vec3(0.122F, 0, 0), 1, -14);
    float d = limb(q, {0.113F, 0.40F, -0.005F}, {0.118F, 0.08F, -0.015F}, 0.076F, 0.056F);
    d += 0.006F * (1 - std::abs(std::sin(45 * q.y + 8 * q.z)));
    d = std::max(d, q.y - 0.40F);
    d = cut(d, limb(q, {0.113F, 0.5F, -0.005F}, {0.113F, 0.3F, -0.005F}, 0.066F, 0.055F), 0.006F);
    d = merge(
        d, limb(foot * vec3(0.85F, 1, 1), {0, 0.045F, -0.03F}, {0, 0.035F, 0.15F}, 0.046F, 0.038F),
        0.04F);
    return std::min(
        d, roundedBox(foot - vec3(0.002F, 0.008F, 0.055F), {0.056F, 0.014F, 0.145F}, 0.012F));
}

float cloak(vec3 p) { // open in front, fastened on the shoulders
    const float down = glm::clamp((1.52F - p.y) / 1.45F, 0.0F, 1.0F);
    const glm::vec2 half = glm::mix(glm::vec2(0.215F, 0.135F), glm::vec2(0.36F, 0.26F), down);
    const glm::vec2 q = glm::vec2(p.x, p.z + 0.04F + 0.05F * down) / half;
    const float depth = 0.012F + 0.075F * down;
    float d = (glm::length(q) - 1) * half.y - depth * folds(angleOf(p), p.y, 13) - 0.4F * depth;
    d = 0.75F * (std::abs(d) - 0.011F);
    d = std::max({d, p.y - 1.50F + 0.3F * std::abs(p.x), 0.07F - p.y});
    const float opening = p.z - 0.03F + 0.10F * down;
    return std::max(d, 0.8F * opening);
}

float guardHair(vec3 p) {
    const vec3 q = p - vec3(0, 1.72F, 0);
    float d = ellipsoid(q - vec3(0, 0.024F, -0.012F), {0.090F, 0.106F, 0.106F});
    d = merge(d, limb(q, {0, -0.02F, -0.06F}, {0, -0.13F, -0.065F}, 0.072F, 0.065F), 0.03F);
    d = cut(d, ellipsoid(q - vec3(0, -0.050F, 0.095F), {0.064F, 0.100F, 0.100F}), 0.012F);
    const vec3 beard = q - vec3(0, -0.105F, 0.058F);
    float b = ellipsoid(beard, {0.050F, 0.060F, 0.034F});
    b = merge(b,
              limb(mirrored(q), {0.062F, -0.02F, 0.02F}, {0.036F, -0.09F, 0.055F}, 0.014F, 0.02F),
              0.02F);
    b = merge(b, limb(mirrored(q), {0, -0.043F, 0.098F}, {0.030F, -0.060F, 0.078F}, 0.007F, 0.006F),
              0.01F);
    b = cut(b, ellipsoid(q - vec3(0, -0.058F, 0.10F), {0.020F, 0.006F, 0.02F}), 0.006F);
    const float strands =
        0.0045F * std::sin(150 * q.x + 12 * std::sin(22 * q.y)) * std::sin(14 * q.y + 1);
    return std::min(d, b) + strands;
}

float circlet(vec3 p) {
    const vec3 q = turned(p - vec3(0, 1.762F, -0.008F), 0, 8);
    const float ring =
        std::max(std::abs(glm::length(glm::vec2(q.x / 0.096F, q.z / 0.108F)) - 1) * 0.09F - 0.006F,
                 std::abs(q.y) - 0.013F);
    return std::min(ring, glm::distance(q, {0, 0.004F, 0.108F}) - 0.014F);
}

float sword(vec3 p) { // point down before the feet
    const vec3 q = p - vec3(0, 0, 0.30F);
    const float width = 0.036F * glm::clamp(q.y / 0.12F, 0.05F, 1.0F) * (0.85F + 0.15F * (1 - q.y));
    float blade = std::max({std::abs(q.x) - width, std::abs(q.z) - 0.013F + 0.25F * std::abs(q.x),
                            q.y - 0.92F, -q.y + 0.01F});
    blade = cut(
        blade,
        limb(vec3(q.x, q.y, std::abs(q.z)), {0, 0.3F, 0.016F}, {0, 0.9F, 0.016F}, 0.008F, 0.008F),
        0.003F);
    float hilt = limb(mirrored(q), {0, 0.925F, 0}, {0.13F, 0.905F, 0}, 0.020F, 0.014F);
    hilt = std::min(hilt, limb(q, {0, 0.92F, 0}, {0, 1.11F, 0}, 0.015F, 0.014F) +
                              0.002F * std::sin(300 * q.y));
    return std::min({blade, hilt, glm::distance(q, {0, 1.13F, 0}) - 0.028F,
                     glm::distance(mirrored(q), {0.135F, 0.904F, 0}) - 0.019F});
}

float collar(vec3 p) { // of fur, where the cloak is fastened
    const vec3 q = turned(p - vec3(0, 1.485F, -0.015F), 0, 14);
    const float ring = (glm::length(glm::vec2(q.x / 0.155F, q.z / 0.115F)) - 1) * 0.115F;
    const float tufts = 0.006F * std::sin(90 * q.x) * std::sin(80 * q.y + 3) * std::sin(85 * q.z);
    return 0.9F * (glm::length(glm::vec2(ring, q.y)) - 0.036F + tufts);
}

float belt(vec3 p) {
    const float around = gown(p, guardGirths);
    const float strap =
        std::max(std::abs(around - 0.004F) - 0.012F, std::abs(p.y - 1.07F) - 0.028F);
    const vec3 q = p - vec3(0, 1.07F, 0.130F);
    const float buckle = std::max(roundedBox(q, {0.042F, 0.038F, 0.016F}, 0.006F),
                                  -roundedBox(q, {0.024F, 0.020F, 0.03F}, 0.004F));
    return std::min(strap, buckle);
}

float arms(vec3 p) {
    return sleeve(
        mirrored(p),
        {{0.185F, 1.41F, -0.01F}, {0.265F, 1.17F, 0.06F}, {0.10F, 1.115F, 0.235F}, 0.050F});
}

float hands(vec3 p) { // the right one above the left, round the hilt
    const float right = hand(p, {{-0.075F, 1.105F, 0.25F}, {1, 0.05F, 0.55F}, {0.3F, -0.2F, -1}});
    const float left =
        hand(p, {{0.080F, 1.050F, 0.25F}, {-1, 0.0F, 0.55F}, {-0.3F, -0.2F, -1}, true});
    return std::min(right, left);
}

float pauldrons(vec3 p) { // of two lames each
    const vec3 q = turned(mirrored(p) - vec3(0.205F, 1.425F, -0.005F), 2, -28);
    const float upper = std::max(ellipsoid(q, {0.098F, 0.072F, 0.100F}), -0.012F - q.y);
    const vec3 r = q - vec3(0.016F, -0.028F, 0);
    return std::min(upper, std::max(ellipsoid(r, {0.094F, 0.074F, 0.095F}), -0.030F - r.y));
}

constexpr vec3 blue{0.25F, 0.31F, 0.44F};

vec3 livery(vec3 p) { // a golden star on the breast
    const float star = std::sqrt(std::abs(p.x)) + std::sqrt(std::abs(p.y - 1.29F));
    return p.z > 0 && star < 0.31F ? paint::gold : bordered(blue, 0.47F)(p);
}

} // namespace

Body guard() {
    const vec3 cloakColour(0.50F, 0.15F, 0.14F);
    const vec3 head(0, 1.72F, 0.008F), brown(0.36F, 0.23F, 0.15F);
    const auto neck = [](vec3 p) {
        return limb(p, {0, 1.46F, -0.01F}, {0, 1.68F, 0}, 0.066F, 0.056F);
    };
    const auto features = [=](vec3 p) { return face((p - head) / 1.05F) * 1.05F; };
    const auto complexion = [=](vec3 p) { return faceColour((p - head) / 1.05F); };
    const auto metal = [](vec3 p) { return p.y > 0.885F ? paint::gold : paint::steel; };
    return {
        {tunicAt, {0, 1.0F, 0}, 0.66F, livery, 0.01F},
        {legs, {0, 0.45F, 0}, 0.50F, plain({0.36F, 0.33F, 0.28F}), 0.01F},
        {boots, {0, 0.2F, 0.04F}, 0.36F, plain(paint::leather), 0.004F},
        {cloak, {0, 0.80F, -0.12F}, 0.95F, bordered(cloakColour, 0.07F), 0.004F},
        {arms, {0, 1.27F, 0.08F}, 0.42F, plain(blue), 0.012F},
        {belt, {0, 1.07F, 0}, 0.24F, plain(paint::leather), 0.003F},
        {collar, {0, 1.485F, -0.01F}, 0.24F, plain({0.45F, 0.38F, 0.32F}), 0.004F, true},
        {pauldrons, {0, 1.42F, 0}, 0.34F, plain(paint::steel), 0.002F, true},
        {sword, {0, 0.57F, 0.30F}, 0.61F, metal, 0.002F, true},
        {hands, {0, 1.09F, 0.27F}, 0.22F, plain(paint::skin), 0.003F, true},
        {neck, {0, 1.6F, 0}, 0.17F, plain(paint::skin), 0.02F, true},
        {features, {0, 1.72F, 0.02F}, 0.16F, complexion, 0.012F, true},
        {guardHair, {0, 1.67F, -0.01F}, 0.24F, plain(brown), 0.004F, true},
        {circlet, {0, 1.76F, -0.01F}, 0.14F, plain(paint::gold), 0.002F, true},
    };
}

} // namespace obscura::builtin
