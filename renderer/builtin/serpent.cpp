#include "renderer/builtin/serpent.h"

#include "renderer/builtin/implicit.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace obscura::builtin {

namespace {

constexpr int perJoint = 8; // rings between two joints
constexpr std::size_t perRun = 6;
constexpr float headScale = 1.25F;

// Catmull and Rom 1974, through b and c.
template <typename T>
T spline(T a, T b, T c, T d, float t) {
    return 0.5F * (2.0F * b + (c - a) * t + (2.0F * a - 5.0F * b + 4.0F * c - d) * (t * t) +
                   (3.0F * b - a - 3.0F * c + d) * (t * t * t));
}

glm::vec3 perpendicular(glm::vec3 v, glm::vec3 axis) {
    return glm::normalize(v - glm::dot(v, axis) * axis);
}

} // namespace

Serpent::Serpent(const std::vector<Joint>& joints) {
    const auto joint = [&](std::size_t i, std::size_t offset) { // offset by one, clamped
        return joints[std::min(std::max(i + offset, std::size_t{1}) - 1, joints.size() - 1)];
    };
    float along = 0;
    for (std::size_t i = 0; i + 1 < joints.size(); ++i)
        for (int k = 0; k < perJoint; ++k) {
            const Joint a = joint(i, 0), b = joint(i, 1), c = joint(i, 2), d = joint(i, 3);
            const float t = part(k, perJoint);
            const glm::vec3 centre = spline(a.position, b.position, c.position, d.position, t);
            const float radius = spline(a.radius, b.radius, c.radius, d.radius, t);
            if (!rings_.empty())
                along += glm::distance(rings_.back().centre, centre) / radius;
            rings_.push_back({centre, {0, 1, 0}, radius, along});
        }
    turnBacks();
    groupRuns();
}

// Carries the back along the curve without twist, then spreads over its whole length the twist
// that brings the crest on top of the head.
void Serpent::turnBacks() {
    const auto direction = [&](std::size_t i) {
        const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, rings_.size() - 1);
        return glm::normalize(rings_[after].centre - rings_[before].centre);
    };
    for (std::size_t i = 0; i < rings_.size(); ++i)
        rings_[i].back =
            perpendicular(i > 0 ? rings_[i - 1].back : glm::vec3(0, 1, 0), direction(i));
    const glm::vec3 forward = direction(rings_.size() - 1);
    const glm::vec3 up = perpendicular({0, 1, 0}, forward), back = rings_.back().back;
    const float twist = std::atan2(glm::dot(glm::cross(back, up), forward), glm::dot(back, up));
    for (std::size_t i = 0; i < rings_.size(); ++i) {
        const float angle = twist * static_cast<float>(i) / static_cast<float>(rings_.size() - 1);
        const glm::vec3 side = glm::cross(direction(i), rings_[i].back);
        rings_[i].back = std::cos(angle) * rings_[i].back + std::sin(angle) * side;
    }
    headFromWorld_ = glm::transpose(glm::mat3(glm::cross(up, forward), up, forward));
}

void Serpent::groupRuns() {
    for (std::size_t first = 0; first + 1 < rings_.size(); first += perRun) {
        const std::size_t last = std::min(first + perRun, rings_.size() - 1);
        const Ring& middle = rings_[(first + last) / 2];
        Run run{first, last, middle.centre, 0, middle.radius};
        for (std::size_t i = first; i <= last; ++i)
            run.radius = std::max(run.radius,
                                  glm::distance(run.centre, rings_[i].centre) + rings_[i].radius);
        runs_.push_back(run);
    }
}

namespace {

// Diamonds, each a dome that rises towards the tail, so that it seems to overlap the next.
float scales(float along, float around) {
    const float a = along / 0.76F, b = around * 10 / glm::two_pi<float>();
    const float p = glm::fract(a + b / 2), q = glm::fract(a - b / 2);
    const float dome = std::min(std::min(p, 1 - p), std::min(q, 1 - q)) * 2;
    return std::sqrt(dome) * (0.55F + 0.45F * (2 - p - q) / 2);
}

float plates(float along) {
    const float t = glm::fract(along / 0.58F);
    return 0.85F * std::sqrt(std::max(0.0F, 1 - std::pow(std::abs(1.7F * t - 0.7F), 3.0F)));
}

// How far the skin stands out, in radii. `around`: 0 on the back, pi on the belly.
float skin(float along, float around) {
    const float belly = glm::smoothstep(2.05F, 2.25F, std::abs(around));
    const float seam =
        0.25F * std::exp(-70 * (std::abs(around) - 2.15F) * (std::abs(around) - 2.15F));
    return 0.26F * (glm::mix(scales(along, around), plates(along), belly) - 0.7F) - seam * 0.5F;
}

// Thorns along the back, in radii: swept towards the tail.
float crest(float along, float side, float up) {
    const float t = glm::fract((along + 0.8F * (up - 1)) / 1.15F);
    const float height = 1.05F + 0.62F * std::pow(1 - std::abs(2 * t - 1), 1.3F);
    // 0.55: a thorn's slope makes the next one nearer than it seems from above.
    return std::max(
        {std::abs(side) - 0.26F + 0.30F * std::max(0.0F, up - 0.9F), 0.55F * (up - height), -up});
}

} // namespace

Serpent::Nearest Serpent::nearest(glm::vec3 p) const {
    Nearest best;
    for (const Run& run : runs_) // a first guess, to pass over most runs below
        best.distance = std::min(best.distance, glm::distance(p, run.centre) - run.least + 1e-5F);
    for (const Run& run : runs_) {
        if (glm::distance(p, run.centre) - run.radius > best.distance)
            continue;
        for (std::size_t i = run.first; i < run.last; ++i) {
            const glm::vec3 axis = rings_[i + 1].centre - rings_[i].centre;
            const float t =
                glm::clamp(glm::dot(p - rings_[i].centre, axis) / glm::dot(axis, axis), 0.0F, 1.0F);
            const float d = glm::distance(p, rings_[i].centre + t * axis) -
                            glm::mix(rings_[i].radius, rings_[i + 1].radius, t);
            if (d <= best.distance)
                best = {d, i, t};
        }
    }
    return best;
}

float Serpent::distance(glm::vec3 p) const {
    const Nearest found = nearest(p);
    float best = found.distance;
    const Ring &a = rings_[found.ring], &b = rings_[found.ring + 1];
    const float where = found.t, radius = glm::mix(a.radius, b.radius, where);
    if (best < 1.2F * radius) {
        const float along = glm::mix(a.along, b.along, where);
        const glm::vec3 back = glm::normalize(glm::mix(a.back, b.back, where));
        const glm::vec3 offset = p - glm::mix(a.centre, b.centre, where);
        const float up = glm::dot(offset, back) / radius;
        const float side =
            glm::dot(offset, glm::cross(glm::normalize(b.centre - a.centre), back)) / radius;
        best -= radius * skin(along, std::atan2(side, up));
        best = merge(best, radius * crest(along, side, up), 0.2F * radius);
    }
    return merge(best, head(p), 0.03F);
}

namespace {

// In head space: x to the side (both sides alike), y up, z forwards; metres before scaling.
float skull(glm::vec3 p) {
    float d = ellipsoid(p - glm::vec3(0, 0.005F, -0.01F), {0.058F, 0.050F, 0.075F});
    d = withLimbs(d, p,
                  {{{0, 0.010F, 0.05F}, {0, 0.004F, 0.145F}, 0.042F, 0.026F, 0.03F},
                   {{0.014F, 0.018F, 0.148F}, {0.020F, 0.014F, 0.156F}, 0.014F, 0.012F, 0.012F},
                   {{0.016F, 0.042F, 0.085F}, {0.056F, 0.050F, 0.000F}, 0.010F, 0.018F, 0.010F},
                   {{0.056F, 0.055F, 0.015F}, {0.070F, 0.078F, -0.01F}, 0.010F, 0.002F, 0.006F},
                   {{0.040F, 0.054F, 0.045F}, {0.046F, 0.074F, 0.030F}, 0.008F, 0.002F, 0.006F},
                   {{0.052F, -0.012F, 0.055F}, {0.060F, 0.0F, -0.03F}, 0.012F, 0.02F, 0.015F}});
    // Wrinkles across the snout.
    d += 0.0035F * std::sin(240 * p.z + 300 * p.x * p.x) * glm::smoothstep(0.055F, 0.075F, p.z) *
         glm::smoothstep(0.0F, 0.02F, p.y);
    d = cut(d, limb(p, {0.052F, 0.024F, 0.062F}, {0.058F, 0.022F, 0.036F}, 0.015F, 0.017F), 0.008F);
    d = cut(d, limb(p, {0.017F, 0.026F, 0.176F}, {0.030F, 0.026F, 0.158F}, 0.011F, 0.006F), 0.004F);
    return std::min(d, glm::distance(p, {0.043F, 0.022F, 0.048F}) - 0.0145F); // the eye
}

float jaw(glm::vec3 p) {
    float d = limb(p, {0, -0.040F, 0.0F}, {0, -0.100F, 0.110F}, 0.034F, 0.018F);
    d = cut(d, limb(p, {0, -0.030F, 0.03F}, {0, -0.080F, 0.120F}, 0.020F, 0.010F), 0.006F);
    return withLimbs(
        d, p,
        {{{0, -0.036F, 0.02F}, {0, -0.056F, 0.085F}, 0.012F, 0.008F, 0.006F},
         {{0, -0.056F, 0.085F}, {0, -0.050F, 0.125F}, 0.008F, 0.003F, 0.004F},
         {{0, -0.115F, 0.100F}, {0, -0.150F, 0.075F}, 0.011F, 0.002F, 0.010F},
         {{0.024F, -0.090F, 0.05F}, {0.032F, -0.128F, 0.015F}, 0.011F, 0.002F, 0.010F},
         {{0.034F, -0.065F, 0.01F}, {0.048F, -0.100F, -0.03F}, 0.011F, 0.002F, 0.010F}});
}

float teeth(glm::vec3 p) {
    return withLimbs(
        1, p,
        {{{0.018F, -0.010F, 0.146F}, {0.019F, -0.048F, 0.150F}, 0.0085F, 0.002F, 0.001F},
         {{0.028F, -0.016F, 0.115F}, {0.029F, -0.040F, 0.116F}, 0.007F, 0.002F, 0.001F},
         {{0.034F, -0.020F, 0.085F}, {0.035F, -0.044F, 0.085F}, 0.007F, 0.002F, 0.001F},
         {{0.014F, -0.088F, 0.112F}, {0.016F, -0.058F, 0.124F}, 0.0075F, 0.002F, 0.001F},
         {{0.024F, -0.074F, 0.075F}, {0.027F, -0.052F, 0.086F}, 0.007F, 0.002F, 0.001F}});
}

// Ringed horns, and behind the cheek a frill: three spines and the skin between.
float horns(glm::vec3 p) {
    const float rings = 0.0025F * std::sin(420 * p.z);
    float d =
        rings +
        withLimbs(1, p,
                  {{{0.034F, 0.040F, -0.03F}, {0.062F, 0.088F, -0.11F}, 0.020F, 0.014F, 0.004F},
                   {{0.062F, 0.088F, -0.11F}, {0.060F, 0.135F, -0.165F}, 0.014F, 0.003F, 0.004F}});
    d = withLimbs(d, p,
                  {{{0.045F, 0.005F, -0.02F}, {0.125F, 0.035F, -0.095F}, 0.012F, 0.003F, 0.01F},
                   {{0.045F, -0.016F, -0.02F}, {0.125F, -0.014F, -0.084F}, 0.012F, 0.003F, 0.01F},
                   {{0.045F, -0.037F, -0.02F}, {0.125F, -0.063F, -0.074F}, 0.012F, 0.003F, 0.01F}});
    const glm::vec3 q = turned(p - glm::vec3(0.08F, -0.012F, -0.055F), 1, -45);
    return merge(d, ellipsoid(q, {0.045F, 0.040F, 0.0065F}), 0.006F);
}

} // namespace

float Serpent::head(glm::vec3 p) const {
    glm::vec3 q = headFromWorld_ * (p - rings_.back().centre) / headScale;
    const float far = glm::distance(q, {0, 0, 0}) - 0.25F;
    if (far > 0.05F)
        return far * headScale;
    q.x = std::abs(q.x);
    float d = merge(skull(q), jaw(q), 0.012F);
    d = merge(d, teeth(q), 0.003F);
    return merge(d, horns(q), 0.01F) * headScale;
}

} // namespace obscura::builtin
