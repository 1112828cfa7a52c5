#include "renderer/builtin/anatomy.h"

#include "renderer/builtin/implicit.h"

#include <algorithm>
#include <cmath>

namespace obscura::builtin {

float face(glm::vec3 p) {
    const glm::vec3 q(std::abs(p.x), p.y, p.z);
    float d = ellipsoid(p - glm::vec3(0, 0.020F, -0.008F), {0.074F, 0.092F, 0.090F}); // skull
    d = merge(d, ellipsoid(p - glm::vec3(0, -0.040F, 0.022F), {0.054F, 0.068F, 0.060F}), 0.03F);
    d = withLimbs(d, q,
                  {{{0, -0.098F, 0.058F}, {0, -0.092F, 0.064F}, 0.017F, 0.014F, 0.03F},
                   {{0.008F, 0.026F, 0.084F}, {0.046F, 0.028F, 0.064F}, 0.010F, 0.008F, 0.016F}});
    d = cut(d, ellipsoid(q - glm::vec3(0.030F, 0.006F, 0.086F), {0.019F, 0.013F, 0.016F}), 0.014F);
    d = withLimbs(d, q,
                  {{{0.045F, -0.022F, 0.052F}, {0.050F, -0.018F, 0.030F}, 0.014F, 0.012F, 0.02F},
                   {{0, 0.020F, 0.084F}, {0, -0.024F, 0.103F}, 0.008F, 0.012F, 0.012F}, // nose
                   {{0, -0.029F, 0.094F}, {0.012F, -0.029F, 0.086F}, 0.008F, 0.008F, 0.008F}});
    d = cut(d, limb(q, {0, -0.056F, 0.092F}, {0.022F, -0.058F, 0.080F}, 0.004F, 0.002F), 0.008F);
    d = withLimbs(d, q,
                  {{{0, -0.050F, 0.083F}, {0.018F, -0.054F, 0.075F}, 0.006F, 0.003F, 0.006F},
                   {{0, -0.065F, 0.080F}, {0.014F, -0.063F, 0.075F}, 0.008F, 0.004F, 0.008F},
                   {{0.030F, 0.005F, 0.066F}, {0.030F, 0.006F, 0.066F}, 0.0135F, 0.0135F, 0.004F}});
    return merge(d, ellipsoid(q - glm::vec3(0.076F, 0, -0.006F), {0.011F, 0.027F, 0.017F}), 0.008F);
}

namespace {

// Wrist at the origin, fingers along y and curling towards z; a right one.
float rightHand(glm::vec3 p) {
    float d = limb(p * glm::vec3(1, 1, 1.5F), {0, -0.06F, 0}, {0, 0.01F, 0}, 0.030F, 0.026F);
    d = merge(d, ellipsoid(p - glm::vec3(0, 0.045F, 0), {0.040F, 0.046F, 0.017F}), 0.02F);
    for (int i = 0; i < 4; ++i) {
        const float x = 0.019F * (part(i, 1) - 1.5F), reach = i == 3 || i == 0 ? 0.85F : 1.0F;
        const glm::vec3 knuckle(x, 0.080F, 0.004F),
            middle(1.15F * x, 0.080F + 0.035F * reach, 0.018F);
        const glm::vec3 tip = middle + reach * glm::vec3(0, 0.012F, 0.036F);
        d = withLimbs(
            d, p,
            {{knuckle, middle, 0.0105F, 0.0095F, 0.006F}, {middle, tip, 0.0095F, 0.007F, 0.003F}});
    }
    return withLimbs(
        d, p, {{{-0.030F, 0.03F, 0.004F}, {-0.050F, 0.062F, 0.034F}, 0.014F, 0.009F, 0.012F}});
}

} // namespace

float hand(glm::vec3 p, const HandPose& pose) {
    const glm::vec3 y = glm::normalize(pose.point);
    const glm::vec3 x = glm::normalize(glm::cross(y, pose.palm));
    glm::vec3 q = glm::transpose(glm::mat3(x, y, glm::cross(x, y))) * (p - pose.wrist);
    q.x = pose.left ? -q.x : q.x;
    return rightHand(q);
}

float sleeve(glm::vec3 p, const Sleeve& arm) {
    const glm::vec3 along = glm::normalize(arm.wrist - arm.elbow);
    float d = merge(limb(p, arm.shoulder, arm.elbow, 0.072F, 0.062F),
                    limb(p, arm.elbow, arm.wrist, 0.062F, arm.mouth), 0.05F);
    const glm::vec3 bend = glm::normalize(arm.wrist - arm.shoulder);
    const float wrinkle = std::sin(70 * glm::dot(p - arm.elbow, bend) + 3 * std::sin(25 * p.x));
    d += 0.006F * (1 - std::sqrt(std::abs(wrinkle)));
    d = std::max(d, glm::dot(p - arm.wrist, along));
    const glm::vec3 inside = glm::mix(arm.elbow, arm.wrist, 0.3F);
    return cut(d, limb(p, inside, arm.wrist + 0.1F * along, 0.03F, arm.mouth - 0.012F), 0.006F);
}

float gown(glm::vec3 p, std::span<const Girth> girths) {
    std::size_t i = 0;
    while (i + 2 < girths.size() && p.y > girths[i + 1].height)
        ++i;
    const Girth &a = girths[i], &b = girths[i + 1];
    const glm::vec2 half = glm::mix(
        a.half, b.half, glm::smoothstep(0.0F, 1.0F, (p.y - a.height) / (b.height - a.height)));
    const float around = (glm::length(glm::vec2(p.x, p.z) / half) - 1) * std::min(half.x, half.y);
    const float above = p.y - girths.back().height, below = girths.front().height - p.y;
    // 0.8: the sides slope.
    return std::max({0.8F * around, above, below});
}

float folds(float angle, float height, float count) {
    const float drift = 1.3F * std::sin(2 * angle + 0.7F) + 0.5F * std::sin(3.5F * height + angle);
    const float wave = std::sin(0.5F * (count * angle + drift));
    const float broad = std::sqrt(wave * wave + 0.015F); // valleys that a mesh can follow
    const float narrow = std::abs(std::sin(count * angle + 2.5F * drift + 2 * height));
    return -0.75F * (1 - std::sqrt(std::min(1.0F, broad))) - 0.25F * (1 - narrow);
}

glm::vec3 faceColour(glm::vec3 p) {
    const glm::vec3 q = mirrored(p);
    const float fromEye = p.z > 0.05F ? glm::distance(q, {0.030F, 0.004F, 0.079F}) : 1.0F;
    if (fromEye < 0.0085F && q.y < 0.0085F) // the lid covers the rest
        return fromEye < 0.0045F ? glm::vec3(0.15F, 0.11F, 0.10F) : glm::vec3(0.90F, 0.87F, 0.82F);
    if (p.z > 0.06F && glm::length(glm::vec2(q.x / 2.2F, q.y + 0.058F)) < 0.0095F)
        return {0.68F, 0.38F, 0.33F};
    const float brow = q.y - 0.035F + 9 * (q.x - 0.028F) * (q.x - 0.028F);
    if (p.z > 0.04F && std::abs(brow) < 0.0028F && q.x > 0.010F && q.x < 0.052F)
        return {0.30F, 0.20F, 0.15F};
    return paint::skin;
}

std::function<glm::vec3(glm::vec3)> plain(glm::vec3 colour) {
    return [colour](glm::vec3) { return colour; };
}

std::function<glm::vec3(glm::vec3)> bordered(glm::vec3 colour, float hem) {
    return [=](glm::vec3 p) {
        const float above = p.y - hem;
        const bool key = std::sin(28 * angleOf(p)) * std::sin(160 * above) > 0;
        if (above < 0.05F && above > 0.006F)
            return key ? paint::gold : 0.7F * paint::gold;
        return above > 0.062F && above < 0.072F ? paint::gold : colour;
    };
}

} // namespace obscura::builtin
