#include "analysis/study_tests.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::vector<StudyTest> run(std::string_view id, const StudyData& data) {
    const auto kind = std::find_if(testKinds().begin(), testKinds().end(),
                                   [&](const TestKind& one) { return one.id == id; });
    return kind->run(data);
}

std::vector<Tally> thesis() {
    return readCounts(std::filesystem::path(OBSCURA_SOURCE) / "analysis/thesis_table4.csv");
}

// psychophysics.md 5.1, H3 from margins: chi-square(2) 3.6917, p .1579 for Crytek against Blizzard,
// and .4577 for None against Blizzard on Sponza.
TEST(StudyTests, OfTotalsAreThoseOfTheThesis) {
    const auto tests = run("homogeneity", studyData(thesis(), nullptr));
    ASSERT_EQ(tests.size(), 4u); // of each pair all, and Sponza alone
    EXPECT_THAT(tests[3].about,
                HasSubstr("Blizzard24 over None: moderate (sponza), high (sponza)"));
    EXPECT_NEAR(tests[3].test->p, 0.4577, 5e-5);
    EXPECT_THAT(tests[1].note, HasSubstr("anything from 0.0156 to 0.2649")); // conditions 3 and 6
    EXPECT_THAT(tests[0].about, HasSubstr("Blizzard24 over Crytek24: low (dragon), moderate"));
    EXPECT_NEAR(*tests[0].test->statistic, 3.6917, 5e-5);
    EXPECT_NEAR(tests[0].test->p, 0.1579, 5e-5);
    EXPECT_THAT(tests[0].note, HasSubstr("only trial by trial can decide"));
    for (const char* id : {"cochran", "mcnemar", "position", "people", "mixed"})
        EXPECT_THAT(run(id, studyData(thesis(), nullptr)), IsEmpty()) << id;
}

// Twelve people; c1 and c2 are the same pair at two levels. Eight answer b to both, three only to
// the second, one only to the first.
class OfPeople : public testing::Test {
  protected:
    std::vector<Answer> answers;
    void SetUp() override {
        for (int number = 1; number <= 12; ++number) {
            const bool first = number <= 9, second = number != 9;
            add(sampleResponseAt(number, "c1", first, "low"));
            add(sampleResponseAt(number, "c2", second, "high"));
        }
    }
    static Response sampleResponseAt(int number, const char* condition, bool b, const char* level) {
        Response row = test::sampleResponse(number, condition, b);
        row.level = level;
        return row;
    }
    void add(const Response& row) {
        answers.push_back({Vote(row), Symbol("a.csv"), static_cast<int>(answers.size()) + 2});
    }
    StudyData data() const { return studyData(tallyVotes(answers, nullptr), &answers); }
};

TEST_F(OfPeople, McNemarCountsThoseWhoChanged) {
    const auto tests = run("mcnemar", data());
    ASSERT_EQ(tests.size(), 1u);
    EXPECT_DOUBLE_EQ(tests[0].test->p, 0.625); // R: binom.test(1, 4)
    EXPECT_THAT(tests[0].note, HasSubstr("1 and 3 people changed their answer"));
    EXPECT_THAT(tests[0].note, testing::Not(HasSubstr("cannot be told"))) << "one scene";
    EXPECT_THAT(run("cochran", data()), IsEmpty());
}

TEST_F(OfPeople, WhoDidNotAnswerAllIsLeftOutAndSaid) {
    add(sampleResponseAt(13, "c1", true, "low"));
    const auto tests = run("mcnemar", data());
    EXPECT_DOUBLE_EQ(tests.at(0).test->p, 0.625);
    EXPECT_THAT(tests[0].note, HasSubstr("1 people who did not answer all of them are left out"));
}

TEST_F(OfPeople, ScenesThatChangeWithTheLevelAreSaid) {
    for (Answer& answer : answers)
        if (answer.row.conditionId.text() == "c1")
            answer.row.scene = Symbol("dragon");
    EXPECT_THAT(run("mcnemar", data()).at(0).note, HasSubstr("level and scene change together"));
}

TEST_F(OfPeople, RepeatsCountOnce) {
    Response again = sampleResponseAt(1, "c1", false, "low");
    again.repeatIndex = 2;
    add(again);
    EXPECT_DOUBLE_EQ(run("mcnemar", data()).at(0).test->p, 0.625);
}

// One who always chooses the second picture, and twelve times chance.
TEST_F(OfPeople, PositionIsTestedInThreeWays) {
    for (Answer& answer : answers)
        answer.row.choseB = answer.row.aFirst; // b is second when a is first
    EXPECT_THAT(run("position", data()).at(0).about, HasSubstr("24 of 24 votes"));
    EXPECT_LT(run("position", data()).at(0).test->p, 1e-6);
    EXPECT_FALSE(run("position-people", data()).at(0).test.has_value()) << "all alike";
    EXPECT_LT(run("position-conditions", data()).at(0).test->p, 1e-4);
}

TEST_F(OfPeople, TheMixedModelSaysWhyItIsNotFitted) {
    for (Answer& answer : answers)
        answer.row.aFirst = true;
    EXPECT_THAT(run("mixed", data()).at(0).note, HasSubstr("always in the same place"));
}

} // namespace
} // namespace obscura
