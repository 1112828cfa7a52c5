// StarCraft II in LearnOpenGL's form, Crytek's ShaderX7 listing, volumetric obscurance and VAO,
// each against its own limit of infinitely many samples.
#include "tests/renderer/techniques/limits_fixture.h"

namespace obscura {
namespace {

struct Curb {
    float distance, step;
    double occlusion;
};

class PointsLimits : public Limits {
  protected:
    static void expectOcclusion(std::span<const Curb> curbs, const Settings& settings,
                                double tolerance = 0.01) {
        for (const Curb& c : curbs)
            EXPECT_NEAR(1 - centre(curb(c.distance, c.step), settings), c.occlusion, tolerance)
                << settings.technique().id << " " << c.distance << " " << c.step;
    }
    // Line samples leave out taps outside the image, so the ball must lie within it. The middle
    // pixel of square images, over noise tiles of many seeds.
    static double middle(const Scene& scene, const Settings& settings, double height = 200) {
        constexpr int side = 257, tile = 4, seeds = 2;
        Camera camera;
        camera.position = {0, height, 0};
        camera.up = {0, 0, -1};
        camera.fovDegrees = 2 * std::atan(field / 2 / height) * 180 / M_PI;
        double sum = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            const Image image =
                visibilityOf(scene, camera, settings, side, side, static_cast<std::uint64_t>(seed));
            for (int y = 0; y < 4 * tile; ++y)
                sum += static_cast<double>(image.at(side / 2, side / 2 - 2 * tile + y, 0));
        }
        return sum / (4 * tile * seeds);
    }
    static void expectLineOcclusion(std::span<const Curb> curbs, const Settings& settings) {
        for (const Curb& c : curbs)
            EXPECT_NEAR(1 - middle(curb(c.distance, c.step), settings), c.occlusion, 0.01)
                << settings.technique().id << " " << c.distance << " " << c.step;
    }
    static Settings with(Settings settings, const char* name, double value) {
        settings.set(name, value);
        return settings;
    }
};

// StarCraft II. Without its range check by 20 million random points of the box kernel; sheet A.3
// rounds the same integral to 0.0520, 0.0076, 0.1057 and 0.0557.

constexpr double wallAtTenth = 0.1613; // of a wall without end

TEST_F(PointsLimits, StarcraftIsOpenOnAPlaneAndAConvexEdge) {
    for (const float slope : {0.0f, -1.0f})
        EXPECT_NEAR(centre(wedge(slope), unfiltered("starcraft", 1024)), 1, 2e-3);
}

TEST_F(PointsLimits, StarcraftBesideACurb) {
    const Curb curbs[] = {{0.25f, 0.5f, 0.0517}, {0.5f, 0.5f, 0.0088}, {0.1f, 0.2f, 0.1028}};
    expectOcclusion(curbs, with(unfiltered("starcraft", 1024), "bias", 0), 0.004);
}

// The check's weight is 1 up to a height of R, and falls slowly.
TEST_F(PointsLimits, StarcraftForgetsHighStepsSlowly) {
    const Curb curbs[] = {{0.25f, 2, 0.0559 * 0.5},
                          {0.1f, 1, wallAtTenth},
                          {0.1f, 1.5f, wallAtTenth * 0.7407},
                          {0.1f, 3, wallAtTenth * 0.2593}};
    expectOcclusion(curbs, with(unfiltered("starcraft", 1024), "bias", 0), 0.004);
}

// Crytek's listing: the ball is twice as long along the view, so steps count by half their height.
TEST_F(PointsLimits, CrytekShaderX7BesideACurb) {
    const auto withoutBoost = [](double v) { return (std::sqrt(1 + 4 * v) - 1) / 2; };
    const Curb curbs[] = {{0.25f, 0.5f, 1 - 0.4632},
                          {0.5f, 0.5f, 1 - 0.4894},
                          {0.1f, 0.2f, 1 - 0.4494},
                          {0.25f, 2, 1 - 0.4338}};
    for (const Curb& c : curbs)
        EXPECT_NEAR(1 - centre(curb(c.distance, c.step), unfiltered("crytek_shaderx7", 256),
                               withoutBoost, 8),
                    c.occlusion, 0.01)
            << c.distance << " " << c.step;
}

// What its range term is for: a block at half the depth of a wall leaves the wall as it is, where
// the thesis' form, whose term never engages, darkens it.
TEST_F(PointsLimits, CrytekShaderX7LeavesAFarWallAsItIs) {
    Scene scene;
    addQuad(scene, {glm::vec3(-20, -20, 0), glm::vec3(20, -20, 0), glm::vec3(20, 20, 0),
                    glm::vec3(-20, 20, 0)});
    addQuad(scene,
            {glm::vec3(-1, -1, 6), glm::vec3(1, -1, 6), glm::vec3(1, 1, 6), glm::vec3(-1, 1, 6)});
    Camera camera;
    camera.position = {0, 0, 12};
    const auto darkest = [&](const char* id) {
        const Image image = visibilityOf(scene, camera, Settings(technique(id)), 128, 128);
        float value = 1;
        for (int x = 88; x < 120; ++x) // beyond the silhouette and its blur
            value = std::min(value, image.at(x, 64, 0));
        return value;
    };
    EXPECT_NEAR(darkest("crytek_shaderx7"), 0.75, 0.02);
    EXPECT_LT(darkest("crytek"), 0.67);
}

// Volumetric obscurance: shares of a ball. Doubled or clipped, beside a step they are those of the
// half-ball (sheet A.3, row "hemisphere-volume points").

constexpr Curb halfBall[] = {
    {0.25f, 0.5f, 0.2310}, {0.5f, 0.5f, 0.1261}, {0.1f, 0.2f, 0.1290}, {0.25f, 2, 0.3164}};

TEST_F(PointsLimits, ObscuranceBesideACurb) {
    for (const int clip : {0, 1})
        expectLineOcclusion(halfBall,
                            with(unfiltered("volumetric_obscurance", 32), "clipByNormal", clip));
}

TEST_F(PointsLimits, ObscurancePointsBesideACurb) {
    for (const int clip : {0, 1})
        expectOcclusion(halfBall,
                        with(with(unfiltered("volumetric_obscurance_points", 1024), "bias", 0),
                             "clipByNormal", clip));
}

// The groove leaves a quarter of the ball open, which is half of the half above either side.
TEST_F(PointsLimits, ObscuranceOfAGrooveIsAHalfAndOfAConvexEdgeNothing) {
    for (const int clip : {0, 1}) {
        const Settings lines = with(unfiltered("volumetric_obscurance", 32), "clipByNormal", clip);
        EXPECT_NEAR(middle(wedge(1), lines), 0.5, 0.01) << clip;
        EXPECT_NEAR(middle(wedge(-1), lines), 1, 0.01) << clip;
        const Settings balls =
            with(with(unfiltered("volumetric_obscurance_points", 1024), "bias", 0), "clipByNormal",
                 clip);
        EXPECT_NEAR(centre(wedge(1), balls), 0.5, 0.01) << clip;
        EXPECT_NEAR(centre(wedge(-1), balls), 1, 0.01) << clip;
    }
}

// What clipping is for: at the rim of a drop a quarter of the ball is open below the floor, which
// makes up for what a wall closes.
TEST_F(PointsLimits, WithoutTheNormalADropHidesAWall) {
    Scene scene = curb(0.25f, 2);
    for (Vertex& vertex : scene.vertices)
        vertex.position.x = std::max(vertex.position.x, -0.01f);
    addStrip(scene, -5, -10, -0.01f, -10);
    const Settings settings = unfiltered("volumetric_obscurance", 32);
    EXPECT_NEAR(middle(scene, with(settings, "clipByNormal", 0)), 1, 1e-3);
    EXPECT_NEAR(middle(scene, with(settings, "clipByNormal", 1)), 1 - 0.3164, 0.01);
}

// One area: the model's own limit. Around the middle of 513 pixels the spline takes two texels, of
// 128 and of 256 pixels, which mix so that the variance per axis is that of the ball.
double areaLimit(const Curb& c) {
    const double pixels = 513 / 2.6, width = std::sqrt(0.6) * pixels / 128;
    const double mixing = (width * width - 1) / 3, edge = 256.5 + c.distance * pixels;
    const double nearer =
        (1 - mixing) * 0.5 * (384 - edge) / 128 + mixing * 0.5 * (512 - edge) / 256;
    const double mean = -nearer * c.step;
    const double spread = std::sqrt(3 * nearer * (1 - nearer)) * c.step;
    double open = 0;
    constexpr int steps = 1000;
    for (int i = 0; i < steps; ++i) {
        const double x = std::clamp(mean + spread * (2 * (i + 0.5) / steps - 1), -1.0, 1.0);
        open += (1 + x) * (1 + x) * (2 - x) / 4 / steps;
    }
    return 1 - std::min(2 * open, 1.0);
}

TEST_F(PointsLimits, ObscuranceAreaBesideACurb) {
    for (Curb c : halfBall) {
        c.occlusion = areaLimit(c);
        expectOcclusion({&c, 1}, neutral("volumetric_obscurance_area"), 0.003);
    }
}

TEST_F(PointsLimits, ObscuranceAreaIsOpenOnSlopesAndConvexEdges) {
    for (const float slope : {0.0f, -1.0f})
        EXPECT_NEAR(centre(wedge(slope), neutral("volumetric_obscurance_area")), 1, 2e-3);
    Scene slant; // its middle at the origin
    addStrip(slant, -5, -5, 5, 5);
    EXPECT_NEAR(centre(slant, neutral("volumetric_obscurance_area")), 1, 0.01);
}

// VAO: sheet A.3, and the cap (1 - 2 c)^2 (1 + c) beside a wall at 0.1. The sheet's row at d = 0.1.

TEST_F(PointsLimits, VaoBesideACurb) {
    const Curb curbs[] = {{0.25f, 0.5f, 0.0782},
                          {0.5f, 0.5f, 0},
                          {0.1f, 0.2f, 0.0310},
                          {0.25f, 2, 0.1564},
                          {0.1f, 2, 0.3520}};
    expectLineOcclusion(curbs, unfiltered("vao", 64));
}

TEST_F(PointsLimits, VaoIsOpenOnSlopesAndConvexEdges) {
    for (const float slope : {0.0f, -1.0f})
        EXPECT_NEAR(centre(wedge(slope), unfiltered("vao", 64)), 1, 2e-3);
    Scene slant;
    addStrip(slant, -5, -5, 5, 5);
    EXPECT_NEAR(centre(slant, unfiltered("vao", 64)), 1, 2e-3);
}

} // namespace
} // namespace obscura
