#include "renderer/scene/proxies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace obscura {
namespace {

// Adds a surface point(u, v) over the unit square as a grid of 2 n m triangles; `point` runs so
// that du x dv points out of it.
void addGrid(Scene& scene, int n, int m, const std::function<glm::vec3(float, float)>& point) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    const auto columns = static_cast<std::uint32_t>(n + 1);
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i)
            scene.vertices.push_back({point(static_cast<float>(i) / static_cast<float>(n),
                                            static_cast<float>(j) / static_cast<float>(m)),
                                      {},
                                      {},
                                      {}});
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(m); ++j)
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
            const std::uint32_t a = first + j * columns + i, b = a + 1, c = b + columns,
                                d = a + columns;
            for (const std::uint32_t index : {a, b, c, a, c, d})
                scene.indices.push_back(index);
        }
}

void addBall(Scene& scene, glm::vec3 centre, float radius, int n) {
    addGrid(scene, n, n / 2, [&](float u, float v) {
        const float longitude = u * 2 * std::numbers::pi_v<float>;
        const float colatitude = (1 - v) * std::numbers::pi_v<float>;
        return centre + radius * glm::vec3(std::sin(colatitude) * std::sin(longitude),
                                           std::cos(colatitude),
                                           std::sin(colatitude) * std::cos(longitude));
    });
}

// Six thin walls around 8 x 4 x 6 metres of air, a ball in the air, and a pole.
Scene room(float scale = 1) {
    Scene scene;
    const glm::vec3 size = glm::vec3(8, 4, 6) * scale;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            addGrid(scene, 1, 1, [&](float u, float v) {
                glm::vec3 p(0);
                p[axis] = static_cast<float>(side);
                p[(axis + 1) % 3] = side ? 1 - u : u; // facing inwards
                p[(axis + 2) % 3] = v;
                return p * size;
            });
    addBall(scene, glm::vec3(3, 2, 3) * scale, 0.5f * scale, 48);
    addGrid(scene, 12, 1, [&](float u, float v) {
        const float angle = u * 2 * std::numbers::pi_v<float>;
        return scale * glm::vec3(6 + 0.05f * std::sin(angle), 4 * v, 3 + 0.05f * std::cos(angle));
    });
    return scene;
}

// How far the farthest of many surface points lies outside all spheres, as a share of the size.
float uncovered(const Scene& scene, const std::vector<glm::vec4>& spheres) {
    float worst = -1e30f;
    for (std::size_t t = 0; t + 2 < scene.indices.size(); t += 3) {
        const glm::vec3 a = scene.vertices[scene.indices[t]].position,
                        b = scene.vertices[scene.indices[t + 1]].position,
                        c = scene.vertices[scene.indices[t + 2]].position;
        const int n = glm::length(glm::cross(b - a, c - a)) > 1 ? 40 : 2;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j + i <= n; ++j) {
                const glm::vec3 p = a + (b - a) * (static_cast<float>(i) / static_cast<float>(n)) +
                                    (c - a) * (static_cast<float>(j) / static_cast<float>(n));
                float nearest = 1e30f;
                for (const glm::vec4& s : spheres)
                    nearest = std::min(nearest, glm::distance(p, glm::vec3(s)) - s.w);
                worst = std::max(worst, nearest);
            }
    }
    return worst / glm::length(scene.bounds().high - scene.bounds().low);
}

TEST(ProxySpheresTest, ABallIsOneSphereOfItsSize) {
    Scene scene;
    addBall(scene, {1, 2, 3}, 0.5f, 48);
    const std::vector<glm::vec4> spheres = proxySpheres(scene);
    ASSERT_EQ(spheres.size(), 1u);
    EXPECT_NEAR(glm::distance(glm::vec3(spheres[0]), glm::vec3(1, 2, 3)), 0, 0.01f);
    EXPECT_NEAR(spheres[0].w, 0.5f, 0.01f);
}

TEST(ProxySpheresTest, CoverEverySurfacePointWithNoMoreThanTheyMay) {
    for (const int count : {1, 7, 256}) {
        const std::vector<glm::vec4> spheres = proxySpheres(room(), count);
        EXPECT_LE(spheres.size(), static_cast<std::size_t>(count));
        EXPECT_LT(uncovered(room(), spheres), 1e-5f);
    }
}

// 256 spheres for 212 square metres: with one part in 256 each, sqrt(212 / 256) is 0.91 m. None is
// larger than 1.2 times that, and none floats in the air: centres lie on a wall, in the ball or in
// the pole.
TEST(ProxySpheresTest, DoNotBalloonOutOfThinWalls) {
    float largest = 0, highest = 0;
    for (const glm::vec4& s : proxySpheres(room(), 256)) {
        largest = std::max(largest, s.w);
        const glm::vec3 inside =
            glm::min(glm::abs(glm::vec3(s)), glm::abs(glm::vec3(8, 4, 6) - glm::vec3(s)));
        const float wall = std::min({inside.x, inside.y, inside.z});
        const float ball = glm::distance(glm::vec3(s), glm::vec3(3, 2, 3)) - 0.5f;
        const float pole = glm::distance(glm::vec2(s.x, s.z), glm::vec2(6, 3)) - 0.05f;
        highest = std::max(highest, std::min({wall, ball, pole}));
    }
    EXPECT_LT(largest, 1.2f * 0.91f);
    EXPECT_LT(highest, 1e-3f);
}

TEST(ProxySpheresTest, AreTheSameEveryTimeAndScaleWithTheScene) {
    const std::vector<glm::vec4> once = proxySpheres(room()), again = proxySpheres(room()),
                                 large = proxySpheres(room(100));
    EXPECT_EQ(once, again);
    ASSERT_EQ(once.size(), large.size());
    for (std::size_t i = 0; i < once.size(); ++i)
        EXPECT_NEAR(glm::distance(once[i] * 100.0f, large[i]), 0, 0.05f) << i;
}

TEST(ProxySpheresTest, NoSurfaceNoSphere) {
    EXPECT_TRUE(proxySpheres(Scene{}).empty());
    Scene flat; // a triangle without area
    addGrid(flat, 1, 1, [](float u, float) { return glm::vec3(u, 0, 0); });
    EXPECT_TRUE(proxySpheres(flat).empty());
}

} // namespace
} // namespace obscura
