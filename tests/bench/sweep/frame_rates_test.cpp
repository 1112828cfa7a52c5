#include "bench/sweep/frame_rates.h"
#include "renderer/techniques/settings.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

// As a row of the technique's defaults would be written.
SweepRow defaultRow(const std::string& id, int view) {
    SweepRow row;
    row.technique = id;
    row.configuration = id;
    for (const auto& [name, value] : Settings(technique(id)).named())
        row.settings += fmt::format("{}={} ", name, name == "radius" ? 0.77 : value);
    row.scene = "sponza";
    row.view = fmt::format("view {}", view);
    row.width = 1920;
    row.height = 1080;
    row.gbuffer = 2;
    row.total.median = view;
    return row;
}

TEST(FrameRates, AreThoseOfDefaultSettingsOnFourViews) {
    std::vector<SweepRow> rows;
    for (int view = 1; view <= 5; ++view) {
        rows.push_back(defaultRow("hbao", view));
        rows.push_back(defaultRow("starcraft", view));
        rows.back().settings = "samples=3";
        if (view != 2)
            rows.push_back(defaultRow("vao_plus_plus", view));
    }
    const auto all = frameRates(rows);
    ASSERT_THAT(all, SizeIs(1));
    EXPECT_THAT(all[0].views, ElementsAre("view 1", "view 2", "view 3", "view 4"));
    ASSERT_THAT(all[0].lines, SizeIs(2));
    EXPECT_EQ(all[0].lines[0].technique, "hbao");
    EXPECT_THAT(all[0].lines[0].milliseconds, ElementsAre(3, 4, 5, 6));
    EXPECT_TRUE(std::isnan(all[0].lines[1].milliseconds[1]));
}

TEST(FrameRates, AreOfOneGBufferPerView) {
    std::vector<SweepRow> rows = {defaultRow("hbao", 1), defaultRow("gtao", 1),
                                  defaultRow("starcraft", 1)};
    rows[0].gbuffer = 9; // another program ran, perhaps
    rows[2].settings = "samples=3";
    const auto all = frameRates(rows);
    ASSERT_THAT(all, SizeIs(1));
    for (const FrameRates::Line& line : all[0].lines)
        EXPECT_THAT(line.milliseconds, ElementsAre(3)) << line.technique;
}

TEST(FrameRates, DoNotTakeUnknownTechniquesForDefaults) {
    SweepRow row = defaultRow("hbao", 1);
    EXPECT_TRUE(hasDefaultSettings(row));
    row.technique = "<nobody's>";
    EXPECT_FALSE(hasDefaultSettings(row));
}

} // namespace
} // namespace obscura
