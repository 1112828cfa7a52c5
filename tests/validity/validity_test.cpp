#include "analysis/study_tests.h"

#include "inference/counts.h"
#include "validity/tallying.h"
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <regex>

namespace obscura {
namespace {

namespace fs = std::filesystem;

#ifdef OBSCURA_SANITIZED
constexpr int studies = 20; // the same code runs; rates are counted in release
#else
constexpr int studies = 200;
#endif

class Validity : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    Outcomes outcomesIn(std::string_view world, int threads = 2, int asked = studies) const {
        for (const World& one : worlds())
            if (one.name == world)
                return outcomesOf(StudySimulator(one.protocol()), one, {0, one.studies(asked)}, 1,
                                  folder.string(), threads);
        return {};
    }

    const fs::path folder =
        fs::temp_directory_path() / ("obscura-validity-test." + std::to_string(::getpid()));
};

// Chance beyond one in a thousand: a rate whose 99.9 % interval has nothing of `low` ... `high`.
void expectRate(const Rate& rate, double low, double high, const std::string& name) {
    ASSERT_GT(rate.of, studies / 2) << name;
    const Interval interval = clopperPearson(rate.hits, rate.of, 0.999);
    EXPECT_LT(interval.low, high) << name << ": " << rate.hits << " of " << rate.of;
    EXPECT_GT(interval.high, low) << name << ": " << rate.hits << " of " << rate.of;
}

TEST_F(Validity, ClaimsAreSeldomMadeWhereThereIsNothing) {
    for (const char* world : {"guessing", "people differ", "position bias"}) {
        const Outcomes outcomes = outcomesIn(world);
        for (const char* claim :
             {"one condition", "four conditions", "trend over two", "trend over three"})
            expectRate(outcomes.rejected.at(std::string("claim: ") + claim), 0, 0.055,
                       std::string(world) + ", " + claim);
        expectRate(outcomes.anyClaim, 0, 0.055, world);
    }
}

// The exact test of 28 votes rejects at 8 : 20 and beyond; R: 2 * pbinom(8, 28, .5).
TEST_F(Validity, TheExactTestHasItsKnownSize) {
    const Outcomes outcomes = outcomesIn("guessing");
    expectRate(outcomes.rejected.at("condition: exact binomial"), 0.0356, 0.0357, "exact");
}

TEST_F(Validity, IntervalsHoldTheTruth) {
    const Outcomes outcomes = outcomesIn("effect");
    for (const auto& [name, rate] : outcomes.covered)
        expectRate(rate, name.ends_with("(90 %)") ? 0.89 : 0.94, 1, name);
    expectRate(outcomes.rejected.at("claim: equivalence"), 0, 0.055, "at the margin");
}

// psychophysics.md 5.1: .750 for a share of .75, 28 people.
TEST_F(Validity, PowerIsAsPlanned) {
    expectRate(outcomesIn("effect").rejected.at("claim: one condition"), 0.749, 0.751, "power");
}

// By the sandwich and chi-square alone they reject in 12 to 14 % and 7 % of studies.
TEST_F(Validity, WaldTestsOfFewPeopleKeepTheirPromise) {
    const Outcomes outcomes = outcomesIn("people differ", 2, 3 * studies);
    for (const char* test : {"test gee, conditions", "test gee, position"})
        expectRate(outcomes.rejected.at(test), 0, 0.055, test);
}

TEST_F(Validity, TestsOfRepeatsKeepTheirPromise) {
    const Outcomes outcomes = outcomesIn("guessing twice");
    for (const char* test : {"test repeats", "test repeats-conditions", "test mcnemar",
                             "claim: one condition", "claim: trend over two"})
        expectRate(outcomes.rejected.at(test), 0, 0.055, test);
}

TEST_F(Validity, ScalesHoldTheTruth) {
    const Outcomes outcomes = outcomesIn("ladder");
    int scales = 0;
    for (const auto& [name, rate] : outcomes.covered)
        if (name.starts_with("scale:")) {
            EXPECT_GT(clopperPearson(rate.hits, rate.of, 0.999).high, 0.94) << name;
            scales += rate.of;
        }
    EXPECT_EQ(scales, 3 * studies / 10);
}

TEST_F(Validity, EveryKindOfTestIsTried) {
    std::string tried;
    for (const World& world : worlds())
        for (const auto& [name, rate] : outcomesIn(world.name, 2, 10).rejected)
            tried += name + "\n";
    for (const TestKind& kind : testKinds())
        EXPECT_TRUE(std::regex_search(tried, std::regex("test " + std::string(kind.id) + "[,\n]")))
            << kind.id;
}

TEST_F(Validity, IsTheSameWithAnyNumberOfThreads) {
    const Outcomes one = outcomesIn("effect", 1), two = outcomesIn("effect", 2);
    ASSERT_EQ(one.rejected.size(), two.rejected.size());
    for (const auto& [name, rate] : one.rejected)
        EXPECT_EQ(rate.hits, two.rejected.at(name).hits) << name;
}

} // namespace
} // namespace obscura
