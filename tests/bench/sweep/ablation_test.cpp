#include "bench/sweep/ablation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

SweepRow vaoRow(const std::string& settings, double milliseconds, int width = 1920) {
    SweepRow row;
    row.configuration = "vao_plus_plus " + settings;
    row.technique = "vao_plus_plus";
    row.settings = settings;
    row.scene = "sponza";
    row.view = "nave";
    row.width = width;
    row.height = width * 9 / 16;
    row.total.median = milliseconds;
    return row;
}

std::string settingsOf(int samples, int adaptive, int culling, const std::string& rest = "blur=1") {
    return fmt::format("samples={} radius=0.5 adaptive={} culling={} {}", samples, adaptive,
                       culling, rest);
}

// The paper's own numbers as rows give the paper's table.
TEST(Ablation, TellsTheVariantsApart) {
    const AblationTable& paper = publishedAblation();
    std::vector<SweepRow> rows;
    for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t s = 0; s < 5; ++s)
            for (int v = 0; v < 4; ++v)
                rows.push_back(vaoRow(settingsOf(ablationSamples[s], v & 1, v & 2),
                                      paper.columns[c].milliseconds[s][static_cast<std::size_t>(v)],
                                      c ? 3840 : 1920));
    const auto tables = ablationTables(groupsOf(rows));
    ASSERT_THAT(tables, SizeIs(1));
    EXPECT_EQ(tables[0].scene, "sponza");
    EXPECT_EQ(tables[0].settings, "blur=1 radius=0.5; culling=2 where it is on");
    ASSERT_THAT(tables[0].columns, SizeIs(2));
    for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_EQ(tables[0].columns[c].title, paper.columns[c].title);
        EXPECT_EQ(tables[0].columns[c].milliseconds, paper.columns[c].milliseconds);
    }
}

// Ratios that the paper prints beside its milliseconds, in per cent; both are rounded.
TEST(Ablation, HoldsThePapersTable) {
    const double printed[2][5][3] = {
        {{115, 135, 143}, {99, 111, 110}, {83, 89, 78}, {70, 76, 59}, {61, 67, 46}},
        {{114, 133, 141}, {96, 106, 104}, {80, 84, 72}, {65, 68, 52}, {58, 61, 41}}};
    for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t s = 0; s < 5; ++s)
            for (std::size_t v = 0; v < 3; ++v) {
                const auto& line = publishedAblation().columns[c].milliseconds[s];
                EXPECT_NEAR(100 * line[v + 1] / line[0], printed[c][s][v], 1.0);
            }
}

TEST(Ablation, ComparesOnlyWhatIsOtherwiseEqual) {
    const auto tables = ablationTables(groupsOf({
        vaoRow(settingsOf(8, 0, 0), 4),
        vaoRow(settingsOf(8, 1, 0), 3),
        vaoRow(settingsOf(8, 0, 1), 2),
        vaoRow(settingsOf(8, 0, 2), 1),
        vaoRow(settingsOf(8, 1, 1, "blur=2"), 9),
        vaoRow(settingsOf(7, 1, 1), 9),
        vaoRow(settingsOf(16, 0, 0, "blur=0"), 9),
    }));
    ASSERT_THAT(tables, SizeIs(2)); // culling 1 and 2; of the other blurs nothing is comparable
    const auto& greedy = tables[0].columns[0].milliseconds[2];
    EXPECT_EQ(greedy[0], 4);
    EXPECT_EQ(greedy[1], 3);
    EXPECT_EQ(greedy[2], 2);
    EXPECT_TRUE(std::isnan(greedy[3]));
    EXPECT_EQ(tables[1].columns[0].milliseconds[2][2], 1);
    EXPECT_TRUE(std::isnan(tables[1].columns[0].milliseconds[3][0]));
}

TEST(Ablation, HasTheOlderTechniqueBesideIt) {
    std::vector<SweepRow> rows{vaoRow(settingsOf(8, 0, 0), 4), vaoRow(settingsOf(8, 1, 2), 3)};
    for (const int blur : {0, 1}) { // VAO++ has 1
        rows.push_back(vaoRow(fmt::format("samples=8 radius=0.5 own=3 blur={}", blur), 6 + blur));
        rows.back().technique = "vao";
        rows.back().configuration = fmt::format("vao blur={}", blur);
    }
    const auto tables = ablationTables(groupsOf(rows));
    const auto& column = tables[0].columns[0];
    EXPECT_EQ(column.vao[2], 7);
    EXPECT_TRUE(std::isnan(column.vao[3]));
}

TEST(Ablation, NeedsMoreThanOneVariant) {
    EXPECT_THAT(ablationTables(groupsOf({vaoRow(settingsOf(8, 0, 0), 4)})), IsEmpty());
    EXPECT_THAT(ablationTables(groupsOf({vaoRow(settingsOf(8, 1, 2), 4)})), IsEmpty());
}

TEST(Ablation, IsNotDrawnWithoutTimes) {
    std::vector<SweepRow> rows;
    for (int v = 0; v < 4; ++v)
        for (const int width : {1920, 3840})
            rows.push_back(
                vaoRow(settingsOf(8, v & 1, v & 2), width == 1920 ? std::nan("") : v + 1, width));
    auto tables = ablationTables(groupsOf(rows));
    ASSERT_THAT(tables, SizeIs(1));
    EXPECT_THAT(ablationText(tables[0]), HasSubstr("1920×1080"));
    const std::string script = ablationFigure(tables[0], 1).script;
    EXPECT_THAT(script, HasSubstr("3840×2160"));
    EXPECT_THAT(script, testing::Not(HasSubstr("1920×1080")));
    tables[0].columns.resize(1);
    EXPECT_EQ(ablationFigure(tables[0], 1).script, "");
}

TEST(Ablation, IsWrittenWithThePapersOwnCells) {
    const auto tables =
        ablationTables(groupsOf({vaoRow(settingsOf(8, 0, 0), 4), vaoRow(settingsOf(8, 1, 0), 3)}));
    ASSERT_THAT(tables, SizeIs(1));
    const std::string csv = ablationCsv(tables);
    EXPECT_THAT(csv, HasSubstr("sponza,blur=1 radius=0.5,1920×1080,8,adaptive,3,75,"));
    EXPECT_THAT(csv, HasSubstr("sponza,blur=1 radius=0.5,1920×1080,16,plain,,,"));
    EXPECT_THAT(csv, HasSubstr("GTX 970 (paper),,3840×2160,32,both,9.77,41.2062,\n"));
    EXPECT_THAT(ablationText(tables[0]), HasSubstr("3 ( 75 %)"));
    EXPECT_THAT(ablationFigure(tables[0], 1).script, HasSubstr("set title '1920×1080'"));
}

} // namespace
} // namespace obscura
