#include "analysis/claims.h"
#include "analysis/findings.h"
#include "analysis/table.h"
#include "analysis/verdict.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace obscura {
namespace {

using test::sampleResponse;
using testing::Contains;
using testing::HasSubstr;
using Outcome = ClaimResult::Outcome;

// People as rows, conditions c1, c2, ... as columns: b for 'b', a for 'a', not answered for '-'.
// Condition n is of level n.
struct Study {
    std::vector<Answer> answers;
    std::vector<Tally> tallies;

    explicit Study(const std::vector<std::string>& people) {
        for (std::size_t person = 0; person < people.size(); ++person)
            for (std::size_t i = 0; i < people[person].size(); ++i)
                if (people[person][i] != '-') {
                    Response row =
                        sampleResponse(static_cast<int>(person) + 1, fmt::format("c{}", i + 1),
                                       people[person][i] == 'b');
                    row.level = fmt::format("level{}", i + 1);
                    answers.push_back({Vote(row), Symbol("x.csv"), 2});
                }
        tallies = tallyVotes(answers, nullptr);
    }

    ClaimResult test(const Claim& claim) const {
        return testClaims({claim}, tallies, &answers).front();
    }
};

std::vector<std::string> repeated(const std::vector<std::pair<int, std::string>>& kinds) {
    std::vector<std::string> people;
    for (const auto& [number, person] : kinds)
        people.insert(people.end(), static_cast<std::size_t>(number), person);
    return people;
}

Claim claim(Claim::Kind kind, std::vector<std::string> conditions) {
    Claim result;
    result.name = "It is so";
    result.kind = kind;
    result.conditions = std::move(conditions);
    return result;
}

TEST(SuperiorClaim, OfOneConditionIsTheBinomialTest) {
    const Study study(repeated({{25, "b"}, {11, "a"}})); // binom.test(25, 36): .0288167
    Claim asked = claim(Claim::Kind::superior, {"c1"});
    const ClaimResult result = study.test(asked);
    EXPECT_EQ(result.outcome, Outcome::supported);
    EXPECT_EQ(result.people, 36);
    EXPECT_NEAR(result.test->p, 0.0288167196559, 1e-12);
    EXPECT_NEAR(*result.estimate, 25 / 36.0, 1e-15);
    EXPECT_NEAR(result.interval->low, 0.5189, 5e-5);
    EXPECT_THAT(sentenceOf(result), HasSubstr("the data support it"));
    asked.favours = "a";
    EXPECT_EQ(study.test(asked).outcome, Outcome::contradicted);
    EXPECT_NEAR(*study.test(asked).estimate, 11 / 36.0, 1e-15);
}

// R 4.2.2: t.test(c(rep(1, 7), rep(.5, 4), 0), mu = .5)
TEST(SuperiorClaim, OfSeveralConditionsIsOfPeople) {
    const Study study(repeated({{7, "bb"}, {2, "ba"}, {2, "ab"}, {1, "aa"}}));
    const ClaimResult result = study.test(claim(Claim::Kind::superior, {"c1", "c2"}));
    EXPECT_NEAR(*result.test->statistic, 2.569046516, 1e-9);
    EXPECT_NEAR(result.test->p, 0.02609468224, 1e-11);
    EXPECT_NEAR(result.interval->low, 0.5358169221, 1e-9);
    EXPECT_NEAR(result.interval->high, 0.9641830779, 1e-9);
    EXPECT_EQ(result.outcome, Outcome::supported);
    // One person's many answers weigh no more than another's few.
    const Study uneven(repeated({{6, "b-"}, {6, "aa"}}));
    EXPECT_NEAR(*uneven.test(claim(Claim::Kind::superior, {"c1", "c2"})).estimate, 0.5, 1e-15);
}

TEST(SuperiorClaim, OfUnanimousPeopleIsTheSignTest) {
    const ClaimResult all =
        Study(repeated({{8, "bb"}})).test(claim(Claim::Kind::superior, {"c1", "c2"}));
    EXPECT_NEAR(all.test->p, 2.0 / 256, 1e-15);
    EXPECT_EQ(all.outcome, Outcome::supported);
    const ClaimResult none =
        Study(repeated({{8, "ba"}})).test(claim(Claim::Kind::superior, {"c1", "c2"}));
    EXPECT_EQ(none.test->p, 1);
    EXPECT_EQ(none.outcome, Outcome::undecided);
}

// psychophysics.md 5.1: 18 of 36 are within .15 (p = .0457), not within .10 (.1460).
TEST(EquivalentClaim, NeedsEachCondition) {
    const Study even(repeated({{9, "bb"}, {9, "ba"}, {9, "aa"}, {9, "ab"}}));
    Claim asked = claim(Claim::Kind::equivalent, {"c1", "c2"});
    asked.margin = 0.15;
    EXPECT_EQ(even.test(asked).outcome, Outcome::supported);
    EXPECT_NEAR(even.test(asked).test->p, 0.0457, 5e-5);
    asked.margin = 0.10;
    EXPECT_EQ(even.test(asked).outcome, Outcome::undecided);
    EXPECT_NEAR(even.test(asked).test->p, 0.1460, 5e-5);
    // 16 : 20 is not within .15 (.1554), however even the other condition is.
    const Study skewed(repeated({{10, "bb"}, {8, "ba"}, {8, "aa"}, {10, "ab"}}));
    asked.margin = 0.15;
    EXPECT_NEAR(skewed.test(asked).test->p, 0.1554, 5e-5);
    EXPECT_THAT(skewed.test(asked).measure, HasSubstr("c2"));
    // A difference larger than claimed contradicts; one that is merely seen does not.
    const Study far(repeated({{34, "bb"}, {2, "ab"}}));
    EXPECT_EQ(far.test(asked).outcome, Outcome::contradicted);
    EXPECT_EQ(Study(repeated({{25, "bb"}, {11, "aa"}})).test(asked).outcome, Outcome::undecided);
}

// psychophysics.md 5.2: McNemar of 11 and 3 who changed, exact p = .057373.
TEST(TrendClaim, OfTwoConditionsIsMcNemars) {
    const Study study(repeated({{11, "ba"}, {3, "ab"}, {8, "bb"}, {6, "aa"}, {2, "b-"}}));
    Claim asked = claim(Claim::Kind::trend, {"c1", "c2"});
    asked.scores = {2, 1};
    const ClaimResult result = study.test(asked);
    EXPECT_NEAR(result.test->p, 0.057373046875, 1e-12);
    EXPECT_NEAR(*result.estimate, 11 / 14.0, 1e-15) << "towards b, from c2 to c1";
    EXPECT_THAT(result.notes, Contains(HasSubstr("2 people who did not answer all")));
    asked.scores = {1, 2};
    EXPECT_NEAR(*study.test(asked).estimate, 3 / 14.0, 1e-15);
    asked.favours = "a";
    EXPECT_NEAR(*study.test(asked).estimate, 11 / 14.0, 1e-15);
}

// Six people rise by 1 over the scores 1, 2, 3, and four do not. R 4.2.2:
// t.test(c(rep(1, 6), rep(0, 4)))
TEST(TrendClaim, OfSeveralConditionsIsOfPeoplesSlopes) {
    const Study study(repeated({{3, "aab"}, {3, "abb"}, {4, "-bb"}, {4, "aaa"}}));
    Claim asked = claim(Claim::Kind::trend, {"c1", "c2", "c3"});
    asked.scores = {1, 2, 3};
    const ClaimResult result = study.test(asked);
    EXPECT_EQ(result.people, 10);
    EXPECT_EQ(result.outcome, Outcome::supported);
    EXPECT_NEAR(*result.estimate, 0.6, 1e-12);
    EXPECT_NEAR(*result.test->statistic, 3.674234614, 1e-9);
    EXPECT_NEAR(result.test->p, 0.005121072764, 1e-11);
    asked.favours = "a";
    EXPECT_EQ(study.test(asked).outcome, Outcome::contradicted);
}

TEST(Claims, OfOneFamilyAreCorrectedTogether) {
    const Study study(repeated({{25, "bb"}, {11, "ab"}}));
    Claim one = claim(Claim::Kind::superior, {"c1"}), two = claim(Claim::Kind::superior, {"c2"}),
          lost = claim(Claim::Kind::superior, {"nobody-has-seen-this"});
    two.name = "two", lost.name = "lost";
    auto results = testClaims({one, two, lost}, study.tallies, &study.answers);
    EXPECT_NEAR(results[0].holm, 2 * 0.0288167196559, 1e-12) << "the lost one counts, too";
    EXPECT_EQ(results[0].outcome, Outcome::undecided);
    EXPECT_EQ(results[2].outcome, Outcome::unusable);
    EXPECT_THAT(sentenceOf(results[2]), HasSubstr("there are no votes on its conditions"));
    one.family = "other";
    results = testClaims({one, two, lost}, study.tallies, &study.answers);
    EXPECT_EQ(results[0].outcome, Outcome::supported);
}

TEST(Claims, AreNotAnsweredByBrokenOrTooFewAnswers) {
    Study few(repeated({{5, "b"}}));
    const Claim asked = claim(Claim::Kind::superior, {"c1"});
    EXPECT_EQ(few.test(asked).outcome, Outcome::unusable);
    EXPECT_THAT(few.test(asked).why, HasSubstr("5 people are too few"));
    EXPECT_EQ(verdictsOf(few.tallies)[0]->outcome, Verdict::Outcome::unusable);
    Study broken(repeated({{30, "b"}}));
    EXPECT_EQ(broken.test(asked).outcome, Outcome::supported);
    broken.tallies[0].fault = "the position decides";
    EXPECT_EQ(broken.test(asked).outcome, Outcome::unusable);
    EXPECT_EQ(verdictsOf(broken.tallies)[0]->outcome, Verdict::Outcome::unusable);
    EXPECT_FALSE(verdictsOf(broken.tallies)[0]->differs());
}

TEST(Claims, OfPublishedCountsSayWhatTheyTakeForGranted) {
    const auto counts = readCounts(OBSCURA_SOURCE "/analysis/thesis_table4.csv");
    std::vector<std::string> ids;
    for (const Tally& tally : counts)
        ids.push_back(tally.condition);
    Claim rise = claim(Claim::Kind::trend, {ids[2], ids[5]}),
          all = claim(Claim::Kind::superior, ids);
    rise.scores = {1, 2};
    rise.name = "rise";
    const auto results = testClaims({all, rise}, counts, nullptr);
    EXPECT_EQ(results[0].votes, 252);
    EXPECT_EQ(results[0].people, 0);
    EXPECT_THAT(results[0].notes, Contains(HasSubstr("different people")));
    EXPECT_THAT(results[1].method, HasSubstr("Cochran and Armitage"));
    EXPECT_THAT(sentenceOf(results[1]), HasSubstr("only trial by trial can decide"));
}

TEST(Families, AreThoseOfTheClaimsAndTheRestIsExploratory) {
    Study study(repeated({{20, "bab"}}));
    Claim one = claim(Claim::Kind::superior, {"c1"}), even = claim(Claim::Kind::equivalent, {"c2"});
    even.name = "Even";
    even.margin = 0.2;
    assignFamilies(study.tallies, {one, even});
    EXPECT_EQ(study.tallies[0].family, "It is so");
    EXPECT_EQ(study.tallies[1].family, "Even");
    EXPECT_EQ(study.tallies[1].margin, 0.2);
    EXPECT_EQ(study.tallies[2].family, "");
}

// Everybody chooses the second picture: nothing that is made of such votes is told.
TEST(Findings, OfPositionsAloneSayNothingElse) {
    Answers answers;
    answers.files = 1;
    for (int person = 1; person <= 28; ++person)
        for (const char* condition : {"c1", "c2", "c3"}) {
            Vote row(sampleResponse(person, condition, true));
            row.choseB = row.aFirst;
            answers.counted.push_back({row, Symbol("x.csv"), 2});
        }
    const Findings findings = findingsOf(answers, std::nullopt);
    EXPECT_TRUE(isUnusable(findings));
    EXPECT_THAT(summaryOf(findings), Contains(HasSubstr("3 of 3 conditions: position decides")));
    EXPECT_THAT(summaryOf(findings), Not(Contains(HasSubstr("camps"))));
    EXPECT_THAT(summaryOf(findings), Not(Contains(HasSubstr("decision times"))));
}

// Ten people twice each: as votes 16 of 20 (p = .0118), as people 6 shares of 1 and 4 of 1/2.
// R 4.2.2: t.test(c(rep(1, 6), rep(.5, 4)), mu = .5)
TEST(Findings, JudgeRepeatedVotesByPeople) {
    Answers answers;
    answers.files = 1;
    for (int person = 1; person <= 10; ++person)
        for (int repeat = 1; repeat <= 2; ++repeat) {
            Response row = sampleResponse(person, "c1", person <= 6 || repeat == 1);
            row.pairsReversed = repeat == 2;
            row.firstIs = repeat == 2 ? "b" : "a";
            row.repeatIndex = repeat;
            answers.counted.push_back({Vote(row), Symbol("x.csv"), 2});
        }
    const Findings findings = findingsOf(answers, std::nullopt);
    const Tally& tally = findings.tallies[0];
    ASSERT_TRUE(tally.people);
    EXPECT_NEAR(decidingP(tally), 0.005121072764, 1e-11);
    EXPECT_NEAR(verdictsOf(findings.tallies)[0]->holm, 0.005121072764, 1e-11);
    EXPECT_NEAR(intervalOf(tally).low, 0.6152956411, 1e-9);
    EXPECT_THAT(resultTable(findings.tallies).rows[0], Contains("80 % (62–98)"));
    EXPECT_THAT(summaryOf(findings), Contains(HasSubstr("people's shares (Student's t)")));
}

} // namespace
} // namespace obscura
