// Each technique of Jakobsen 2010 against its own limit of infinitely many samples.
#include "tests/renderer/techniques/limits_fixture.h"

namespace obscura {
namespace {

class AalborgLimits : public Limits {
  protected:
    // Crytek's boost undone: from A0^2 + A0 to A0.
    static double withoutBoost(double v) { return (std::sqrt(1 + 4 * v) - 1) / 2; }
    static double crytek(const Scene& scene) {
        return centre(scene, unfiltered("crytek", 1024), withoutBoost, 48);
    }
};

// Crytek: the open fraction of a ball, and only then the boost (sheet 1.1).

TEST_F(AalborgLimits, CrytekReadsThreeQuartersOnAPlane) {
    for (const int samples : {8, 24, 1024})
        EXPECT_NEAR(centre(wedge(0), unfiltered("crytek", samples)), 0.75, 1e-3) << samples;
}

TEST_F(AalborgLimits, CrytekBrightensAConvexEdgeToWhite) {
    EXPECT_NEAR(centre(wedge(-1), unfiltered("crytek", 1024)), 1, 1e-3);
}

TEST_F(AalborgLimits, CrytekInAConcaveEdgeIsAQuarterBeforeTheBoost) {
    EXPECT_NEAR(crytek(wedge(1)), 0.25, 0.01);
}

// Lengths run from e^-2.4 to 1 in equal ratios; of a sphere of radius L, (1 - d / L) / 4 lies
// within the step and above the floor. Its mean over L, with t = ln(1/d) / 2.4:
TEST_F(AalborgLimits, CrytekBesideAHighStep) {
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
    settings.set("accessibilityPower", 1);
    return settings;
}

TEST_F(AalborgLimits, BlizzardIsOpenOnAPlaneAndAConvexEdge) {
    for (const float slope : {0.0f, -1.0f})
        EXPECT_NEAR(centre(wedge(slope), asPrinted(unfiltered("blizzard", 4096))), 1, 2e-3);
}

TEST_F(AalborgLimits, BlizzardInAGroove) {
    EXPECT_NEAR(centre(wedge(1), asPrinted(unfiltered("blizzard", 4096))), grooveLimit(1 / 0.35),
                0.01);
}

// Rule 2 upside down, the appendix' fault: the higher the step, the lighter its foot.
TEST_F(AalborgLimits, BlizzardAsPrintedForgetsHighSteps) {
    Settings settings = asPrinted(unfiltered("blizzard", 4096));
    settings.set("noOcclusion", 1.5);
    EXPECT_NEAR(centre(curb(0.25f, 2), settings), 1, 2e-3);
    EXPECT_LT(centre(curb(0.25f, 1.4f), settings), 0.75);
}

TEST_F(AalborgLimits, RayMarchingIsOpenOnAPlaneAndAConvexEdge) {
    for (const float slope : {0.0f, -1.0f})
        EXPECT_NEAR(centre(wedge(slope), asPrinted(unfiltered("ray_march", 1024))), 1, 2e-3);
}

// The first step already meets the side, a quarter of |x| nearer.
TEST_F(AalborgLimits, RayMarchingInAGrooveStopsAtTheFirstStep) {
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

TEST_F(AalborgLimits, CorrectedBlizzardIsOpenOnAConvexEdge) {
    EXPECT_NEAR(centre(wedge(-1), solid(unfiltered("blizzard_corrected", 4096))), 1, 0.01);
}

// Sheet A.3, row "hemisphere-volume points".
TEST_F(AalborgLimits, CorrectedBlizzardBesideACurb) {
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
