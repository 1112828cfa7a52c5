#include "base/error.h"
#include "base/files.h"
#include "bench/choose/choose.h"
#include "bench/choose/report.h"
#include "bench/measure/timing.h"
#include "bench/sweep/files.h"
#include "bench/sweep/merge.h"
#include "gl/context.h"
#include "renderer/builtin/builtin.h"
#include "renderer/found_cameras.h"
#include "renderer/reference/sight.h"
#include "tests/error_of.h"
#include "tests/foreign_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace obscura {
namespace {

namespace fs = std::filesystem;

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
[light]
sky = {}
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
starcraft = { technique = "starcraft", samples = [64], blur = 0 }
gtao = { technique = "gtao", preset = "ultra" }
)";

class SweepTest : public testing::Test {
  protected:
    SweepTest() {
        fs::remove_all(folder_);
        for (const char* folder : {"", "1", "2", "whole", "choice"})
            foreign_.emplace_back(folder_ / folder);
    }
    void TearDown() override { // whatever was done
        for (const test::ForeignFiles& foreign : foreign_)
            EXPECT_EQ(foreign.lost(), "");
    }
    ~SweepTest() override { fs::remove_all(folder_); }

    Sweep run(const std::string& part) {
        SweepPlan plan{folder_ / part.substr(0, 1), folder_ / "cache"};
        plan.share.part = part[0] - '0';
        plan.share.parts = part[2] - '0';
        return sweep(study_, {}, plan, context_.driver(),
                     [&](double, double, const std::string&) { ++reports_; });
    }

    const fs::path folder_ =
        fs::temp_directory_path() /
        (std::string("obscura-") +
         testing::UnitTest::GetInstance()->current_test_info()->name()); // tests run side by side
    const gl::Context context_;
    const SweepStudy study_ = parseSweepStudy(text, "small.toml");
    int reports_ = 0;
    std::vector<test::ForeignFiles> foreign_;
};

const SweepRow& rowOf(const Sweep& sweep, const std::string& configuration) {
    for (const SweepRow& row : sweep.rows)
        if (row.configuration == configuration)
            return row;
    throw Error("no row of " + configuration);
}

std::string spelt(const SweepRow& row) { return sweepCsv({row}); }

const std::string& nameOf(const Choice& choice, std::size_t candidate) {
    return choice.candidates[candidate].configuration.setting.name;
}

// The least budget of matched RMSE that a configuration meets.
double leastBudget(const Sweep& sweep, const std::string& configuration) {
    std::vector<double> values;
    for (const SweepRow& row : sweep.rows)
        if (row.configuration == configuration)
            values.push_back(row.matched.rmse);
    return upperBound(values);
}

TEST_F(SweepTest, MeasuresEveryConfigurationOnceAndChooses) {
    const Sweep odd = run("1/2"), even = run("2/2");
    const Sweep first = mergeSweeps({folder_ / "1", folder_ / "2"}, folder_ / "whole");
    ASSERT_EQ(first.rows.size(), 6u); // 3 configurations, 2 views
    // Errors of a configuration on both views and another's on one; times of all on one view.
    ASSERT_EQ(odd.rows.size(), 4u);
    EXPECT_EQ(incompleteness(first), "");
    EXPECT_THAT(incompleteness(odd), testing::HasSubstr("4 of the study's 6 rows"));
    EXPECT_THAT(incompleteness(odd), testing::HasSubstr("1 of 4 rows have no errors"));
    EXPECT_THAT(incompleteness(odd), testing::HasSubstr("1 of 4 rows have no times"));
    const SweepRow &none = rowOf(first, "none"), &gtao = rowOf(first, "gtao"),
                   &many = rowOf(first, "starcraft samples=64");
    // Nothing costs nothing, and is off by the truth's own occlusion everywhere.
    EXPECT_EQ(none.total.median, 0);
    EXPECT_EQ(none.fetches, 0);
    EXPECT_LT(none.raw.bias, 0);
    EXPECT_EQ(none.raw.rmse, none.matched.rmse);
    EXPECT_LT(gtao.matched.rmse, none.matched.rmse);
    EXPECT_LE(many.matched.rmse, many.raw.rmse + 0.02); // fitted, though on another view
    EXPECT_GT(many.total.median, 0);
    EXPECT_NEAR(many.toGbuffer, many.total.median / many.gbuffer, 1e-9);
    EXPECT_GT(many.starcraftRepeat, 0);
    EXPECT_LT(gtao.litMatched.rmse, gtao.matched.rmse); // half of the light is not occluded so much
    EXPECT_LT(none.litRaw.jod, gtao.litMatched.jod);
    EXPECT_LT(gtao.litMatched.jod, 10);
    EXPECT_TRUE(std::isnan(gtao.matched.jod));
    EXPECT_EQ(first.machine.display, inWords(displays().front()));
    for (const char* file : {"sweep.csv", "sweep.json", "sweep.html"})
        EXPECT_TRUE(fs::exists(folder_ / "1" / file)) << file;
    EXPECT_TRUE(fs::exists(folder_ / "whole" / gtao.thumbnail));

    // What has been measured is not measured again: times stay what they were.
    const Sweep again = run("1/2");
    ASSERT_EQ(again.rows.size(), odd.rows.size());
    for (std::size_t i = 0; i < odd.rows.size(); ++i)
        EXPECT_EQ(spelt(again.rows[i]), spelt(odd.rows[i]));

    // The race gives the answer that measuring everything gives.
    Budget loose, strict, paid, impossible;
    loose.rmse = 1;
    strict.rmse = 1.001 * leastBudget(first, "gtao");               // what no other meets
    paid.rmse = 1.001 * leastBudget(first, "starcraft samples=64"); // what both that darken meet
    ASSERT_LT(*strict.rmse, std::min(*paid.rmse, leastBudget(first, "none")));
    ASSERT_LT(*paid.rmse, leastBudget(first, "none"));
    impossible.rmse = 0.1 * gtao.matched.rmse;
    const SweepPlan plan{folder_ / "choice", folder_ / "cache"};
    const auto choiceOf = [&](const Budget& budget) {
        return choose(study_, budget, {}, plan, context_.driver(),
                      [](double, double, const std::string&) {});
    };
    const auto chosen = [&](const Budget& budget) {
        const Choice choice = choiceOf(budget);
        return choice.chosen ? nameOf(choice, *choice.chosen) : "";
    };
    EXPECT_EQ(chosen(loose), "none");
    EXPECT_EQ(chosenFrom(first, loose), "none");
    EXPECT_EQ(chosen(strict), "gtao");
    EXPECT_EQ(chosenFrom(first, strict), "gtao");
    EXPECT_EQ(chosen(impossible), "");
    EXPECT_EQ(chosenFrom(first, impossible), "");

    // Of those that meet a budget, the cheapest; all that is cheaper failed, and says why.
    const Choice choice = choiceOf(paid);
    ASSERT_TRUE(choice.chosen);
    EXPECT_NE(nameOf(choice, *choice.chosen), "none");
    const double cost = choice.candidates[*choice.chosen].milliseconds;
    EXPECT_GT(cost, 0);
    for (const Candidate& candidate : choice.candidates)
        if (candidate.rung >= Rung::held_out && candidate.verdict.empty()) {
            EXPECT_GE(candidate.milliseconds, cost);
        }
    for (std::size_t i = 0; i < *choice.chosen; ++i)
        EXPECT_NE(choice.candidates[i].verdict, "") << nameOf(choice, i);

    // What is written is what a study takes by include, as it was matched.
    writeChoice(folder_ / "choice", study_, ".", paid, choice);
    const std::size_t techniques = text.find("[techniques]");
    writeFile(folder_ / "choice" / "included.toml",
              "include = [\"choice.toml\"]\n" + text.substr(0, techniques));
    const MatchStudy included = readSweepStudy(folder_ / "choice" / "included.toml").match;
    ASSERT_EQ(included.techniques.size(), 1u);
    const Configuration& wanted = choice.candidates[*choice.chosen].configuration;
    EXPECT_EQ(settingsOf(included.techniques[0], 0.2).named(),
              settingsAt(wanted, 0.2, true).named());
    writeChoice(folder_ / "choice", study_, ".", impossible, choiceOf(impossible));
    EXPECT_FALSE(fs::exists(folder_ / "choice" / "choice.toml")); // no stale answer
}

// A hidden face stays lit without occlusion; a plane without acne is what it is, but no picture
// that moves is free of change.
TEST_F(SweepTest, ChoosesByWhatAStillPictureDoesNotShow) {
    SweepStudy study = study_;
    study.match.techniques.resize(1);
    ASSERT_EQ(study.match.techniques[0].technique, "none");
    const auto verdictOn = [&](const Budget& budget) {
        return choose(study, budget, {}, {folder_, folder_ / "cache"}, context_.driver(),
                      [](double, double, const std::string&) {})
            .candidates[0]
            .verdict;
    };
    Budget budget;
    budget.failures = {"hidden"};
    EXPECT_THAT(verdictOn(budget), testing::StartsWith("hidden: "));
    budget.failures = {"plane"};
    budget.flicker = 1e-6;
    EXPECT_THAT(verdictOn(budget), testing::StartsWith("flicker 0.0"));
}

TEST_F(SweepTest, OneHeldOutViewGivesNoConfidence) {
    SweepStudy study = study_;
    study.match.test.resize(1);
    Budget budget;
    budget.rmse = 1;
    EXPECT_THAT(test::errorOf([&] {
                    choose(study, budget, {}, {folder_, folder_ / "cache"}, context_.driver(),
                           [](double, double, const std::string&) {});
                }),
                testing::HasSubstr("expected at least two test views"));
}

TEST_F(SweepTest, ReferencesOfHoursAreRefusedFirst) {
    SweepPlan plan{folder_, folder_ / "cache"};
    plan.hours = 1e-9;
    try {
        sweep(study_, {}, plan, context_.driver(), [](double, double, const std::string&) {});
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("allow it by --hours"));
    }
    EXPECT_FALSE(fs::exists(folder_ / "sweep.csv"));
}

TEST(Timing, NamesPassesAndTheirWork) {
    const gl::Context context;
    const Subject subject(builtinScene("sculpture"));
    Camera camera;
    camera.position = {0.8, 0.9, 1.75};
    camera.target = {0, 0.57, 0};
    const Probe probe(subject, camera, 64, 36, Normals::smooth, 1);
    Settings half(technique("starcraft"));
    half.set("downscale", 2);
    TimingPlan plan;
    plan.frames = 3;
    plan.seconds = 0.01;
    const TechniqueTime time =
        timeTechniques(probe, std::vector{half, Settings(technique("none"))}, 0.2, plan).front();
    std::vector<std::string> names;
    double sum = 0;
    for (const PassTime& pass : time.passes) {
        names.push_back(pass.name);
        sum += pass.median;
    }
    EXPECT_THAT(names, testing::ElementsAre("reduce", "gather", "blurTile", "upsample"));
    EXPECT_GE(time.frames, 3);
    EXPECT_GT(sum, 0); // medians need not add up on a machine that does other things
    EXPECT_LE(time.total.low, time.total.median);

    // What takes no time does not keep the others' rounds going.
    plan.frames = 8;
    plan.seconds = 1000;
    const auto longer =
        timeTechniques(probe, std::vector{half, Settings(technique("none"))}, 0.2, plan);
    EXPECT_EQ(longer[0].frames, 8);
    EXPECT_EQ(longer[1].frames, 3);
}

TEST(Viewpoints, SeeTheSceneFromDifferentSides) {
    const gl::Context context;
    const Scene scene = builtinScene("sculpture");
    const std::vector<Camera> cameras = foundCameras(Sight(scene), RayTracer(scene), 0.2, 2, 1);
    ASSERT_EQ(cameras.size(), 2u);
    const Subject subject(scene);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Probe probe(subject, cameras[i], 32, 18, Normals::smooth, 1);
        const auto shown = std::count(probe.shown().begin(), probe.shown().end(), true);
        EXPECT_GT(shown, 32 * 18 / 10) << i;
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_NE(cameras[i].position, cameras[j].position);
    }
}

} // namespace
} // namespace obscura
