#include "bench/sweep/cost_growth.h"
#include "renderer/builtin/builtin.h"
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

namespace obscura {
namespace {

using testing::ElementsAre;

class CostGrowth : public GlTest {};

// A pole 4 cm wide covers two silhouettes of all columns that 60 degrees see.
TEST_F(CostGrowth, PolesAddSilhouettes) {
    const auto share = [](int poles) {
        const Subject field(poleField(poles));
        return silhouettes(
            Probe(field, poleFieldCamera(), 192, 108, Normals::smooth, 1).surfaces());
    };
    EXPECT_EQ(share(0), 0);
    EXPECT_NEAR(share(1), 2.0 / 191, 1e-6);
    EXPECT_GT(share(8), 3 * share(1));
    EXPECT_GT(share(64), share(8));
}

TEST_F(CostGrowth, VariesOneThingAtATime) {
    GrowthPlan plan;
    plan.radii = {0.1, 0.4};
    plan.sizes = {{32, 18}, {64, 36}};
    plan.poles = {0, 64};
    for (const double samples : {4.0, 8.0, 16.0})
        plan.techniques.push_back({fmt::format("starcraft samples={}", samples),
                                   "starcraft",
                                   {{"samples", samples, {}}},
                                   {}});
    plan.techniques.push_back({"vao", "vao", {}, {}});
    View view;
    view.radius = 0.2;
    view.camera.position = {0.8f, 0.9f, 1.75f};
    view.camera.target = {0, 0.57f, 0};
    TimingPlan timing;
    timing.frames = 3;
    timing.seconds = 0.01;
    int steps = 0;
    const auto rows = costGrowth(plan, view, Subject(builtinScene("sculpture")), Normals::smooth,
                                 timing, [&] { ++steps; });
    EXPECT_EQ(steps, growthSteps(plan));

    std::map<std::string, std::map<std::string, std::vector<double>>> values;
    for (const GrowthRow& row : rows) {
        EXPECT_GT(row.milliseconds, 0);
        values[row.axis][row.configuration].push_back(row.value);
    }
    EXPECT_THAT(values["samples"]["starcraft"], ElementsAre(4, 8, 16));
    EXPECT_THAT(values["samples"]["vao"], ElementsAre(1));
    ASSERT_EQ(values.size(), 4u);
    values.erase("samples");
    for (auto& [axis, byConfiguration] : values) { // the middle variant stands for the technique
        EXPECT_EQ(byConfiguration.size(), 2u) << axis;
        EXPECT_EQ(byConfiguration["starcraft samples=8"], byConfiguration["vao"]) << axis;
    }
    EXPECT_THAT(values["radius"]["vao"], ElementsAre(0.1, 0.4));
    EXPECT_THAT(values["pixels"]["vao"], ElementsAre(32 * 18 * 1e-6, 64 * 36 * 1e-6));
    EXPECT_EQ(values["silhouettes"]["vao"][0], 0);
    EXPECT_GT(values["silhouettes"]["vao"][1], 0);
}

} // namespace
} // namespace obscura
