#include "bench/sweep/units.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <set>

namespace obscura {
namespace {

using Kind = SweepUnit::Kind;

// 15 configurations (two groups), on two scenes, three views and two sizes.
SweepStudy study() {
    std::string text = R"(name = "units"
seed = 7
reference = "cosine"
rays = 16
radii = [0.2]
train = ["front"]
test = ["left", "hall", "right"]
sizes = [[64, 36], [128, 72]]
[scenes.front]
builtin = "sculpture"
camera = { position = [0.8, 0.9, 1.75], target = [0, 0.57, 0], fovDegrees = 38 }
[scenes.left]
builtin = "sculpture"
camera = { position = [-1.1, 0.8, 1.4], target = [0, 0.55, 0], fovDegrees = 38 }
[scenes.right]
builtin = "sculpture"
camera = { position = [1.3, 0.8, 1.2], target = [0, 0.55, 0], fovDegrees = 38 }
[scenes.hall]
builtin = "atrium"
camera = { position = [7.6, 1.2, -0.9], target = [-4, 2.4, 1.2], fovDegrees = 60 }
[growth]
view = "front"
radii = [0.2]
sizes = [[64, 36]]
poles = [4]
[growth.techniques.hbao]
technique = "hbao"
steps = [2, 4]
[techniques]
none = { technique = "none" }
gtao = { technique = "gtao", preset = "ultra" }
starcraft = { technique = "starcraft", samples = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13] }
)";
    return parseSweepStudy(text, "units.toml");
}

std::vector<SweepUnit> unitsOf(Measured measured, int part = 1, int parts = 1) {
    return sweepUnits(study(), {measured, part, parts}, "a machine");
}

std::vector<std::string> namesOf(const std::vector<SweepUnit>& units, Kind kind) {
    std::vector<std::string> names;
    for (const SweepUnit& each : units)
        if (each.kind == kind)
            names.push_back(each.unit.name);
    return names;
}

TEST(SweepUnits, HaveEveryErrorAndEveryTimeOnce) {
    const auto units = unitsOf(Measured::both);
    std::set<std::string> names;
    std::map<std::pair<std::string, std::size_t>, int> errors, times; // by place, configuration
    for (const SweepUnit& each : units) {
        EXPECT_TRUE(names.insert(each.unit.name).second) << each.unit.name;
        EXPECT_GT(each.unit.cost, 0) << each.unit.name;
        for (const std::size_t i : each.configurations)
            if (each.kind != Kind::fit)
                ++(each.kind == Kind::errors ? errors : times)[{each.unit.group, i}];
    }
    EXPECT_EQ(errors.size(), 15u * 3 * 2);
    EXPECT_EQ(times, errors);
    EXPECT_EQ(namesOf(units, Kind::fit).size(), 15u);
    EXPECT_EQ(namesOf(units, Kind::times).size(), 2u * 3 * 2);
    EXPECT_EQ(namesOf(units, Kind::references).size(), 3u * 2);
    EXPECT_EQ(namesOf(units, Kind::training).size(), 1u);
    EXPECT_EQ(namesOf(units, Kind::growth).size(), 1u);
}

TEST(SweepUnits, ComeAfterWhatTheyNeedAndSceneByScene) {
    std::map<Kind, int> stages;
    std::vector<std::size_t> views;
    for (const SweepUnit& each : unitsOf(Measured::both)) {
        if (each.kind != Kind::files) {
            EXPECT_EQ(stages.emplace(each.kind, each.stage).first->second, each.stage);
        }
        if (each.kind == Kind::errors && (views.empty() || views.back() != each.view))
            views.push_back(each.view);
    }
    EXPECT_LT(stages[Kind::training], stages[Kind::fit]);
    EXPECT_LT(stages[Kind::fit], stages[Kind::errors]);
    EXPECT_EQ(stages[Kind::references], stages[Kind::errors]);
    EXPECT_LT(stages[Kind::errors], stages[Kind::times]);
    EXPECT_EQ(stages[Kind::growth], stages[Kind::times]);
    EXPECT_THAT(views, testing::ElementsAre(0, 2, 1)); // the atrium is loaded once, and last
}

TEST(SweepUnits, OfErrorsAloneOrTimesAloneAreThoseOfBoth) {
    const auto both = unitsOf(Measured::both), errors = unitsOf(Measured::errors),
               times = unitsOf(Measured::times);
    EXPECT_EQ(namesOf(errors, Kind::errors), namesOf(both, Kind::errors));
    EXPECT_EQ(namesOf(times, Kind::times), namesOf(both, Kind::times));
    EXPECT_EQ(namesOf(errors, Kind::fit), namesOf(times, Kind::fit));
    EXPECT_THAT(namesOf(errors, Kind::times), testing::IsEmpty());
    EXPECT_THAT(namesOf(errors, Kind::growth), testing::IsEmpty());
    EXPECT_THAT(namesOf(times, Kind::errors), testing::IsEmpty());
    EXPECT_THAT(namesOf(times, Kind::references), testing::IsEmpty()); // times need no rays
}

TEST(SweepUnits, OfTimesAreEachKindOfMachinesOwnInTheSameGroups) {
    const auto here = sweepUnits(study(), {Measured::times, 1, 1}, "here"),
               there = sweepUnits(study(), {Measured::times, 1, 1}, "there");
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
        EXPECT_EQ(here[i].configurations, there[i].configurations);
        EXPECT_EQ(here[i].unit.name == there[i].unit.name,
                  here[i].kind == Kind::fit || here[i].kind == Kind::training);
    }
}

// Every unit in one part, and parts as even as units allow: 90 units of errors, 12 of times.
TEST(SweepUnits, ArePartedWithoutGapsOrOverlaps) {
    for (const int parts : {1, 2, 3, 7, 20, 90, 200}) {
        std::map<std::string, int> found;
        for (int part = 1; part <= parts; ++part) {
            const auto units = unitsOf(Measured::both, part, parts);
            const auto errors = namesOf(units, Kind::errors), times = namesOf(units, Kind::times);
            EXPECT_NEAR(static_cast<double>(errors.size()), 90.0 / parts, 1) << part;
            EXPECT_NEAR(static_cast<double>(times.size()), 12.0 / parts, 1) << part;
            for (const auto* names : {&errors, &times})
                for (const std::string& name : *names)
                    ++found[name];
            for (const std::string& name : namesOf(units, Kind::growth))
                ++found[name];
            // What a part measures it has fitted, and no more.
            std::set<std::size_t> fitted, needed;
            for (const SweepUnit& each : units)
                (each.kind == Kind::fit ? fitted : needed)
                    .insert(each.configurations.begin(), each.configurations.end());
            EXPECT_EQ(fitted, needed) << part << "/" << parts;
        }
        EXPECT_EQ(found.size(), 90u + 12 + 1) << parts;
        for (const auto& [name, times] : found)
            EXPECT_EQ(times, 1) << name;
    }
}

} // namespace
} // namespace obscura
