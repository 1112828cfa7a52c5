// The test mode on a scene of few triangles: what is drawn when, and what is written.
#include "base/csv.h"
#include "base/files.h"
#include "gl/context.h"
#include "image/image.h"
#include "renderer/builtin/builtin.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "tests/renderer/scene/small_gltf.h"
#include "viewer/screenshot.h"
#include "viewer/technique_words.h"
#include "viewer/test_mode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using testing::HasSubstr;

// A floor and a wall, seen from two places.
TestPlan planIn(const test::Folder& folder) {
    const std::vector<float> corners = {-3, 0, 3,  3,  0, 3,  3,  0, -1, -3, 0, 3,
                                        3,  0, -1, -3, 0, -1, -3, 0, -1, 3,  0, -1,
                                        3,  3, -1, -3, 0, -1, 3,  3, -1, -3, 3, -1};
    writeFile(folder / "t.bin", trianglesBuffer(corners));
    writeFile(folder / "room.gltf", trianglesGltf(corners));
    TestPlan plan;
    for (const double x : {-1.0, 1.0}) {
        View view;
        view.name = x < 0 ? "left" : "right";
        view.file = "room.gltf";
        view.camera.position = {x, 1, 3};
        view.camera.target = {0, 0.5, -1};
        view.radius = 0.5;
        plan.cameras.push_back(view);
    }
    plan.techniques = {techniqueIn("none"), techniqueIn("crytek samples=8"), techniqueIn("hbao")};
    plan.level.sky = Sky{};
    plan.width = 64;
    plan.height = 36;
    plan.seconds = 0;
    plan.rounds = 2;
    plan.out = folder / "results";
    plan.scenes = folder.path();
    return plan;
}

TEST(TestModeTest, EveryTechniqueFromEveryCameraInEveryRound) {
    const test::Folder folder;
    const TestPlan plan = planIn(folder);
    double before = 0;
    int frames = 0;
    std::string last;
    const std::vector<TestRow> rows = runTest(plan, [&](double share, const std::string& now) {
        EXPECT_GE(share, before);
        before = share;
        ++frames;
        last = now;
        return true;
    });
    EXPECT_EQ(before, 1);
    EXPECT_EQ(frames, 2 * 6 * 3);
    EXPECT_THAT(last, HasSubstr("round 2 of 2: "));
    std::set<std::tuple<int, std::string, std::string>> seen;
    std::map<int, std::string> orders;
    for (const TestRow& row : rows) {
        seen.insert({row.round, row.camera, row.technique});
        orders[row.round] += row.camera + row.technique + " ";
        EXPECT_EQ(row.frames, 3);
        EXPECT_GT(row.gbufferMs, 0); // of each frame: nothing is kept from the one before
        EXPECT_GT(row.lightMs, 0);
        EXPECT_GE(row.seconds, 3e-3 * (row.gbufferMs + row.lightMs + row.techniqueMs()));
        EXPECT_EQ(row.passes.empty(), row.technique == "none");
    }
    EXPECT_EQ(seen.size(), 12u);
    EXPECT_EQ(rows.size(), 12u);
    EXPECT_NE(orders[1], orders[2]);

    EXPECT_EQ(splitCsv(readFile(plan.out / "test.csv")).size(), 13u);
    EXPECT_EQ(readFile(plan.out / "table.txt"), leedsTable(plan, rows));
    int pictures = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(plan.out))
        pictures += entry.path().extension() == ".png" || entry.path().extension() == ".exr";
    EXPECT_EQ(pictures, 2 * 6);
    const fs::path crytek = plan.out / "room-left_crytek_samples-8";
    const Image8 shown = readImage8(crytek.string() + ".png");
    EXPECT_EQ(shown.width, 64);
    const Image visibility =
        readExr(crytek.string() + "-visibility.exr", std::array{std::string("V")});
    const auto [least, most] =
        std::minmax_element(visibility.pixels.begin(), visibility.pixels.end());
    EXPECT_LT(*least, 0.9f);
    EXPECT_LE(*most, 1.0f);

    // What is there stays, whoever comes again.
    const std::string csv = readFile(plan.out / "test.csv");
    EXPECT_THAT(errorOf([&] { runTest(plan, [](double, const std::string&) { return true; }); }),
                HasSubstr("without results"));
    EXPECT_EQ(readFile(plan.out / "test.csv"), csv);

    // The same seed, the same orders; a test that is stopped keeps its whole rounds.
    TestPlan again = plan;
    again.out = folder / "again";
    frames = 0;
    const auto kept =
        runTest(again, [&](double, const std::string&) { return ++frames < 6 * 3 + 1; });
    std::string order;
    for (const TestRow& row : kept)
        order += row.camera + row.technique + " ";
    EXPECT_EQ(order, orders[1]);
    EXPECT_EQ(splitCsv(readFile(again.out / "test.csv")).size(), 7u);
}

TEST(TestModeTest, WhatCannotBeTestedIsSaidFirst) {
    const test::Folder folder;
    const auto error = [&](const auto& change) {
        TestPlan plan = planIn(folder);
        change(plan);
        return errorOf([&] { runTest(plan, [](double, const std::string&) { return true; }); });
    };
    EXPECT_THAT(error([](TestPlan& plan) { plan.techniques.push_back(techniqueIn("ray_traced")); }),
                HasSubstr("traces rays"));
    EXPECT_THAT(error([](TestPlan& plan) { plan.techniques.push_back(plan.techniques[0]); }),
                HasSubstr("\"none\" twice"));
    EXPECT_THAT(error([](TestPlan& plan) { plan.cameras.clear(); }), HasSubstr("camera"));
    EXPECT_FALSE(fs::exists(folder / "results"));
}

TEST(Screenshots, AreNamedBySettingsAndNeverReplaced) {
    const test::Folder folder;
    View view;
    view.builtin = "atrium";
    view.name = "Nave";
    view.radius = 0.5;
    Settings settings = settingsOf(techniqueIn("gtao low intensity=0.75"), 0.5);
    EXPECT_EQ(screenshotName(view, settings, Show::lit), "atrium-nave_gtao-low_intensity-0.75");
    EXPECT_EQ(screenshotName(view, settings, Show::occlusion),
              "atrium-nave_gtao-low_intensity-0.75_occlusion");
    view.name = std::string(400, 'x');
    EXPECT_LT(screenshotName(view, settings, Show::lit).size(), 200u);
    settings.set("intensity", 0.5);
    View other = view;
    other.name += "y";
    EXPECT_NE(screenshotName(view, settings, Show::lit),
              screenshotName(other, settings, Show::lit));

    const Image8 picture{2, 1, 3, {1, 2, 3, 4, 5, 6}};
    const Image visibility{2, 1, 1, {0.25f, 1}};
    writeFile(folder / "a-2-visibility.exr", "mine");
    EXPECT_EQ(writeScreenshot(folder.path(), "a", picture).png, folder / "a.png");
    const Screenshot second = writeScreenshot(folder.path(), "a", picture, visibility);
    EXPECT_EQ(second.png, folder / "a-3.png"); // 2 would have replaced what is mine
    EXPECT_EQ(readImage8(second.png).pixels, picture.pixels);
    EXPECT_EQ(readExr(second.exr, std::array{std::string("V")}).pixels, visibility.pixels);
    EXPECT_EQ(readFile(folder / "a-2-visibility.exr"), "mine");
}

} // namespace
} // namespace obscura
