#include "renderer/builtin_figure.h"
#include "renderer/builtin_masonry.h"
#include "renderer/builtin_scenes.h"
#include "renderer/builtin_textures.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace obscura::builtin {

namespace {

using glm::vec3;

constexpr vec3 skin{0.80F, 0.60F, 0.48F}, linen{0.86F, 0.80F, 0.68F}, gold{0.80F, 0.60F, 0.24F};
constexpr vec3 leather{0.40F, 0.26F, 0.17F}, steel{0.62F, 0.65F, 0.68F};

std::function<vec3(vec3)> plain(vec3 colour) {
    return [colour](vec3) { return colour; };
}

float angleOf(vec3 p) { return std::atan2(p.x, p.z); }

// Cloth with a golden border at `hem`, 4 cm wide, and a thin line above it.
std::function<vec3(vec3)> bordered(vec3 colour, float hem) {
    return [=](vec3 p) {
        const float above = p.y - hem;
        const bool key = std::sin(28 * angleOf(p)) * std::sin(160 * above) > 0;
        if (above < 0.05F && above > 0.006F)
            return key ? gold : 0.7F * gold;
        return above > 0.062F && above < 0.072F ? gold : colour;
    };
}

vec3 painted(vec3 p) { // a face at the origin: lips, brows, eyes
    const vec3 q(std::abs(p.x), p.y, p.z);
    if (p.z > 0.05F && glm::distance(q, {0.030F, 0.005F, 0.079F}) < 0.0045F)
        return {0.15F, 0.11F, 0.10F};
    if (p.z > 0.05F && glm::distance(q, {0.030F, 0.005F, 0.079F}) < 0.0085F)
        return {0.90F, 0.87F, 0.82F};
    if (p.z > 0.06F && glm::length(glm::vec2(q.x / 2.2F, q.y + 0.058F)) < 0.0095F)
        return {0.68F, 0.38F, 0.33F};
    if (p.z > 0.04F && std::abs(q.y - 0.035F + 9 * (q.x - 0.028F) * (q.x - 0.028F)) < 0.0028F &&
        q.x > 0.010F && q.x < 0.052F)
        return {0.30F, 0.20F, 0.15F};
    return skin;
}

// A sleeve from shoulder to wrist, wide and hollow at the end.
float sleeve(vec3 p, vec3 shoulder, vec3 elbow, vec3 wrist, float mouth) {
    float d = merge(limb(p, shoulder, elbow, 0.072F, 0.062F), limb(p, elbow, wrist, 0.062F, mouth),
                    0.05F);
    const float wrinkle = std::sin(70 * glm::dot(p - elbow, glm::normalize(wrist - shoulder)) +
                                   3 * std::sin(25 * p.x));
    d += 0.006F * (1 - std::sqrt(std::abs(wrinkle)));
    const vec3 along = glm::normalize(wrist - elbow);
    const float end = glm::dot(p - wrist, along);
    d = std::max(d, end);
    return cut(d,
               limb(p, elbow + 0.3F * (wrist - elbow), wrist + 0.1F * along, 0.03F, mouth - 0.012F),
               0.006F);
}

// The hand at `wrist`, fingers towards `point`, the palm facing `palm`.
float handAt(vec3 p, vec3 wrist, vec3 point, vec3 palm, bool left) {
    const vec3 y = glm::normalize(point), x = glm::normalize(glm::cross(y, palm));
    vec3 q = glm::transpose(glm::mat3(x, y, glm::cross(x, y))) * (p - wrist);
    q.x = left ? -q.x : q.x;
    return hand(q);
}

// The reader -------------------------------------------------------------------------------

const std::vector<Girth> readersGown{
    {0.00F, {0.285F, 0.265F}}, {0.12F, {0.255F, 0.235F}}, {0.50F, {0.205F, 0.180F}},
    {0.92F, {0.178F, 0.142F}}, {1.10F, {0.128F, 0.105F}}, {1.28F, {0.158F, 0.122F}},
    {1.38F, {0.172F, 0.106F}}, {1.44F, {0.135F, 0.085F}}, {1.475F, {0.060F, 0.060F}}};

float readersDress(vec3 p) {
    const float loose = 1 - glm::smoothstep(0.1F, 1.05F, p.y);
    const float depth = 0.003F + 0.055F * loose;
    const float girdle = 0.012F * std::exp(-900 * (p.y - 1.10F) * (p.y - 1.10F));
    return 0.8F * (gown(p, readersGown) - depth * folds(angleOf(p), p.y, 15) + girdle) -
           0.3F * depth;
}

// A mantle laid over the left shoulder and drawn across to the right hip, folds along its edge.
float readersMantle(vec3 p) {
    const float slant = p.y - 0.98F - 1.25F * p.x - 0.25F * p.z; // above the lower edge
    const float warp = 2.2F * std::sin(5 * p.x + 3 * p.y) + 1.2F * std::sin(11 * p.x - 7 * p.z);
    const float lines = std::abs(std::sin(24 * slant + warp));
    const float depth = 0.020F + 0.008F * std::sin(7 * p.y + 4 * p.x);
    float d = gown(p, readersGown) - 0.026F - depth * std::sqrt(lines + 0.05F);
    d = std::max(d, 0.6F * (-0.34F - slant));
    d = std::max(d, 0.6F * (slant - 0.34F));
    return 0.8F * std::max(d, p.y - 1.46F);
}

float readersVeil(vec3 p) { // a hood that falls on the shoulders
    const vec3 q = p - vec3(0, 1.635F, 0);
    float d = ellipsoid(q - vec3(0, 0.012F, -0.020F), {0.110F, 0.130F, 0.130F});
    d = merge(d, limb(q, {0, -0.02F, -0.06F}, {0, -0.30F, -0.075F}, 0.09F, 0.14F), 0.06F);
    const float wave = std::abs(std::sin(9 * std::atan2(q.x, -q.z - 0.02F)));
    d += 0.010F * (1 - std::sqrt(wave)) * glm::smoothstep(0.04F, -0.1F, q.y);
    d = cut(d, ellipsoid(q - vec3(0, -0.035F, 0.075F), {0.074F, 0.108F, 0.125F}), 0.012F);
    return cut(d, limb(q, {0, -0.02F, 0.0F}, {0, -0.30F, 0.06F}, 0.07F, 0.10F), 0.02F);
}

float readersHair(vec3 p) {
    const vec3 q = p - vec3(0, 1.635F, 0);
    const float d = ellipsoid(q - vec3(0, 0.018F, -0.010F), {0.088F, 0.107F, 0.105F}) +
                    0.003F * std::sin(130 * q.x + 30 * q.y * q.x);
    return cut(d, ellipsoid(q - vec3(0, -0.045F, 0.075F), {0.060F, 0.098F, 0.125F}), 0.01F);
}

vec3 inBook(vec3 p) { // one of the two leaves: x from the spine, y up from the page
    const vec3 q = turned(p - vec3(0, 1.165F, 0.285F), 0, 38);
    return turned(vec3(std::abs(q.x), q.y, q.z), 2, -14);
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

Body reader() {
    const vec3 dress(0.42F, 0.50F, 0.44F), mantle(0.58F, 0.24F, 0.20F);
    const auto arm = [](vec3 p) {
        const vec3 q(std::abs(p.x), p.y, p.z);
        return sleeve(q, {0.155F, 1.375F, -0.01F}, {0.225F, 1.12F, 0.03F}, {0.135F, 1.10F, 0.20F},
                      0.068F);
    };
    const auto hands = [](vec3 p) {
        return handAt({std::abs(p.x), p.y, p.z}, {0.125F, 1.095F, 0.20F}, {-0.35F, 0.15F, 1},
                      {-0.35F, 1, 0.1F}, false);
    };
    const auto neck = [](vec3 p) {
        return limb(p, {0, 1.42F, -0.012F}, {0, 1.60F, 0}, 0.060F, 0.050F);
    };
    const auto atFace = [](vec3 p) { return turned(p - vec3(0, 1.635F, 0.012F), 0, -10); };
    return {
        {readersDress, {0, 0.75F, 0}, 0.86F, bordered(dress, 0), 0.01F},
        {readersMantle, {0, 1.05F, 0}, 0.55F, plain(mantle), 0.006F},
        {arm, {0, 1.22F, 0.08F}, 0.38F, plain(dress), 0.012F},
        {hands, {0, 1.12F, 0.27F}, 0.26F, plain(skin), 0.004F, true},
        {cover, {0, 1.17F, 0.285F}, 0.24F, plain({0.45F, 0.13F, 0.12F}), 0.002F, true},
        {pages, {0, 1.17F, 0.285F}, 0.23F, script, 0.001F, true},
        {neck, {0, 1.5F, 0}, 0.16F, plain(skin), 0.02F, true},
        {[=](vec3 p) { return face(atFace(p)); },
         {0, 1.63F, 0.02F},
         0.15F,
         [=](vec3 p) { return painted(atFace(p)); },
         0.012F,
         true},
        {readersHair, {0, 1.65F, -0.01F}, 0.12F, plain({0.28F, 0.18F, 0.12F}), 0.004F, true},
        {readersVeil, {0, 1.53F, -0.04F}, 0.33F, plain(linen), 0.004F, true},
    };
}

// The guard --------------------------------------------------------------------------------

const std::vector<Girth> guardsTunic{{0.46F, {0.225F, 0.190F}}, {0.60F, {0.212F, 0.172F}},
                                     {0.98F, {0.172F, 0.132F}}, {1.08F, {0.160F, 0.122F}},
                                     {1.30F, {0.200F, 0.140F}}, {1.46F, {0.200F, 0.110F}},
                                     {1.54F, {0.095F, 0.080F}}, {1.62F, {0.055F, 0.055F}}};

float guardsTunicAt(vec3 p) {
    const float loose = 1 - glm::smoothstep(0.5F, 1.06F, p.y);
    const float depth = 0.002F + 0.048F * loose;
    float d = gown(p, guardsTunic) - depth * folds(angleOf(p) + 1, p.y, 18) - 0.3F * depth;
    return cut(0.8F * d,
               gown(p - vec3(0, -0.03F, 0), guardsTunic) + 0.03F + 2 * std::max(0.0F, p.y - 0.7F),
               0.01F);
}

float guardsLegs(vec3 p) {
    const vec3 q(std::abs(p.x), p.y, p.z);
    float d =
        merge(limb(q, {0.095F, 0.80F, 0}, {0.112F, 0.48F, 0.015F}, 0.088F, 0.062F),
              limb(q, {0.112F, 0.48F, 0.015F}, {0.118F, 0.10F, -0.015F}, 0.060F, 0.046F), 0.03F);
    d = merge(d, ellipsoid(q - vec3(0.114F, 0.33F, -0.03F), {0.052F, 0.10F, 0.05F}), 0.03F);
    return d;
}

float guardsBoots(vec3 p) {
    const vec3 q(std::abs(p.x), p.y, p.z);
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

float guardsCloak(vec3 p) { // open in front, fastened on the shoulders
    const float down = glm::clamp((1.52F - p.y) / 1.45F, 0.0F, 1.0F);
    const glm::vec2 half = glm::mix(glm::vec2(0.215F, 0.135F), glm::vec2(0.36F, 0.26F), down);
    const glm::vec2 q = glm::vec2(p.x, p.z + 0.04F + 0.05F * down) / half;
    const float depth = 0.012F + 0.075F * down;
    float d = (glm::length(q) - 1) * half.y - depth * folds(angleOf(p), p.y, 13) - 0.4F * depth;
    d = 0.75F * (std::abs(d) - 0.011F);
    d = std::max({d, p.y - 1.50F + 0.3F * std::abs(p.x), 0.07F - p.y});
    const float opening = p.z - 0.03F + 0.10F * down;
    return std::max(d, 0.8F * (opening));
}

float guardsHair(vec3 p) {
    const vec3 q = p - vec3(0, 1.72F, 0);
    float d = ellipsoid(q - vec3(0, 0.024F, -0.012F), {0.090F, 0.106F, 0.106F});
    d = merge(d, limb(q, {0, -0.02F, -0.06F}, {0, -0.13F, -0.065F}, 0.072F, 0.065F), 0.03F);
    d = cut(d, ellipsoid(q - vec3(0, -0.050F, 0.095F), {0.064F, 0.100F, 0.100F}), 0.012F);
    const vec3 beard = q - vec3(0, -0.105F, 0.058F);
    float b = ellipsoid(beard, {0.050F, 0.060F, 0.034F});
    b = merge(b,
              limb(vec3(std::abs(q.x), q.y, q.z), {0.062F, -0.02F, 0.02F}, {0.036F, -0.09F, 0.055F},
                   0.014F, 0.02F),
              0.02F);
    b = merge(b,
              limb(vec3(std::abs(q.x), q.y, q.z), {0, -0.043F, 0.098F}, {0.030F, -0.060F, 0.078F},
                   0.007F, 0.006F),
              0.01F);
    b = cut(b, ellipsoid(q - vec3(0, -0.058F, 0.10F), {0.020F, 0.006F, 0.02F}), 0.006F);
    const float strands =
        0.0045F * std::sin(150 * q.x + 12 * std::sin(22 * q.y)) * std::sin(14 * q.y + 1);
    return std::min(d, b) + strands;
}

float guardsCirclet(vec3 p) {
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
    float hilt =
        limb(vec3(std::abs(q.x), q.y, q.z), {0, 0.925F, 0}, {0.13F, 0.905F, 0}, 0.020F, 0.014F);
    hilt = std::min(hilt, limb(q, {0, 0.92F, 0}, {0, 1.11F, 0}, 0.015F, 0.014F) +
                              0.002F * std::sin(300 * q.y));
    return std::min({blade, hilt, glm::distance(q, {0, 1.13F, 0}) - 0.028F,
                     glm::distance(vec3(std::abs(q.x), q.y, q.z), {0.135F, 0.904F, 0}) - 0.019F});
}

float collar(vec3 p) { // of fur, where the cloak is fastened
    const vec3 q = turned(p - vec3(0, 1.495F, -0.015F), 0, 14);
    const float ring = (glm::length(glm::vec2(q.x / 0.155F, q.z / 0.115F)) - 1) * 0.115F;
    const float tufts = 0.006F * std::sin(90 * q.x) * std::sin(80 * q.y + 3) * std::sin(85 * q.z);
    return 0.9F * (glm::length(glm::vec2(ring, q.y)) - 0.036F + tufts);
}

float belt(vec3 p) {
    const float around = gown(p, guardsTunic);
    const float strap =
        std::max(std::abs(around - 0.004F) - 0.012F, std::abs(p.y - 1.07F) - 0.028F);
    const vec3 q = p - vec3(0, 1.07F, 0.130F);
    const float buckle = std::max(roundedBox(q, {0.042F, 0.038F, 0.016F}, 0.006F),
                                  -roundedBox(q, {0.024F, 0.020F, 0.03F}, 0.004F));
    return std::min(strap, buckle);
}

Body guard() {
    const vec3 tunic(0.25F, 0.31F, 0.44F), cloak(0.50F, 0.15F, 0.14F), hair(0.36F, 0.23F, 0.15F);
    const auto arm = [](vec3 p) {
        const vec3 q(std::abs(p.x), p.y, p.z);
        return sleeve(q, {0.185F, 1.43F, -0.01F}, {0.265F, 1.18F, 0.06F}, {0.10F, 1.115F, 0.235F},
                      0.050F);
    };
    const auto hands = [](vec3 p) {
        const float right =
            handAt(p, {-0.075F, 1.105F, 0.25F}, {1, 0.05F, 0.55F}, {0.3F, -0.2F, -1}, false);
        const float left =
            handAt(p, {0.080F, 1.050F, 0.25F}, {-1, 0.0F, 0.55F}, {-0.3F, -0.2F, -1}, true);
        return std::min(right, left);
    };
    const auto pauldron = [](vec3 p) { // two lames
        const vec3 q =
            turned(vec3(std::abs(p.x), p.y, p.z) - vec3(0.205F, 1.435F, -0.005F), 2, -28);
        const float upper = std::max(ellipsoid(q, {0.098F, 0.072F, 0.100F}), -0.012F - q.y);
        const vec3 r = q - vec3(0.016F, -0.028F, 0);
        return std::min(upper, std::max(ellipsoid(r, {0.094F, 0.074F, 0.095F}), -0.030F - r.y));
    };
    const auto neck = [](vec3 p) {
        return limb(p, {0, 1.48F, -0.01F}, {0, 1.68F, 0}, 0.066F, 0.056F);
    };
    const vec3 head(0, 1.72F, 0.008F);
    return {
        {guardsTunicAt, {0, 1.0F, 0}, 0.66F, bordered(tunic, 0.47F), 0.01F},
        {guardsLegs, {0, 0.45F, 0}, 0.50F, plain({0.36F, 0.33F, 0.28F}), 0.01F},
        {guardsBoots, {0, 0.2F, 0.04F}, 0.36F, plain(leather), 0.004F},
        {guardsCloak, {0, 0.80F, -0.12F}, 0.95F, bordered(cloak, 0.07F), 0.004F},
        {arm, {0, 1.27F, 0.08F}, 0.42F, plain(tunic), 0.012F},
        {belt, {0, 1.07F, 0}, 0.24F, plain(leather), 0.003F},
        {collar, {0, 1.495F, -0.01F}, 0.24F, plain({0.45F, 0.38F, 0.32F}), 0.004F, true},
        {pauldron, {0, 1.43F, 0}, 0.34F, plain(steel), 0.002F, true},
        {sword,
         {0, 0.57F, 0.30F},
         0.61F,
         [](vec3 p) { return p.y > 0.885F ? gold : steel; },
         0.002F,
         true},
        {hands, {0, 1.09F, 0.27F}, 0.22F, plain(skin), 0.003F, true},
        {neck, {0, 1.6F, 0}, 0.17F, plain(skin), 0.02F, true},
        {[=](vec3 p) { return face((p - head) / 1.05F) * 1.05F; },
         {0, 1.72F, 0.02F},
         0.16F,
         [=](vec3 p) { return painted((p - head) / 1.05F); },
         0.012F,
         true},
        {guardsHair, {0, 1.67F, -0.01F}, 0.24F, plain(hair), 0.004F, true},
        {guardsCirclet, {0, 1.76F, -0.01F}, 0.14F, plain(gold), 0.002F, true},
    };
}

Shape plinth() {
    const float half = 0.65F; // its depth
    Outline outline{{0.25F, 0}, {0.25F, 0.11F}, {0.24F, 0.12F}, {0.05F, 0.12F}, {0.05F, 0.16F}};
    addArc(outline, {0.05F, 0.19F}, 0.03F, -90, 60, 4);
    outline.insert(outline.end(), {{0, 0.23F}, {0, 0.29F}, {-0.01F, 0.30F}, {-half, 0.30F}});
    return pillar(outline, {2.0F, 2 * half});
}

// A blind arcade behind the figures, so that their heads stand before stone and not sky.
void addWall(Shape& ashlarWork, Shape& limestoneWork) {
    const ArchedWall wall{1.6F, 0.58F, 1.75F, 3.1F, 0.3F, 0};
    const Shape ring = voussoirs(wall, 11, 0.2F), post = pier({0.30F, 0.2F}, wall.springing);
    for (int i = -2; i <= 2; ++i) {
        const glm::mat4 place = at({wall.bay * part(i, 1), 0, -1.75F});
        ashlarWork.add(archedWall(wall), place);
        limestoneWork.add(ring, place);
        limestoneWork.add(post, place * at({wall.bay / 2, 0, 0.12F}));
    }
    ashlarWork.add(box({8, 3.1F, 0.1F}, 0.01F), at({0, 1.55F, -1.92F}));
    limestoneWork.add(cornice({5, 1.6F}, 0.22F, 0.3F), at({0, 3.0F, 0}));
    projectUv(ashlarWork);
}

void addSurroundings(Scene& scene) {
    Shape ashlarWork, limestoneWork = plinth();
    addWall(ashlarWork, limestoneWork);
    Shape floor =
        patch([](glm::vec2 uv) { return vec3(10 * uv.x - 5, 0, 6 - 8 * uv.y); }, 16, 16, {1, 1});
    projectUv(floor);
    addMesh(scene, limestoneWork,
            addMaterial(scene, {.name = "limestone", .roughness = 0.8F}, {512, 1.5F}, limestone()),
            1.5F);
    addMesh(scene, ashlarWork, addMaterial(scene, {.name = "ashlar"}, {1024, 4}, ashlar()), 4);
    addMesh(scene, floor,
            addMaterial(scene, {.name = "flagstones"}, {1024, 4, true, true}, flagstones()), 4);
}

} // namespace

Scene figures() {
    Scene scene;
    addSurroundings(scene);
    addFigure(scene, "reader", reader(), at({-0.46F, 0.30F, 0.0F}, 16));
    addFigure(scene, "guard", guard(), at({0.46F, 0.30F, -0.02F}, -12));
    return scene;
}

} // namespace obscura::builtin
