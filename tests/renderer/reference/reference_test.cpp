// Rays against the closed forms of the fact sheet, section A.1; its numbers are checked too.
#include "tests/renderer/reference/reference_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
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
    }
    EXPECT_GE(all.count, 64);
    EXPECT_LE(all.outside, all.count / 100);
    EXPECT_GT(all.rms(), 0.5);
    EXPECT_LT(all.rms(), 1.5);
}

TEST(Reference, MeetsTheClosedForms) { expectTruth(cosineCases()); }
TEST(Reference, MeetsTheClosedFormsOfOtherIntegrals) { expectTruth(otherCases()); }

// Random rays: -0.5; jittered in two dimensions, with an edge: -0.75.
TEST(Reference, ConvergesFasterThanRandomRays) {
    std::vector<Case> cases = cosineCases();
    std::erase_if(cases, [](const Case& c) {
        return c.name != "corner0.250000" && c.name != "trihedral0.500000" &&
               c.name != "sphere1.000000";
    });
    ASSERT_EQ(cases.size(), 3);
    double sumX = 0, sumY = 0, sumXX = 0, sumXY = 0, count = 0;
    for (const int rays : {64, 256, 1024, 4096, 16384}) {
        double squares = 0;
        for (const Case& c : cases)
            squares += std::pow(scoresOf(c, 64, rays).meanError, 2);
        const double x = std::log(rays), y = 0.5 * std::log(squares);
        sumX += x, sumY += y, sumXX += x * x, sumXY += x * y, count += 1;
    }
    EXPECT_LT((count * sumXY - sumX * sumY) / (count * sumXX - sumX * sumX), -0.6);
}

bool operator==(const Reference& a, const Reference& b) {
    return a.visibility.pixels == b.visibility.pixels && a.error.pixels == b.error.pixels &&
           a.bentNormal.pixels == b.bentNormal.pixels;
}

TEST(Reference, DoesNotDependOnThreads) {
    const Build scene = Build().floor(5).sphere({1, 0, 1}, 1);
    const Surfaces surfaces = originSurfaces(scene, 500);
    const RayTracer tracer(scene);
    for (const Integral integral : {Integral::cosine, Integral::uniform, Integral::falloff}) {
        const auto traced = [&](int threads, std::uint64_t seed) {
            return tracer.trace(surfaces, {integral, 2, 64, seed, threads});
        };
        EXPECT_TRUE(traced(1, 1) == traced(2, 1));
        EXPECT_TRUE(traced(1, 1) == traced(7, 1));
        EXPECT_FALSE(traced(1, 1) == traced(1, 2));
    }
}

// The same point everywhere: the same rays find the same there, and as much as other rays do.
TEST(Reference, SameRaysAgreeWhereOthersAreNoise) {
    const Build scene = corner(0.5, far, far);
    const Surfaces surfaces = originSurfaces(scene, 40);
    const RayTracer tracer(scene);
    double sum = 0;
    constexpr int seeds = 40;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        TraceSettings settings{Integral::cosine, 1, 64, seed};
        settings.sameRays = true;
        const std::vector<float> same = tracer.trace(surfaces, settings).visibility.pixels;
        EXPECT_EQ(same, std::vector<float>(same.size(), same[0]));
        sum += static_cast<double>(same[0]);
        settings.sameRays = false;
        const std::vector<float> own = tracer.trace(surfaces, settings).visibility.pixels;
        EXPECT_GT(std::set<float>(own.begin(), own.end()).size(), 3);
    }
    EXPECT_NEAR(sum / seeds, 1 - segment(0.5), 0.01); // one seed is off by 0.02 or so
}

TEST(Reference, EmptyPixelsAreOpen) {
    const Build scene = Build().floor(5);
    Surfaces surfaces = originSurfaces(scene, 20);
    std::fill(surfaces.depth.begin(), surfaces.depth.end(), surfaces.frame.depth.y);
    const Reference reference = RayTracer(scene).trace(surfaces, {});
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(reference.visibility.at(i, 0, 0), 1);
        EXPECT_EQ(reference.error.at(i, 0, 0), 0);
    }
}

// Beside an endless wall half of the hemisphere is open; of a half-disc's points (Nusselt), the
// mean distance from the diameter is 4 / 3 pi, the mean height of the sphere above them 2 / 3.
TEST(Reference, BentNormalLeansAwayFromAWall) {
    const Build scene = corner(0.002, 2, 2);
    const Reference reference =
        RayTracer(scene).trace(originSurfaces(scene, 1), {Integral::cosine, 1, 16384, 1, 2});
    const glm::dvec3 expected =
        glm::normalize(Build::turn() * glm::dvec3(-4 / (3 * pi), 0, 2.0 / 3));
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(static_cast<double>(reference.bentNormal.at(0, 0, axis)), expected[axis], 2e-3);
}

// A sheet of two texels' width, one opaque, one clear, repeated along x; above the floor at 1.
Build striped(double x0, double x1, float u1, Wrap wrap, float factor) {
    Build build;
    build.strip(x0, 1, x1, 1, far);
    Scene& scene = build.scene();
    for (int corner = 0; corner < 4; ++corner)
        scene.vertices[static_cast<std::size_t>(corner)].uv.x =
            corner == 1 || corner == 2 ? u1 : 0.0f;
    scene.textures.push_back({{2, 1, 4, {255, 255, 255, 255, 255, 255, 255, 0}}, true, wrap, wrap});
    scene.materials[0].baseColourTexture.texture = 0;
    scene.materials[0].baseColour.a = factor;
    scene.materials[0].alphaCutoff = 0.5f;
    return build;
}

// Part of case 7's sheet: from x0 to x1.
double stripe(double x0, double x1) {
    return 0.5 * (x1 / std::hypot(x1, 1.0) - x0 / std::hypot(x0, 1.0));
}

TEST(Reference, SeesThroughHolesOfMaskedMaterials) {
    // Filtered alpha falls below the cutoff half way between the texels' centres.
    const double repeated = stripe(-2, -1.5) + stripe(-1, -0.5) + stripe(0, 0.5) + stripe(1, 1.5);
    expectTruth({
        {"clamped", striped(-1, 1, 1, Wrap::clamp, 1), 1e4, stripe(-1, 0)},
        {"beyond the edge", striped(-1, 3, 2, Wrap::clamp, 1), 1e4, stripe(-1, 0)},
        {"repeated", striped(-2, 2, 4, Wrap::repeat, 1), 1e4, repeated},
        {"cutoff at 2/3", striped(-1, 1, 1, Wrap::clamp, 0.75f), 1e4, stripe(-1, -1.0 / 6)},
        {"falloff", striped(-1, 1, 1, Wrap::clamp, 0.4f), 1e4, 0, Integral::falloff},
        {"too faint", striped(-1, 1, 1, Wrap::clamp, 0.4f), 1e4, 0},
    });
}

} // namespace
} // namespace obscura
