// The committed sample sets of VAO++ (renderer/techniques/poisson_sets.h).
#include "base/files.h"
#include "renderer/techniques/disc_points.h"
#include "renderer/techniques/poisson.h"
#include "renderer/techniques/poisson_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

std::vector<glm::dvec2> committed(int size) {
    std::vector<glm::dvec2> points;
    for (int i = size - 2; i < 2 * size - 2; ++i)
        points.emplace_back(poissonSets[i][0], poissonSets[i][1]);
    return points;
}

TEST(PoissonSets, TheGeneratorGivesTheCommittedFile) {
    EXPECT_EQ(poissonTable(poissonSeed),
              readFile(OBSCURA_SOURCE "/renderer/techniques/poisson_sets.h"));
}

TEST(PoissonSets, AreSixtyTwoPointsOfTheUnitDisc) {
    EXPECT_EQ(std::size(poissonSets), 62u);
    for (const auto& [x, y] : poissonSets)
        EXPECT_LT(std::hypot(x, y), 1);
}

// The densest packing of m points has a distance of sqrt(2 pi / (sqrt(3) m)); random ones without
// minimum come as close as sqrt(2) / m. Dart throwing reaches three quarters of the former.
TEST(PoissonSets, KeepTheirDistanceOverAllRotations) {
    for (const int size : poissonSizes) {
        const double densest = std::sqrt(2 * M_PI / (std::sqrt(3.0) * poissonRotations * size));
        EXPECT_GT(leastDistance(committed(size)), 0.7 * densest) << size;
    }
}

TEST(PoissonSets, LieInZOrder) {
    for (const int size : poissonSizes) {
        const std::vector<glm::dvec2> points = committed(size);
        EXPECT_TRUE(std::is_sorted(points.begin(), points.end(), [](glm::dvec2 a, glm::dvec2 b) {
            return zOrder(a) < zOrder(b);
        })) << size;
    }
}

TEST(PoissonSets, ZOrderInterleavesBits) {
    EXPECT_EQ(zOrder({-1, -1}), 0u);
    EXPECT_EQ(zOrder({1, -1}), 0x55555555u);
    EXPECT_EQ(zOrder({-1, 1}), 0xAAAAAAAAu);
    EXPECT_LT(zOrder({0.9, -0.1}), zOrder({-0.9, 0.1})); // quadrants: y decides first
}

// No one point's rotation could be changed to spread the set wider: for the sets whose rotations
// are chosen all at once.
TEST(PoissonSets, HaveTheWidestRotations) {
    for (const int size : {2, 4, 8}) {
        const std::vector<glm::dvec2> points = committed(size);
        const auto spread = [&](std::size_t i, glm::dvec2 p) {
            double sum = 0;
            for (std::size_t j = 0; j < points.size(); ++j)
                sum += j == i ? 0 : glm::distance(p, points[j]);
            return sum;
        };
        for (std::size_t i = 0; i < points.size(); ++i)
            for (int r = 1; r < poissonRotations; ++r) {
                const double angle = 2 * M_PI * r / poissonRotations;
                const glm::dvec2 p = points[i];
                const glm::dvec2 turned(p.x * std::cos(angle) - p.y * std::sin(angle),
                                        p.x * std::sin(angle) + p.y * std::cos(angle));
                EXPECT_LE(spread(i, turned), spread(i, p) + 1e-5) << size << " " << i;
            }
    }
}

// What the technique needs of them: the share of the ball's volume beyond any plane, from the nine
// rotations together. Largest error over planes.
TEST(PoissonSets, FillTheDiscEvenly) {
    const double allowed[] = {0.10, 0.06, 0.06, 0.03, 0.012};
    for (std::size_t set = 0; set < std::size(poissonSizes); ++set)
        for (const double c : {0.0, 0.2, 0.4, 0.6, 0.8})
            for (int turn = 0; turn < 72; ++turn) {
                double beyond = 0, total = 0;
                for (const glm::dvec2 p : committed(poissonSizes[set]))
                    for (int r = 0; r < poissonRotations; ++r) {
                        const double angle = M_PI * (turn / 36.0 + 2.0 * r / poissonRotations);
                        const double chord = std::sqrt(1 - glm::dot(p, p));
                        total += chord;
                        if (p.x * std::cos(angle) + p.y * std::sin(angle) > c)
                            beyond += chord;
                    }
                EXPECT_NEAR(beyond / total, (1 - c) * (1 - c) * (2 + c) / 4, allowed[set])
                    << poissonSizes[set] << " points beyond " << c;
            }
}

TEST(PoissonDiscPoints, AddASpiralWhereThereIsNoSet) {
    Settings settings(technique("vao_plus_plus"));
    for (const int samples : {2, 16, 32}) {
        settings.set("samples", samples);
        EXPECT_EQ(poissonDiscPoints(settings).size(), 62u);
    }
    for (const int samples : {1, 33, 1024}) {
        settings.set("samples", samples);
        const std::vector<glm::vec4> points = poissonDiscPoints(settings);
        ASSERT_EQ(points.size(), 62u + static_cast<std::size_t>(samples));
        double square = 0;
        for (std::size_t i = 62; i < points.size(); ++i)
            square += static_cast<double>(points[i].x * points[i].x + points[i].y * points[i].y);
        EXPECT_NEAR(square / samples, 0.5, 1e-5); // as of the even disc
    }
}

} // namespace
} // namespace obscura
