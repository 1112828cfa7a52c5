#include "base/csv.h"
#include "tests/error_of.h"
#include "viewer/command_line.h"
#include "viewer/technique_words.h"
#include "viewer/test_results.h"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Four cameras and the thesis' techniques, at its frame rates (Table 1), halves of which were
// measured above and halves below them.
const std::array<std::array<double, 4>, 4> thesis = {{{224.427, 230.479, 226.296, 234.366},
                                                      {228.891, 229.843, 221.018, 232.881},
                                                      {229.905, 232.405, 224.570, 234.586},
                                                      {228.823, 228.943, 224.301, 236.112}}};

TestPlan thesisPlan() {
    TestPlan plan;
    for (const char* name : {"1", "2", "3", "4"}) {
        View view;
        view.name = name;
        view.file = "sponza, \"new\".gltf";
        plan.cameras.push_back(view);
    }
    for (const char* words : {"starcraft", "hbao", "alchemy", "none"})
        plan.techniques.push_back(techniqueIn(words));
    plan.rounds = 2;
    return plan;
}

std::vector<TestRow> thesisRows(const TestPlan& plan) {
    std::vector<TestRow> rows;
    for (int round = 1; round <= 2; ++round)
        for (std::size_t c = 4; c-- > 0;)
            for (std::size_t t = 0; t < 4; ++t) {
                const double fps = thesis[c][t] + (round == 1 ? 3 : -3);
                rows.push_back({round,
                                static_cast<int>(rows.size() % 16) + 1,
                                plan.cameras[c].name,
                                plan.techniques[t].name,
                                1000,
                                1000 / fps,
                                1.5,
                                0.5,
                                {{"gather", Work::gather, 2},
                                 {"blur", Work::filter, 0.25},
                                 {"blurDown", Work::filter, 0.5}}});
            }
    return rows;
}

TEST(TestResults, TheTableIsThatOfTheThesis) {
    const TestPlan plan = thesisPlan();
    std::istringstream table(leedsTable(plan, thesisRows(plan)));
    std::string line;
    std::getline(table, line);
    EXPECT_THAT(line, testing::ContainsRegex("Camera +starcraft \\(average FPS\\) +hbao .* +none"));
    for (int row = 0; row < 5; ++row) {
        std::string camera;
        std::array<double, 4> fps{};
        table >> camera >> fps[0] >> fps[1] >> fps[2] >> fps[3];
        EXPECT_EQ(camera, row < 4 ? std::to_string(row + 1) : "Average");
        const std::array<double, 4> average{228.011, 230.418, 224.046, 234.486};
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(fps[i], row < 4 ? thesis[static_cast<std::size_t>(row)][i] : average[i],
                        0.0011); // the thesis cuts where we round
    }
    EXPECT_THAT(leedsTable(plan, {}), HasSubstr("no results"));
}

TEST(TestResults, RowsAreCsv) {
    const TestPlan plan = thesisPlan();
    const TestMachine machine{"llvmpipe (LLVM 15, 256 bits)", "a \"processor\"", "finish",
                              "obscura 0.1.0 (abc)"};
    const auto records = splitCsv(testCsv(plan, machine, thesisRows(plan)));
    ASSERT_EQ(records.size(), 33u);
    std::map<std::string, std::string> first;
    for (std::size_t i = 0; i < records[0].cells.size(); ++i)
        first[records[0].cells[i]] = records[1].cells.at(i);
    for (const CsvRecord& record : records)
        EXPECT_EQ(faultOf(record, records[0].cells.size()), "");
    EXPECT_EQ(first["scene"], "sponza, \"new\".gltf");
    EXPECT_EQ(first["camera"], "4");
    EXPECT_EQ(first["settings"], "{ technique = \"starcraft\" }");
    EXPECT_EQ(first["mean_fps"], "231.8230");
    EXPECT_EQ(first["technique_ms"], "2.7500");
    EXPECT_EQ(first["gather_ms"], "2.0000");
    EXPECT_EQ(first["filter_ms"], "0.7500");
    EXPECT_EQ(first["upsample_ms"], "0.0000");
    EXPECT_EQ(first["renderer"], machine.renderer);
    EXPECT_EQ(first["processor"], machine.processor);
    const auto passes = splitCsv(passesCsv(thesisRows(plan)));
    EXPECT_EQ(passes.size(), 1u + 32 * 3);
    EXPECT_THAT(passes[2].cells, ElementsAre("1", "4", "starcraft", "blur", "filter", "0.2500"));
}

CommandLine parsed(std::vector<std::string> words) {
    words.insert(words.begin(), "obscura-view");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    CLI::App app;
    return parseCommandLine(app, static_cast<int>(arguments.size()), arguments.data());
}

std::vector<std::string> namesOf(const std::vector<TechniqueSetting>& techniques) {
    std::vector<std::string> names;
    for (const TechniqueSetting& each : techniques)
        names.push_back(each.name);
    return names;
}

TEST(CommandLine, ShowsTheAtriumUnlessTold) {
    const CommandLine line = parsed({});
    EXPECT_EQ(line.scene.builtin, "atrium");
    EXPECT_EQ(line.level.name, "moderate");
    EXPECT_THAT(namesOf(line.techniques), ElementsAre("none", "gtao"));
    EXPECT_FALSE(line.camera);
    EXPECT_THAT(namesOf(parsed({"--test"}).techniques),
                ElementsAre("starcraft", "hbao", "alchemy", "none"));
}

TEST(CommandLine, AProtocolSaysAllOfItsCondition) {
    const std::string file = OBSCURA_SOURCE "/protocols/demo.toml";
    const CommandLine line = parsed({"--protocol", file, "--condition", "figures-high"});
    EXPECT_EQ(line.scene.builtin, "figures");
    EXPECT_EQ(line.camera->fovDegrees, 33);
    EXPECT_EQ(line.radius, 0.2);
    EXPECT_EQ(line.exposure, 0.5);
    EXPECT_EQ(line.level.name, "high");
    EXPECT_THAT(namesOf(line.techniques), ElementsAre("none", "blizzard24"));
    EXPECT_EQ(line.views.size(), 1u);
    const CommandLine other = parsed({"--protocol", file, "sculpture", "--level", "low",
                                      "--techniques", "crytek24,gtao high", "--exposure", "-1",
                                      "--size", "800x600", "--layout", "side-by-side"});
    EXPECT_EQ(other.scene.builtin, "sculpture");
    EXPECT_FALSE(other.camera);
    EXPECT_TRUE(other.level.ambient);
    EXPECT_THAT(namesOf(other.techniques), ElementsAre("crytek24", "gtao-high"));
    EXPECT_EQ(other.exposure, -1);
    EXPECT_EQ(other.height, 600);
    EXPECT_EQ(other.layout, Layout::sideBySide);
}

TEST(CommandLine, ATestHasEveryViewAndTechniqueOfItsProtocol) {
    const std::string file = OBSCURA_SOURCE "/protocols/ladder.toml";
    const CommandLine all = parsed({"--test", "--protocol", file, "--radius", "0.3"});
    EXPECT_EQ(all.views.size(), 2u);
    EXPECT_EQ(all.views[1].radius, 0.3);
    EXPECT_EQ(all.views[1].exposure, 0.5);
    EXPECT_THAT(namesOf(all.techniques),
                ElementsAre("none", "cheap", "fair")); // rays take no frame
    EXPECT_EQ(parsed({"--test", "--protocol", file, "--condition", "figures-sky-none-fair"})
                  .views.at(0)
                  .builtin,
              "figures");
    EXPECT_TRUE(parsed({"--test", "--protocol", file, "--camera", "0", "1", "2", "0", "1", "0"})
                    .views.empty());
}

TEST(CommandLine, SaysWhatIsWrong) {
    using test::errorOf;
    EXPECT_THAT(errorOf([] { parsed({"nowhere.gltf"}); }), HasSubstr("\"nowhere.gltf\""));
    EXPECT_THAT(errorOf([] { parsed({"--techniques", "none,gtap"}); }), HasSubstr("gtao"));
    EXPECT_THAT(errorOf([] {
                    parsed({"--techniques", "none,none,none,none,none"});
                }),
                HasSubstr("one to four"));
    EXPECT_THAT(errorOf([] { parsed({"--size", "1280"}); }), HasSubstr("WIDTHxHEIGHT"));
    EXPECT_THAT(errorOf([] {
                    parsed({"--camera", "0", "1", "0", "0", "2", "0"});
                }),
                HasSubstr("--camera: expected a target"));
    EXPECT_THAT(
        errorOf([] {
            parsed({"--protocol", OBSCURA_SOURCE "/protocols/demo.toml", "--condition", "x"});
        }),
        HasSubstr("no condition \"x\""));
}

} // namespace
} // namespace obscura
