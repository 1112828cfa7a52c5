// Ambient occlusion volumes and voxel cone tracing against closed forms of true geometry: seen from
// straight above, walls show no face, so that no screen-space technique could pass.
#include "tests/renderer/techniques/limits_fixture.h"

#include <numbers>

namespace obscura {
namespace {

// Floors and walls at most 1.1 m from the place under test, which is the origin on a floor at y =
// 0.
class ObjectLimits : public Limits {
  public:
    static constexpr float half = 1.1f;

    static void addFloor(Scene& scene, float further = 0) {
        addQuad(scene, {glm::vec3(-half - further, 0, half), glm::vec3(half, 0, half),
                        glm::vec3(half, 0, -half), glm::vec3(-half - further, 0, -half)});
    }
    // A wall at x = distance, of which the floor sees the front. The scene, and so its grid of
    // voxels, begins `further` to the other side.
    static Scene corner(float distance, float height, float further = 0, float wallHalf = half) {
        Scene scene;
        addFloor(scene, further);
        addQuad(scene,
                {glm::vec3(distance, 0, -wallHalf), glm::vec3(distance, 0, wallHalf),
                 glm::vec3(distance, height, wallHalf), glm::vec3(distance, height, -wallHalf)});
        return scene;
    }
    // Radius 1 around the origin, of many flat sides.
    static Scene well(float height) {
        constexpr int sides = 96;
        Scene scene;
        addFloor(scene);
        const auto on = [](int i, float y) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / sides;
            return glm::vec3(std::cos(angle), y, std::sin(angle));
        };
        for (int i = 0; i < sides; ++i)
            addQuad(scene, {on(i, 0), on(i + 1, 0), on(i + 1, height), on(i, height)});
        return scene;
    }
    // Visibility of the origin, seen from above by the middle one of 5 x 5 pixels.
    static double open(const Scene& scene, const Settings& settings) {
        return static_cast<double>(seenFrom({0, 4, 0}, scene, settings, 20).at(2, 2, 0));
    }
    // The mean over pixels that all but show the origin, one for each place of the noise tile, and
    // over seeds.
    static double mean(const Scene& scene, const Settings& settings, int seeds = 1) {
        double sum = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            const Image image = seenFrom({0, 4, 0}, scene, settings, 0.1, seed);
            for (int i = 0; i < 16; ++i)
                sum += static_cast<double>(image.at(i % 4, i / 4, 0)) / 16;
        }
        return sum / seeds;
    }
    static Image seenFrom(const Vec3& position, const Scene& scene, const Settings& settings,
                          double degrees, int seed = 1) {
        Camera camera;
        camera.position = position;
        camera.up = {0, 0, -1};
        camera.fovDegrees = degrees;
        return visibilityOf(scene, camera, settings, 5, 5, static_cast<std::uint64_t>(seed));
    }

    // No falloff but at the far end of a radius that the scene does not fill.
    static Settings volumes(double radius) {
        Settings settings = neutral("ambient_occlusion_volumes");
        settings.set("radius", radius);
        return settings;
    }
    static Settings cones(int voxelsAlong, int count, int steps) {
        Settings settings = neutral("voxel_ao");
        settings.set("voxels", voxelsAlong);
        settings.set("cones", count);
        settings.set("steps", steps);
        settings.set("blur", 0);
        return settings;
    }
};

constexpr double pi = std::numbers::pi;

double segment(double c) { return (std::acos(c) - c * std::sqrt(1 - c * c)) / pi; }

// Volumes. A wall of height h at distance d, unbounded: 1/2 (1 - d / sqrt(d^2 + h^2)).
TEST_F(ObjectLimits, VolumesBesideAWall) {
    for (const double distance : {0.05, 0.3, 1.0})
        for (const double height_ : {0.1, 0.7, 3.0}) {
            const double limit = 0.5 * (1 - distance / std::hypot(distance, height_));
            const Scene scene =
                corner(static_cast<float>(distance), static_cast<float>(height_), 0, 1000);
            EXPECT_NEAR(1 - open(scene, volumes(1000)), limit, 1e-3) << distance << " " << height_;
        }
}

// h^2 / (1 + h^2) in the middle of the floor.
TEST_F(ObjectLimits, VolumesInAWell) {
    for (const double height_ : {0.5, 1.0, 2.0})
        EXPECT_NEAR(1 - open(well(static_cast<float>(height_)), volumes(1000)),
                    height_ * height_ / (1 + height_ * height_), 2e-3)
            << height_;
}

// A ceiling, clipped by no tangent plane, from whichever side its material lets it be seen.
TEST_F(ObjectLimits, VolumesOccludeToTheFrontAndOfSheetsToTheBack) {
    // Below the middle of a strip of width w at height h: (w / 2) / sqrt(h^2 + w^2 / 4), sheet
    // A.1.7.
    const auto strip = [](bool faceUp, bool doubleSided) {
        Scene scene;
        addFloor(scene);
        const float z = 1000, y = 0.5f, x = faceUp ? 0.4f : -0.4f;
        addQuad(scene, {glm::vec3(-x, y, z), glm::vec3(x, y, z), glm::vec3(x, y, -z),
                        glm::vec3(-x, y, -z)});
        scene.materials[0].doubleSided = doubleSided;
        return scene;
    };
    const double limit = 0.4 / std::hypot(0.5, 0.4);
    const auto below = [](const Scene& scene) { // from aside, for the strip hides it from above
        return 1 - static_cast<double>(seenFrom({4, 2, 0}, scene, volumes(1000), 20).at(2, 2, 0));
    };
    EXPECT_NEAR(below(strip(false, false)), limit, 1e-3);
    EXPECT_NEAR(below(strip(true, true)), limit, 1e-3);
    EXPECT_NEAR(below(strip(true, false)), 0, 1e-3);
}

// (1 - d / R)^falloff, for all that lies in one plane.
TEST_F(ObjectLimits, VolumesFallOffWithTheHeightAboveTheirPlane) {
    for (const float distance : {0.1f, 0.5f, 0.9f}) {
        const Scene scene = corner(distance, 1);
        const auto occlusion = [&](double falloff) {
            Settings settings = volumes(1);
            settings.set("falloff", falloff);
            return 1 - open(scene, settings);
        };
        const double flat = occlusion(0);
        ASSERT_GT(flat, 0.01);
        for (const double falloff : {1.0, 2.5})
            EXPECT_NEAR(occlusion(falloff) / flat,
                        std::pow(1 - static_cast<double>(distance), falloff), 0.02)
                << distance << " " << falloff;
    }
    EXPECT_EQ(open(corner(1.01f, 1), volumes(1)), 1);
}

// A masked triangle counts by the share of it that is there: of a wall whose lower half is a hole,
// by similar triangles, a quarter of the one that stands on its tip and three of the other.
TEST_F(ObjectLimits, VolumesOfMaskedMaterialsCountByTheirCoverage) {
    Scene scene = corner(0.3f, 0.7f);
    scene.materials.push_back({}); // the floor's, which must be seen
    for (Vertex& vertex : scene.vertices)
        vertex.colour.a = vertex.position.y > 0 ? 1.0f : 0.0f;
    const auto occlusion = [&](std::uint32_t first, std::uint32_t count, float cutoff) {
        scene.meshes = {{0, 6, 1}, {first, count, 0}};
        scene.materials[0].alphaCutoff = cutoff;
        return 1 - open(scene, volumes(1000));
    };
    const double lower = occlusion(6, 3, 0), upper = occlusion(9, 3, 0);
    EXPECT_GT(lower, 0.05);
    EXPECT_GT(upper, 0.05);
    EXPECT_NEAR(occlusion(6, 6, 0.5f), lower / 4 + 3 * upper / 4, 0.005);
}

// Voxels. Their walls lie anywhere within them, so that errors are means over four of their places
// in the largest that these cones read, an eighth of the radius.
double wallError(double distance, const Settings& settings) {
    double sum = 0;
    for (int place = 0; place < 4; ++place) {
        const Scene scene = ObjectLimits::corner(static_cast<float>(distance), 1.1f,
                                                 static_cast<float>(place) / 32);
        sum += ObjectLimits::mean(scene, settings) / 4;
    }
    return 1 - sum - segment(distance);
}

// Seen from a corner's floor, I1 is seg(d / R).
TEST_F(ObjectLimits, ConesBesideAWall) {
    for (const double distance : {0.1, 0.3, 0.6})
        EXPECT_NEAR(wallError(distance, cones(64, 255, 128)), 0, 0.025) << distance;
}

// 1 - a^2 / min(a^2 + h^2, R^2), for a radius R of 1.5 wells.
TEST_F(ObjectLimits, ConesInAWell) {
    Settings settings = cones(64, 255, 128);
    settings.set("radius", 1.5);
    for (const double height_ : {0.4, 0.8, 2.0})
        EXPECT_NEAR(1 - mean(well(static_cast<float>(height_)), settings),
                    1 - 1 / std::min(1 + height_ * height_, 1.5 * 1.5), 0.04)
            << height_;
}

// What the limit is held to is less than what few cones through coarse voxels miss.
TEST_F(ObjectLimits, ConesConverge) {
    const auto error = [](const Settings& settings) {
        double sum = 0;
        for (const double distance : {0.1, 0.3, 0.6})
            sum += std::abs(wallError(distance, settings)) / 3;
        return sum;
    };
    EXPECT_GT(error(cones(4, 4, 3)), 0.03);
}

} // namespace
} // namespace obscura
