#include "base/error.h"
#include "bench/choose/choose.h"
#include "gl/context.h"
#include "renderer/builtin/builtin.h"
#include "renderer/found_cameras.h"
#include "renderer/reference/sight.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::HasSubstr;

// A scene says how large it is by what it shows: a hall wants a larger radius than a sculpture, and
// within it something is occluded and not everything.
TEST(Radius, FollowsTheScene) {
    const auto of = [](const char* name) {
        const Scene scene = builtinScene(name);
        return suggestedRadius(Sight(scene), RayTracer(scene), 4, 1);
    };
    const SuggestedRadius hall = of("atrium"), sculpture = of("sculpture");
    EXPECT_GE(hall.metres, 0.2); // studies of it have 0.5
    EXPECT_LE(hall.metres, 1);
    EXPECT_GE(sculpture.metres, 0.02);
    EXPECT_LT(sculpture.metres, hall.metres);
    EXPECT_THAT(hall.why, HasSubstr("4 cameras found in the scene see surfaces at a median depth"));
}

const std::string text = R"(name = "small"
seed = 7
reference = "cosine"
rays = 32
radii = [0.2]
train = ["front"]
test = ["left", "right"]
sizes = [[64, 36]]
frames = 3
seconds = 0.01
[scenes.front]
builtin = "sculpture"
camera = { position = [0.8, 0.9, 1.75], target = [0, 0.57, 0], fovDegrees = 38 }
[scenes.left]
builtin = "sculpture"
camera = { position = [-1.1, 0.8, 1.4], target = [0, 0.55, 0], fovDegrees = 38 }
[scenes.right]
builtin = "sculpture"
camera = { position = [1.3, 0.8, 1.2], target = [0, 0.55, 0], fovDegrees = 38 }
[techniques]
none = { technique = "none" }
starcraft = { technique = "starcraft", samples = 8, blur = 0 }
gtao = { technique = "gtao", preset = ["low", "ultra"] }
)";

class ChooseTest : public testing::Test {
  protected:
    Choice run(const Budget& budget) {
        return choose(study_, budget, {}, {folder_.path(), folder_ / "cache"}, context_.driver(),
                      [](double, double, const std::string&) {});
    }
    void theBestWithinATime();
    void triesUntilThreeFail();
    void whatCameNearestIsMeasured();
    static std::string chosenOf(const Choice& choice) {
        return choice.chosen ? choice.candidates[*choice.chosen].configuration.setting.name : "";
    }

    const test::Folder folder_;
    const gl::Context context_;
    SweepStudy study_ = parseSweepStudy(text, "small.toml");
};

// Of what was measured and is within the time none is better; with hardly any time, nothing but no
// occlusion is left.
void ChooseTest::theBestWithinATime() {
    Budget budget;
    budget.best = &measureNamed("rmse");
    budget.milliseconds = 1e6;
    const Choice choice = run(budget);
    ASSERT_TRUE(choice.chosen);
    const Candidate& chosen = choice.candidates[*choice.chosen];
    EXPECT_NE(chosenOf(choice), "none");
    for (const Candidate& candidate : choice.candidates)
        if (candidate.rung == Rung::held_out) {
            EXPECT_GE(candidate.rmse, chosen.rmse);
            EXPECT_EQ(candidate.verdict, "");
        }
    for (const std::size_t i : choice.alike) {
        EXPECT_EQ(choice.candidates[i].rung, Rung::held_out);
        EXPECT_NE(i, *choice.chosen);
    }
    budget.milliseconds = 1e-6;
    EXPECT_EQ(chosenOf(run(budget)), "none");
}

// Candidates are measured in the order of their errors on training views, until three have failed;
// the others are not tried, and only what was tried has results.
void ChooseTest::triesUntilThreeFail() {
    Budget budget;
    budget.flip = 1e-6; // what nothing meets, and a glance does not look at
    const Choice choice = run(budget);
    EXPECT_FALSE(choice.chosen);
    double worstTried = 0, bestLeft = 1e9;
    int tried = 0;
    for (const Candidate& candidate : choice.candidates) {
        EXPECT_NE(candidate.verdict, "");
        EXPECT_EQ(candidate.views.size(), candidate.rung == Rung::held_out ? 2u : 0u);
        EXPECT_EQ(std::isnan(candidate.milliseconds), candidate.views.empty());
        if (std::isnan(candidate.training))
            continue; // left out at a glance
        tried += candidate.rung == Rung::held_out;
        (candidate.rung == Rung::held_out ? worstTried : bestLeft) =
            candidate.rung == Rung::held_out ? std::max(worstTried, candidate.training)
                                             : std::min(bestLeft, candidate.training);
    }
    EXPECT_EQ(tried, 3);
    EXPECT_LE(worstTried, bestLeft);
}

// Far from any limit at a glance, what is nearest is measured all the same, so that it can be said
// how near it is.
void ChooseTest::whatCameNearestIsMeasured() {
    Budget budget;
    budget.rmse = 1e-4;
    const Choice choice = run(budget);
    EXPECT_FALSE(choice.chosen);
    const auto measured =
        std::count_if(choice.candidates.begin(), choice.candidates.end(),
                      [](const Candidate& candidate) { return candidate.rung == Rung::held_out; });
    EXPECT_EQ(measured, 3);
}

// One test, for what was fitted once is not fitted again.
TEST_F(ChooseTest, Races) {
    theBestWithinATime();
    triesUntilThreeFail();
    whatCameNearestIsMeasured();
}

TEST_F(ChooseTest, ALimitOnTheLitImageNeedsLight) {
    Budget budget;
    budget.jod = 9;
    EXPECT_THROW(run(budget), Error);
}

} // namespace
} // namespace obscura
