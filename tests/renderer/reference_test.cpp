// Rays against the closed forms of the fact sheet, section A.1; its numbers are checked too.
#include "tests/renderer/reference_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace obscura {
namespace {

double segment(double c) { return (std::acos(c) - c * std::sqrt(1 - c * c)) / pi; }

// Case 3.
double trihedral(double p, double q) {
    const double brace = 0.5 * (std::acos(p) + std::acos(q) - pi / 2 - p * std::sqrt(1 - p * p) -
                                q * std::sqrt(1 - q * q)) +
                         p * q;
    return segment(p) + segment(q) - (p * p + q * q < 1 ? brace / pi : 0);
}

// Case 5: a cap of that half-angle whose axis is `axis` from the normal.
double cap(double axis, double half) {
    const double s2 = std::pow(std::sin(half), 2);
    if (axis + half <= pi / 2)
        return std::cos(axis) * s2;
    const double x = 1 / std::tan(half), y = -x / std::tan(axis), w = std::sqrt(1 - y * y);
    return s2 / pi * (std::cos(axis) * std::acos(y) - x * std::sin(axis) * w) +
           std::atan(std::sin(axis) * w / x) / pi;
}

// A sphere at `x` across and `z` up, of which rays see what is nearer than `reach`.
double ball(double x, double z, double radius, double reach = 1e9) {
    const double distance = std::hypot(x, z);
    double cosine = std::sqrt(distance * distance - radius * radius) / distance;
    if (reach <= distance * cosine)
        cosine = (distance * distance + reach * reach - radius * radius) / (2 * distance * reach);
    return cap(std::acos(z / distance), std::acos(cosine));
}

// Case 4, the other wall `length` long.
double groove(double angle, double s, double length) {
    return 0.5 * (1 - (s - length * std::cos(angle)) /
                          std::sqrt(s * s + length * length - 2 * s * length * std::cos(angle)));
}

// Case 6, off-centre.
double well(double a, double h, double e) {
    const double sum = a * a + h * h + e * e;
    return 0.5 * (1 - (a * a - h * h - e * e) / std::sqrt(sum * sum - 4 * a * a * e * e));
}

double linearFalloff(double c) {
    return (std::acos(c) + c * std::sqrt(1 - c * c) - 2 * c * std::acosh(1 / c)) / pi;
}

struct Case {
    std::string name;
    Build scene;
    double radius, occlusion;
    Integral integral = Integral::cosine;
    double tilt = 0;
};

Build corner(double distance, double reach, double height) {
    return Build().floor(reach).strip(distance, 0, distance, height, reach);
}
Build grooveScene(double angle, double length, double reach) {
    // The origin is 1 from the apex, which is at x = 1.
    return Build().floor(reach).strip(1, 0, 1 - length * std::cos(angle), length * std::sin(angle),
                                      reach);
}

constexpr double far = 60; // reach of what stands for the infinite

std::vector<Case> cosineCases() {
    std::vector<Case> cases;
    const auto add = [&](const std::string& name, const Build& scene, double radius,
                         double occlusion) {
        cases.push_back({name, scene, radius, occlusion});
    };
    add("plane", Build().floor(far), 50, 0);
    for (const double c : {0.02, 0.1, 0.25, 0.5, 0.75})
        add("corner" + std::to_string(c), corner(c, 2, 2), 1, segment(c));
    for (const double h : {0.5, 1.0, 2.0})
        add("wall" + std::to_string(h), corner(1, far, h), 1e4,
            0.5 * (1 - 1 / std::sqrt(1 + h * h)));
    for (const double degrees : {30.0, 60.0, 120.0, 150.0}) {
        const double angle = degrees * pi / 180;
        add("groove" + std::to_string(degrees), grooveScene(angle, far, far), 50,
            cap(angle, std::acos(std::sin(angle) / 50)));
    }
    add("groove60bounded", grooveScene(pi / 3, 4, 4), 2,
        cap(pi / 3, std::acos(0.5 * std::sin(pi / 3))));
    add("groove45bounded", grooveScene(pi / 4, 8, 8), 4,
        cap(pi / 4, std::acos(0.25 * std::sin(pi / 4))));
    for (const double ratio : {0.25, 0.9})
        add("grooveShort" + std::to_string(ratio), grooveScene(pi / 3, 1 / ratio, far), 1e4,
            groove(pi / 3, 1, 1 / ratio));
    for (const double p : {0.02, 0.25, 0.5, 0.8})
        add("trihedral" + std::to_string(p),
            corner(p, 2, 2).quad({glm::dvec3(-2, p, 0), glm::dvec3(2, p, 0), glm::dvec3(2, p, 2),
                                  glm::dvec3(-2, p, 2)}),
            1, trihedral(p, p));
    for (const double x : {0.25, 0.5, 1.0, 2.0, 4.0})
        add("sphere" + std::to_string(x), Build().floor(5).sphere({x, 0, 1}, 1), 100,
            std::pow(1 + x * x, -1.5));
    for (const auto& [x, reach] : {std::pair(1.0, 0.6), std::pair(2.0, 1.5)})
        add("sphereBounded" + std::to_string(x), Build().floor(5).sphere({x, 0, 1}, 1), reach,
            ball(x, 1, 1, reach));
    for (const double x : {1.1, 3.0})
        add("dome" + std::to_string(x), Build().floor(5).sphere({x, 0, 0}, 1), 100, ball(x, 0, 1));
    for (const double z : {0.5, -0.3})
        add("buried" + std::to_string(z), Build().floor(5).sphere({1.2, 0, z}, 1), 100,
            ball(1.2, z, 1));
    for (const double h : {0.5, 1.0, 2.0})
        add("well" + std::to_string(h), Build().floor(3).pipe(0, 1, h), 100, h * h / (1 + h * h));
    add("wellBounded", Build().floor(3).pipe(0, 1, 2), 1.5, 1 - 1 / 2.25);
    add("wellOffCentre", Build().floor(3).pipe(0.5, 1, 1), 100, well(1, 1, 0.5));
    for (const double w : {0.1, 0.5, 2.0})
        add("bar" + std::to_string(w), Build().floor(far).strip(-w / 2, 1, w / 2, 1, far), 1e4,
            w / 2 / std::sqrt(1 + w * w / 4));
    // A tilted normal over a plane: what lies below the plane is blocked, a cap of a right angle.
    for (const double tilt : {0.2, 0.6, 1.2})
        cases.push_back({"tilted" + std::to_string(tilt), Build().floor(far), 50,
                         (1 - std::cos(tilt)) / 2, Integral::cosine, tilt});
    return cases;
}

std::vector<Case> otherCases() {
    std::vector<Case> cases;
    for (const double c : {0.1, 0.25, 0.5, 0.75})
        cases.push_back({"uniformCorner", corner(c, 2, 2), 1, (1 - c) / 2, Integral::uniform});
    for (const double x : {0.5, 1.0})
        cases.push_back({"uniformSphere", Build().floor(5).sphere({x, 0, 1}, 1), 100,
                         1 - x / std::hypot(x, 1.0), Integral::uniform});
    cases.push_back(
        {"uniformWell", Build().floor(3).pipe(0, 1, 1), 100, std::sqrt(0.5), Integral::uniform});
    cases.push_back({"uniformTilted", Build().floor(far), 50, 0.6 / pi, Integral::uniform, 0.6});
    for (const double c : {0.1, 0.25, 0.5})
        cases.push_back({"falloffCorner", corner(c, 2, 2), 1, linearFalloff(c), Integral::falloff});
    return cases;
}

// Pixels of one case in units of their own standard errors.
struct Scores {
    int count = 0, outside = 0;
    double squares = 0, mean = 0, meanError = 0; // of visibility less truth
    double rms() const { return std::sqrt(squares / std::max(count, 1)); }
};

Scores scoresOf(const Case& c, int pixels, int rays) {
    const Surfaces surfaces = originSurfaces(c.scene, pixels, c.tilt);
    const Reference reference =
        RayTracer(c.scene).trace(surfaces, {c.integral, c.radius, rays, 7, 2});
    Scores scores;
    double variance = 0;
    for (int i = 0; i < pixels; ++i) {
        const double off =
            static_cast<double>(reference.visibility.at(i, 0, 0)) - (1 - c.occlusion);
        const double error = static_cast<double>(reference.error.at(i, 0, 0));
        scores.mean += off / pixels;
        variance += off * off;
        ++scores.count;
        scores.outside += std::abs(off) > 3 * error;
        scores.squares += off * off / (error * error);
    }
    scores.meanError = std::sqrt(variance) / pixels;
    return scores;
}

void expectTruth(const std::vector<Case>& cases) {
    Scores all;
    for (const Case& c : cases) {
        const Scores scores = scoresOf(c, 64, 1024);
        // The pixels' mean: a bias would be seen here first. 1e-4 allows for tessellation and for
        // ends of what ought to be infinite.
        EXPECT_NEAR(scores.mean, 0, 4 * scores.meanError + 1e-4) << c.name;
        all.count += scores.count;
        all.outside += scores.outside;
        all.squares += scores.squares;
        if (std::getenv("OBSCURA_PRINT"))
            printf("%-20s truth %.5f mean off %+.5f +- %.5f  rms z %.2f outside %d of %d\n",
                   c.name.c_str(), 1 - c.occlusion, scores.mean, scores.meanError, scores.rms(),
                   scores.outside, scores.count);
    }
    EXPECT_GT(all.count, 500);
    EXPECT_LE(all.outside, all.count / 100);
    EXPECT_GT(all.rms(), 0.5);
    EXPECT_LT(all.rms(), 1.5);
    if (std::getenv("OBSCURA_PRINT"))
        printf("all: rms z %.3f, outside %d of %d\n", all.rms(), all.outside, all.count);
}

TEST(Reference, MeetsTheClosedForms) { expectTruth(cosineCases()); }
TEST(Reference, MeetsTheClosedFormsOfOtherIntegrals) { expectTruth(otherCases()); }

} // namespace
} // namespace obscura
