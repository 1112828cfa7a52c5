// Solids whose surface must be closed, against volumes and lengths worked out on paper.
#include "renderer/builtin/masonry.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace obscura::builtin {
namespace {

using Corner = std::array<long, 3>; // a place to a micrometre

Corner cornerOf(const Shape& shape, std::size_t index) {
    const glm::vec3 p = shape.vertices[shape.indices[index]].position * 1e6F;
    return {std::lround(p.x / 2), std::lround(p.y / 2), std::lround(p.z / 2)};
}

// How many edges lack one that runs the other way: none where the surface is closed and all its
// triangles face the same way.
int openEdges(const Shape& shape) {
    std::map<std::pair<Corner, Corner>, int> edges;
    for (std::size_t i = 0; i < shape.indices.size(); ++i) {
        const Corner a = cornerOf(shape, i), b = cornerOf(shape, i % 3 == 2 ? i - 2 : i + 1);
        ++edges[{a, b}];
        --edges[{b, a}];
    }
    int open = 0;
    for (const auto& [edge, count] : edges)
        open += count > 0 ? count : 0;
    return open;
}

// By the divergence theorem; positive where triangles face outwards.
double volume(const Shape& shape) {
    double sum = 0;
    for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
        const auto p = [&](std::size_t k) {
            return glm::dvec3(shape.vertices[shape.indices[i + k]].position);
        };
        sum += glm::dot(p(0), glm::cross(p(1), p(2))) / 6;
    }
    return sum;
}

TEST(Shapes, APiercedWallIsClosedAndLacksItsHoles) {
    const std::array<Hole, 3> holes{
        Hole{{-1.5F, 0}, {-0.5F, 2}}, {{0.25F, 1}, {1.25F, 2.25F}}, {{1.5F, 1}, {1.75F, 1.5F}}};
    const Shape wall = piercedWall({4, 3, 0.25F}, holes);
    EXPECT_NEAR(volume(wall), 0.25 * (12 - 2 - 1.25 - 0.125), 1e-5);
    // The grid of cuts is coarser than the wall's faces only where both agree.
    EXPECT_EQ(openEdges(wall), 0);
}

TEST(Shapes, ARoundedBoxIsClosedAndAsLargeAsABoxWithRoundEdges) {
    const glm::dvec3 size(0.6, 0.3, 0.4);
    const double r = 0.05;
    const Shape shape = rounded(glm::vec3(size), static_cast<float>(r), 2, 8);
    EXPECT_EQ(openEdges(shape), 0);
    const glm::dvec3 inner = size - 2 * r;
    const double sides = 2 * r * (inner.x * inner.y + inner.y * inner.z + inner.z * inner.x);
    const double edges = glm::pi<double>() * r * r * (inner.x + inner.y + inner.z);
    const double ball = 4 * glm::pi<double>() * r * r * r / 3;
    const double expected = inner.x * inner.y * inner.z + sides + edges + ball;
    EXPECT_NEAR(volume(shape), expected, 0.001 * expected);
    for (const Vertex& vertex : shape.vertices)
        EXPECT_TRUE(
            glm::all(glm::lessThan(glm::abs(vertex.position), glm::vec3(size) / 2.0F + 1e-6F)));
}

TEST(Shapes, ARodIsAClosedPrism) {
    const Shape shape = rod({0.1F, 0, 0, 0.02F}, {0.1F, 0.3F, 0.4F, 0.02F}, 12);
    EXPECT_EQ(openEdges(shape), 0);
    const double section = 0.5 * 12 * 0.02 * 0.02 * std::sin(glm::two_pi<double>() / 12);
    EXPECT_NEAR(volume(shape), 0.5 * section, 1e-7);
}

TEST(Shapes, ABentTubeIsClosedAndFacesOutwards) {
    const Shape shape =
        tube(std::array{glm::vec4(0, 0, 0, 0.03F), glm::vec4(0, 0.5F, 0, 0.02F),
                        glm::vec4(0.3F, 0.8F, 0, 0.02F), glm::vec4(0.6F, 0.8F, 0.4F, 0.01F)},
             9);
    EXPECT_EQ(openEdges(shape), 0);
    EXPECT_GT(volume(shape), 0);
}

} // namespace
} // namespace obscura::builtin
