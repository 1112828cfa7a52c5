// What failure tests measure with, against what is known without them.
#include "base/error.h"
#include "bench/measure/tested_technique.h"
#include "bench/stability/failure_scenes.h"
#include "bench/stability/failure_view.h"
#include "bench/stability/rolled_view.h"
#include "bench/stability/stored_depth.h"
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

class FailureScenes : public GlTest {
  protected:
    static constexpr ImageSize size{192, 108};
    // Mean occlusion by ray tracing where the condition holds.
    static double traced(const Scene& scene, const Camera& camera,
                         const std::function<bool(const SeenPoint&)>& condition) {
        const FailureScene built(scene);
        const FailureView view(built, camera, size);
        return meanOcclusion(view.truth(), view.select(condition));
    }
};

TEST(CreaseFormula, IsTheSheets) {
    EXPECT_NEAR(occlusionInCrease(0), 0.5, 1e-9);
    EXPECT_NEAR(occlusionInCrease(0.25), 0.34252, 1e-5);
    EXPECT_NEAR(occlusionInCrease(0.75), 0.07215, 1e-5);
    EXPECT_EQ(occlusionInCrease(1.5), 0);
}

// One significant bit of 11, and z^2 / (near 2^24), both at 100 m (fact sheet, section C).
TEST(StoredDepth, HasTheStepsOfItsBits) {
    EXPECT_EQ(halfFloatDepth(100.07f), 100.0625f);
    EXPECT_EQ(halfFloatDepth(100.02f), 100.0f);
    const float step = fixedPointDepth(100.009f) - fixedPointDepth(100.003f);
    EXPECT_NEAR(std::abs(step), 0.006, 1e-4);
    EXPECT_NEAR(fixedPointDepth(3), 3, 1e-5);
    EXPECT_TRUE(std::isfinite(fixedPointDepth(1e9f)));
}

// No depth is rounded by more than half of what its format calls a step, nor are steps much larger
// than depths need.
TEST(StoredDepth, IsRoundedByHalfAStepAtMost) {
    for (const Probe::StoredDepth& stored : {halfFloatDepths(), fixedPointDepths()}) {
        float most = 0; // of half a step
        for (float depth = 0.5f; depth < 1500; depth *= 1.0007f) {
            const float step = depth * (stored.step.x + depth * stored.step.y);
            most = std::max(most, std::abs(stored.of(depth) - depth) / (step / 2));
        }
        EXPECT_LT(most, 1.01f);
        EXPECT_GT(most, 0.9f);
    }
}

TEST_F(FailureScenes, HiddenFaceOccludesAsTheClosedFormSays) {
    const double found = traced(curbScene(), curbCamera(), [](const SeenPoint& point) {
        return point.position.y < 0.01f && std::abs(point.position.x + 0.25f) < 0.03f;
    });
    EXPECT_NEAR(found, 0.3425, 0.01);
}

TEST_F(FailureScenes, FaceOfTheCurbIsNotSeen) {
    const FailureScene built(curbScene());
    const FailureView view(built, curbCamera(), size);
    for (const SeenPoint& point : view.points())
        EXPECT_TRUE(std::abs(point.position.y) < 0.01f || std::abs(point.position.y - 2) < 0.01f);
}

// Rays from below a rod within the radius meet its lower face: |x| <= k z and z >= h / R on the
// hemisphere, which in the unit disc is an ellipse cut by a circle.
TEST_F(FailureScenes, RodOccludesAsTheClosedFormSays) {
    const double h = static_cast<double>(rodHeight), k = static_cast<double>(rods[0].width) / 2 / h;
    const double circle = std::sqrt(1 - h * h);
    double area = 0;
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double y = circle * (2 * (i + 0.5) / steps - 1);
        area +=
            2 * circle / steps * 2 *
            std::min(k * std::sqrt((1 - y * y) / (1 + k * k)), std::sqrt(circle * circle - y * y));
    }
    const double found = traced(rodScene(), rodCamera(), [](const SeenPoint& point) {
        return point.position.y < 0.01f && std::abs(point.position.z - rods[0].z) < 0.025f;
    });
    EXPECT_NEAR(found, area / M_PI, 0.01);
}

TEST_F(FailureScenes, WallBehindThePoleIsOpen) {
    for (const double distance : {1.5, 10.0})
        EXPECT_NEAR(traced(poleScene(distance), poleCamera(distance),
                           [](const SeenPoint& point) { return point.position.z < 0.5f; }),
                    0, 1e-6);
}

TEST_F(FailureScenes, CameraSeesTheFloorAtTheAngleAskedFor) {
    const FailureScene built(floorScene());
    for (const double degrees : {0.0, 60.0, 85.0}) {
        const FailureView view(built, floorCamera(degrees, 10), size);
        const SeenPoint& middle = view.points()[static_cast<std::size_t>(53 * 192 + 96)];
        EXPECT_NEAR(static_cast<double>(middle.degrees), degrees, 0.5);
        EXPECT_NEAR(view.radiusPixels(), 108 / (2 * std::tan(M_PI / 6)) / 10, 0.01);
    }
}

// The direction of turning, and whether what is turned back is the same, shows in how many places
// of the world agree: nearly all, but at silhouettes.
TEST_F(FailureScenes, RolledViewsAreTurnedBack) {
    const FailureScene built(hallScene());
    const FailureView level(built, hallCamera(), size);
    const double disc = M_PI * 53 * 53;
    for (const double degrees : {30.0, 90.0}) {
        const RolledView rolled(built, level, hallCamera(), degrees);
        const double same =
            static_cast<double>(std::count(rolled.same().begin(), rolled.same().end(), true));
        EXPECT_GT(same, 0.75 * disc);
        Image across{size.width, size.height, 1, {}};
        for (const SeenPoint& point : rolled.view().points())
            across.pixels.push_back(point.position.x);
        Image expected = across;
        for (std::size_t i = 0; i < level.points().size(); ++i)
            expected.pixels[i] = level.points()[i].position.x;
        EXPECT_LT(difference(rolled.turnedBack(across), expected, rolled.same()).largest, 0.021);
    }
}

// A technique's own guard band and one that a test adds are the same pixels.
TEST_F(FailureScenes, PixelsBeyondTheBorderAreTheGuardBands) {
    const FailureScene built(hallScene());
    const FailureView view(built, hallCamera(), size);
    Settings wide(technique("sao")), narrow(technique("sao"));
    wide.set("guardBand", 0.25); // 27 pixels
    narrow.set("guardBand", 0);
    const Image expected = view.probe().visibility(wide);
    OcclusionPasses passes = view.probe().passesFor(narrow, 27);
    const Image found = view.probe().visibility(narrow, passes, 27);
    EXPECT_EQ(found.pixels, expected.pixels);
    EXPECT_NE(view.probe().visibility(narrow).pixels, expected.pixels);
}

TEST_F(FailureScenes, StoredDepthIsWhatTechniquesRead) {
    const FailureScene built(hallScene());
    const TestedTechnique hbao("hbao");
    const auto seen = [&](Probe::StoredDepth stored) {
        return hbao.visibility(FailureView(built, hallCamera(), size, std::move(stored)).probe());
    };
    const Image plain = seen({});
    EXPECT_EQ(seen({[](float depth) { return depth; }, {}}).pixels, plain.pixels);
    // At one depth all is a plane that faces the camera; normals still lean, so not all is open.
    const Image flat = seen({[](float) { return 5.0f; }, {}});
    EXPECT_NE(flat.pixels, plain.pixels);
}

// Rays start above their surface however coarse its depth: planes stay open, and a crease is nearly
// as dark as with 32 bits (half floats put starts up to a step before it, .06 R at 100 R).
TEST_F(FailureScenes, RaysKnowHowCoarseDepthIs) {
    const FailureScene built(creaseScene());
    const auto part = [](float low, float high) {
        return [=](const SeenPoint& point) {
            return between(std::max(point.position.x, point.position.y), static_cast<double>(low),
                           static_cast<double>(high));
        };
    };
    for (const char* configuration : {"rtao rays=16", "rtao_bvh rays=4"}) {
        const TestedTechnique technique(configuration);
        for (const double distance : {10.0, 100.0}) {
            double crease = -1; // of 32 bits
            for (const Probe::StoredDepth& stored :
                 {Probe::StoredDepth(), fixedPointDepths(), halfFloatDepths()}) {
                const FailureView view(built, creaseCamera(distance, 5.2), size, stored);
                const Image image = technique.visibility(view.probe());
                EXPECT_LT(meanOcclusion(image, view.select(part(1.5f, 2.2f))), 0.002)
                    << configuration << ", " << distance << " R, step " << stored.step.x;
                const double found = meanOcclusion(image, view.select(part(0.15f, 0.5f)));
                crease = crease < 0 ? found : crease;
                EXPECT_NEAR(found, crease, 0.03) << configuration << ", " << distance << " R";
            }
        }
    }
}

TEST(TestedTechniques, MistakesAreNamed) {
    const auto fault = [](const std::string& configuration) -> std::string {
        try {
            TestedTechnique{configuration};
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(fault("hbao steps=8 blur=0"), "");
    EXPECT_THAT(fault("hbau"), testing::HasSubstr("did you mean \"hbao\"?"));
    EXPECT_THAT(fault("hbao step=8"), testing::HasSubstr("steps"));
    EXPECT_THAT(fault("hbao steps=few"), testing::HasSubstr("expected hbao steps=NUMBER"));
    EXPECT_THAT(fault("hbao steps"), testing::HasSubstr("expected hbao NAME=NUMBER"));
    EXPECT_THAT(fault("hbao radius=2"), testing::HasSubstr("unit of length"));
    EXPECT_THAT(fault("ray_traced"), testing::HasSubstr("expected a technique of the screen"));
    EXPECT_THAT(fault(""), testing::HasSubstr("expected the id of a technique"));
}

} // namespace
} // namespace obscura
