// Each technique against its own limit of infinitely many samples, in closed form. Scenes are
// prisms along z, seen from straight above and so far away that rays are parallel to 0.4 degrees;
// the pixel column under test lies exactly on the edge, or at its distance from the wall.
#include "tests/renderer/occlusion_fixture.h"

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

constexpr float length = 50; // of the prisms, metres
constexpr int width = 513, height = 16;
constexpr double field = 2.6; // metres across the image

class Limits : public GlTest {
  protected:
    // A strip from (x0, y0) to (x1, y1) along z, facing up.
    static void addStrip(Scene& scene, float x0, float y0, float x1, float y1) {
        addQuad(scene, {glm::vec3(x0, y0, length), glm::vec3(x1, y1, length),
                        glm::vec3(x1, y1, -length), glm::vec3(x0, y0, -length)});
    }
    static Scene wedge(float slope) { // y = slope |x|
        Scene scene;
        addStrip(scene, -5, 5 * slope, 0, 0);
        addStrip(scene, 0, 0, 5, 5 * slope);
        return scene;
    }
    // A floor, and from x = `distance` on a step of that height.
    static Scene curb(float distance, float step) {
        Scene scene;
        addStrip(scene, -5, 0, distance, 0);
        addStrip(scene, distance, step, 5, step);
        return scene;
    }

    static Settings unfiltered(const char* id, int samples) {
        Settings settings(technique(id));
        settings.set("samples", samples);
        settings.set("radius", 1);
        settings.set("blur", 0);
        return settings;
    }

    // The mean of `f` of visibility over the column at x = 0, and over noise tiles of many seeds.
    template <typename Function>
    static double centre(const Scene& scene, const Settings& settings, Function f, int seeds) {
        Camera camera;
        camera.position = {0, 200, 0};
        camera.up = {0, 0, -1};
        camera.fovDegrees = 2 * std::atan(field / 2 * height / width / 200) * 180 / M_PI;
        double sum = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            const Image image = visibilityOf(scene, camera, settings, width, height,
                                             static_cast<std::uint64_t>(seed));
            for (int y = 0; y < height; ++y)
                sum += f(static_cast<double>(image.at(width / 2, y, 0)));
        }
        return sum / (height * seeds);
    }
    static double centre(const Scene& scene, const Settings& settings) {
        return centre(
            scene, settings, [](double v) { return v; }, 1);
    }

    // Crytek's boost undone: from A0^2 + A0 to A0.
    static double withoutBoost(double v) { return (std::sqrt(1 + 4 * v) - 1) / 2; }
    static double crytek(const Scene& scene) {
        return centre(scene, unfiltered("crytek", 1024), withoutBoost, 48);
    }
};

// Crytek: the open fraction of a ball, and only then the boost (sheet 1.1).

TEST_F(Limits, CrytekReadsThreeQuartersOnAPlane) {
    for (const int samples : {8, 24, 1024})
        EXPECT_NEAR(centre(wedge(0), unfiltered("crytek", samples)), 0.75, 1e-3) << samples;
}

TEST_F(Limits, CrytekBrightensAConvexEdgeToWhite) {
    EXPECT_NEAR(centre(wedge(-1), unfiltered("crytek", 1024)), 1, 1e-3);
}

TEST_F(Limits, CrytekInAConcaveEdgeIsAQuarterBeforeTheBoost) {
    EXPECT_NEAR(crytek(wedge(1)), 0.25, 0.01);
}

// Lengths run from e^-2.4 to 1 in equal ratios; of a sphere of radius L, (1 - d / L) / 4 lies
// within the step and above the floor. Its mean over L, with t = ln(1/d) / 2.4:
TEST_F(Limits, CrytekBesideAHighStep) {
    for (const double d : {0.15, 0.25, 0.5}) {
        const double t = std::log(1 / d) / 2.4;
        const double expected = 0.5 - 0.25 * (t - (1 - d) / 2.4);
        EXPECT_NEAR(crytek(curb(static_cast<float>(d), 2)), expected, 0.01) << d;
    }
}

// Blizzard as printed: the half-ball's |x| has density 3/2 (1 - x^2) whichever way the normal
// points, and a 45-degree groove rises by |x|. With power 1 the mean of 1 / (1 + (k |x|)^2) is

double grooveLimit(double k) {
    return 1.5 * ((1 / k + 1 / (k * k * k)) * std::atan(k) - 1 / (k * k));
}

Settings asPrinted(Settings settings) {
    settings.set("fullOcclusion", 0);
    settings.set("noOcclusion", 100);
    settings.set("attenuation", 0.35);
    settings.set("power", 1);
    return settings;
}

TEST_F(Limits, BlizzardIsOpenOnAPlaneAndAConvexEdge) {
    for (const float slope : {0.0f, -1.0f})
        EXPECT_NEAR(centre(wedge(slope), asPrinted(unfiltered("blizzard", 4096))), 1, 2e-3);
}

TEST_F(Limits, BlizzardInAGroove) {
    EXPECT_NEAR(centre(wedge(1), asPrinted(unfiltered("blizzard", 4096))), grooveLimit(1 / 0.35),
                0.01);
}

// Rule 2 upside down, the appendix' fault: the higher the step, the lighter its foot.
TEST_F(Limits, BlizzardAsPrintedForgetsHighSteps) {
    Settings settings = asPrinted(unfiltered("blizzard", 4096));
    settings.set("noOcclusion", 1.5);
    EXPECT_NEAR(centre(curb(0.25f, 2), settings), 1, 2e-3);
    EXPECT_LT(centre(curb(0.25f, 1.4f), settings), 0.75);
}

TEST_F(Limits, RayMarchingIsOpenOnAPlaneAndAConvexEdge) {
    for (const float slope : {0.0f, -1.0f})
        EXPECT_NEAR(centre(wedge(slope), asPrinted(unfiltered("ray_march", 1024))), 1, 2e-3);
}

// The first step already meets the side, a quarter of |x| nearer.
TEST_F(Limits, RayMarchingInAGrooveStopsAtTheFirstStep) {
    EXPECT_NEAR(centre(wedge(1), asPrinted(unfiltered("ray_march", 4096))),
                grooveLimit(1 / 0.35 / 4), 0.01);
}

// The corrected curve tests points of the half-ball against solid geometry.

Settings solid(Settings settings) {
    settings.set("fullUntil", 100);
    settings.set("noneFrom", 1000);
    settings.set("bias", 0);
    return settings;
}

TEST_F(Limits, CorrectedBlizzardIsOpenOnAConvexEdge) {
    EXPECT_NEAR(centre(wedge(-1), solid(unfiltered("blizzard_corrected", 4096))), 1, 0.01);
}

// Sheet A.3, row "hemisphere-volume points".
TEST_F(Limits, CorrectedBlizzardBesideACurb) {
    const struct {
        float distance, step;
        double occlusion;
    } cases[] = {
        {0.25f, 0.5f, 0.2310}, {0.5f, 0.5f, 0.1261}, {0.1f, 0.2f, 0.1290}, {0.25f, 2, 0.3166}};
    for (const auto& c : cases)
        EXPECT_NEAR(
            1 - centre(curb(c.distance, c.step), solid(unfiltered("blizzard_corrected", 4096))),
            c.occlusion, 0.01)
            << c.distance << " " << c.step;
}

} // namespace
} // namespace obscura
