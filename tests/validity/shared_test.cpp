#include "base/error.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "tests/killed_workers.h"

#include "validity/shared.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// Few, in blocks of which the last is smaller.
ValidityOptions few(const test::Folder& root) {
    ValidityOptions options;
    options.studies = 5;
    options.seed = 7;
    options.share = root / "share";
    options.memory = root / "memory";
    options.threads = 1;
    options.block = 2;
    options.planned = 10;
    fs::create_directories(options.memory);
    return options;
}

TEST(SharedValidity, OutcomesComeBackFromText) {
    Outcomes outcomes;
    outcomes.rejected["condition: \"mid-p\", 5 %"] = {3, 200};
    outcomes.rejected["test"] = {0, 1};
    outcomes.covered["share: Wilson (90 %)"] = {2147483646, 2147483647};
    outcomes.anyClaim = {1, 7};
    outcomes.supported["a claim \xc3\xa9"] = {5, 5};
    EXPECT_EQ(readOutcomes(outcomesText(outcomes)), outcomes);
    EXPECT_EQ(readOutcomes(outcomesText({})), Outcomes());
    for (const char* text :
         {"", "{", "[]", R"({"rejected": {}})",
          R"({"rejected":{"a":[1]},"covered":{},"anyClaim":[0,0],"supported":{}})"})
        EXPECT_THAT(test::errorOf([&] { readOutcomes(text); }), testing::HasSubstr("outcomes"))
            << text;
}

TEST(SharedValidity, BlocksAddUpToAllStudies) {
    const test::Folder root;
    for (const World& world : worlds()) {
        const StudySimulator simulator(world.protocol());
        const auto of = [&](Block block) {
            return outcomesOf(simulator, world, block, 3, root.path().string(), 1);
        };
        Outcomes sum = of({2, 1});
        sum.add(of({0, 2}));
        EXPECT_EQ(sum, of({0, 3})) << world.name;
    }
}

std::string pageWithoutUnits(const ValidityOptions& options) {
    std::vector<Outcomes> outcomes;
    std::map<std::string, double> planned;
    for (const World& world : worlds()) {
        outcomes.push_back(outcomesOf(StudySimulator(world.protocol()), world,
                                      {0, world.studies(options.studies)}, options.seed,
                                      options.memory.string(), 1));
        if (world.name == "effect")
            planned = plannedPower(world, options.planned);
    }
    return validityPage(worlds(), outcomes, planned, options.studies, options.seed);
}

// The page of processes of which one after the other is killed is the one that a
// process makes that knows no units.
TEST(SharedValidity, NothingIsLostOrDoubledWhenWorkersAreKilled) {
    const test::Folder root;
    const ValidityOptions shared = few(root);
    const std::string expected = pageWithoutUnits(shared);
    const auto work = [&] {
        ValidityOptions own = shared;
        own.memory /= std::to_string(::getpid());
        fs::create_directories(own.memory);
        if (sharedValidityPage(own) != expected)
            throw Error("this page is another than the expected");
    };
    EXPECT_GT(test::killWorkers(3, 30, 0.05, 1, work), 0);
    EXPECT_EQ(sharedValidityPage(shared), expected);
    const UnitsState state = unitsState(shared.share);
    EXPECT_EQ(state.done, state.units);
    EXPECT_EQ(state.units, 6 * 3 + 2 * 1 + 1U); // worlds' blocks, of ladders one, and the plan
}

TEST(SharedValidity, OtherStudiesInTheFolderAreRefused) {
    const test::Folder root;
    ValidityOptions options = few(root);
    options.studies = 1;
    sharedValidityPage(options);
    options.seed = 8;
    EXPECT_THAT(
        test::errorOf([&] { sharedValidityPage(options); }),
        testing::AllOf(testing::HasSubstr("\"seed\": 7"), testing::HasSubstr("\"seed\": 8")));
}

} // namespace
} // namespace obscura
