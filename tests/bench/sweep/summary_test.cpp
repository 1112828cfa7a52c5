#include "bench/sweep/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

SweepRow rowOf(const std::string& configuration, const std::string& view, double milliseconds) {
    SweepRow row;
    row.configuration = configuration;
    row.technique = configuration.substr(0, configuration.find(' '));
    row.scene = "atrium";
    row.view = view;
    row.width = 640;
    row.height = 360;
    row.frames = 200;
    row.total = {milliseconds, milliseconds - 1, milliseconds + 1};
    return row;
}

TEST(OverViews, TakesMediansOfTimesAndRootMeanSquaresOfRmse) {
    std::vector<SweepRow> rows = {rowOf("hbao", "c", 10), rowOf("hbao", "a", 2),
                                  rowOf("hbao", "b", 3), rowOf("hbao", "d", 5)};
    for (std::size_t i = 0; i < 4; ++i) {
        rows[i].matched = {i < 2 ? 1.0 : 7.0, i ? -0.5 : 0.5, 0.25 * static_cast<double>(i), 0.5};
        rows[i].litMatched.jod = 6 + static_cast<double>(i);
        rows[i].work[1] = rows[i].total.median / 2;
        rows[i].thumbnail = std::to_string(i);
    }
    const SweepRow point = overViews(rows);
    EXPECT_EQ(point.total.median, 4);
    EXPECT_EQ(point.total.low, 3);
    EXPECT_EQ(point.total.high, 5);
    EXPECT_EQ(point.work[1], 2);
    EXPECT_EQ(point.matched.rmse, 5);    // of 1, 1, 7, 7
    EXPECT_EQ(point.matched.bias, -0.5); // its size, whatever cancels out
    EXPECT_EQ(point.matched.ssim, 0.375);
    EXPECT_EQ(point.litMatched.jod, 7.5);
    EXPECT_EQ(point.frames, 800);
    EXPECT_EQ(point.view, "a, b, c, d");
    EXPECT_EQ(point.thumbnail, "0");
}

TEST(OverViews, DoesNotHideAViewThatWasNotMeasured) {
    std::vector<SweepRow> rows = {rowOf("hbao", "a", 1), rowOf("hbao", "b", 2)};
    rows[0].litRaw = rows[1].litRaw = {0.1, 0, 1, 0.1};
    rows[1].litRaw.flip = std::nan("");
    rows[0].toStarcraft = std::nan("");
    const SweepRow point = overViews(rows);
    EXPECT_TRUE(std::isnan(point.litRaw.flip));
    EXPECT_TRUE(std::isnan(point.toStarcraft));
    EXPECT_FALSE(std::isnan(point.litRaw.rmse));
}

TEST(AtTypicalSpeed, UndoesWhatSlowedWholeGroupsDown) {
    std::vector<SweepRow> rows = {rowOf("a", "1", 20), rowOf("b", "1", 12),   rowOf("c", "1", 8),
                                  rowOf("d", "1", 30), rowOf("none", "1", 0), rowOf("a", "2", 7)};
    const double starcraft[] = {20, 10, 10, 10, 15, 3.5}; // in the rounds of each
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].toStarcraft = rows[i].total.median / starcraft[i];
        rows[i].gbuffer = 4 * starcraft[i];
        rows[i].work[1] = rows[i].total.median / 2;
    }
    const std::vector<SweepRow> typical = atTypicalSpeed(rows);
    EXPECT_EQ(typical[0].total.median, 10); // measured while all took twice as long
    EXPECT_EQ(typical[0].total.low, 9.5);
    EXPECT_EQ(typical[0].work[1], 5);
    EXPECT_EQ(typical[0].gbuffer, 40);
    EXPECT_EQ(typical[0].toStarcraft, 1);
    EXPECT_EQ(typical[1].total.median, 12);
    EXPECT_EQ(typical[4].total.median, 0);
    EXPECT_EQ(typical[5].total.median, 7); // another view is another picture
    rows.pop_back();
    const std::vector<SweepGroup> groups = groupsOf(rows);
    std::vector<std::string> order;
    for (const SweepRow& point : groups[0].points)
        order.push_back(point.configuration);
    EXPECT_THAT(order, ElementsAre("none", "c", "a", "b", "d"));
}

TEST(Groups, HaveAPointForEachConfigurationByCost) {
    std::vector<SweepRow> rows = {rowOf("b", "1", 9),
                                  rowOf("a", "1", 4),
                                  rowOf("b", "2", 1),
                                  rowOf("a", "2", 4),
                                  rowOf("c", "1", std::nan("")),
                                  rowOf("c", "2", 1)};
    SweepRow small = rows[0], other = rows[0];
    small.height = 90;
    small.width = 160;
    other.scene = "a scene met later";
    rows.insert(rows.begin() + 1, {other, small});
    const std::vector<SweepGroup> groups = groupsOf(rows);
    ASSERT_EQ(groups.size(), 3u);
    EXPECT_EQ(groups[0].height, 90);
    EXPECT_EQ(groups[2].scene, "a scene met later");
    std::vector<std::string> names;
    for (const SweepRow& point : groups[1].points)
        names.push_back(point.configuration);
    EXPECT_THAT(names, ElementsAre("a", "b", "c"));
    EXPECT_THAT(lackingViews(groups[1]), IsEmpty());
    rows.push_back(rowOf("d", "2", 1));
    EXPECT_THAT(lackingViews(groupsOf(rows)[1]), ElementsAre("d"));
}

TEST(ErrorMeasures, BeginWithMatchedRmseAndAreBetterWhenLess) {
    SweepRow row = rowOf("a", "1", 1);
    row.matched = {0.1, -0.2, 0.9, 0.3};
    row.raw.bias = -0.25;
    row.depthMatched.flip = 0.4;
    row.litMatched.flip = 0.5;
    row.litMatched.jod = 9.25;
    std::vector<double> values;
    for (const ErrorMeasure& measure : errorMeasures())
        values.push_back(measure.of(row));
    ASSERT_EQ(values.size(), 12u);
    EXPECT_EQ(values[0], 0.1);
    EXPECT_EQ(values[2], 0.25);
    EXPECT_NEAR(values[3], 0.1, 1e-15);
    EXPECT_EQ(values[4], 0.3);
    EXPECT_EQ(values[5], 0.5);
    EXPECT_EQ(values[6], 0.75);
    EXPECT_EQ(values[11], 0.4);
}

TEST(Techniques, AreFoundByConfigurationAlsoWhereOnlyGrowthWasMeasured) {
    Sweep sweep;
    sweep.rows = {rowOf("sao samples=2", "1", 1), rowOf("hbao", "1", 1)};
    sweep.rows[1].name = "horizon";
    sweep.growth = {{"sao samples=9", "samples", 9, 1},
                    {"horizon steps=8", "radius", 9, 1},
                    {"gtao", "samples", 9, 1}};
    const auto places = techniquesByConfiguration(sweep);
    EXPECT_EQ(places.at("hbao"), 0u);
    EXPECT_EQ(places.at("sao samples=2"), 1u);
    EXPECT_EQ(places.at("sao samples=9"), 1u);
    EXPECT_EQ(places.at("horizon steps=8"), 0u);
    EXPECT_EQ(places.at("gtao"), 2u); // not in the sweep
}

TEST(SettingsIn, SplitsAtSpacesAndEqualSigns) {
    EXPECT_THAT(settingsIn("samples=8  blur=0.5 odd"),
                ElementsAre(testing::Pair("blur", "0.5"), testing::Pair("samples", "8")));
}

} // namespace
} // namespace obscura
