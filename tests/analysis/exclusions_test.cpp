#include "analysis/exclusions.h"
#include "analysis/findings.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace obscura {
namespace {

using test::sampleResponse;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

// Eight people, four conditions each; person 1 always chooses the second picture.
std::vector<Answer> sampleRows() {
    std::vector<Answer> rows;
    for (int person = 1; person <= 8; ++person)
        for (int trial = 1; trial <= 4; ++trial) {
            Vote row(sampleResponse(person, fmt::format("c{}", trial), true));
            row.aFirst = trial % 2 == 0;
            row.choseB = person == 1 ? row.aFirst : person % 2 == 0;
            rows.push_back({row, Symbol("x.csv"), trial + 1});
        }
    return rows;
}

Declared only(ExclusionRules rules) {
    Declared declared;
    declared.exclusions = rules;
    return declared;
}

TEST(Exclusions, LeaveOutNothingUnlessAsked) {
    auto rows = sampleRows();
    EXPECT_TRUE(exclude(rows, {}, {}, {}).rows.empty());
    EXPECT_EQ(rows.size(), 32u);
}

TEST(Exclusions, OfPeopleWhoChooseAPosition) {
    auto rows = sampleRows();
    ExclusionRules rules;
    rules.onePosition = 0.9;
    const Excluded excluded = exclude(rows, only(rules), {}, {});
    EXPECT_EQ(rows.size(), 28u);
    ASSERT_EQ(excluded.reasons.size(), 1u);
    EXPECT_EQ(excluded.reasons[0].participant, "P01");
    EXPECT_EQ(excluded.reasons[0].trials, 4);
    EXPECT_THAT(excluded.reasons[0].reason, HasSubstr("second picture in 4 of 4 trials"));
}

TEST(Exclusions, OfSessionsThatMissCatchTrials) {
    auto rows = sampleRows();
    for (Answer& answer : rows)
        if (answer.row.conditionId == Symbol("c4"))
            answer.row.trialKind = Symbol("catch");
    ExclusionRules rules;
    rules.catches = 0.5;
    Declared declared = only(rules);
    declared.correct["c4"] = "b"; // which persons 3, 5, 7 did not choose
    const Excluded excluded = exclude(rows, declared, {}, {});
    EXPECT_EQ(excluded.reasons.size(), 3u);
    EXPECT_EQ(excluded.reasons[0].trials, 3);
    EXPECT_THAT(excluded.reasons[0].reason, HasSubstr("0 of 1 catch trials right"));
}

TEST(Exclusions, OfSessionsAndTrials) {
    auto rows = sampleRows();
    rows.pop_back(); // person 8 did not finish
    rows[4].row.interrupted = true;
    rows[9].row.decisionRtMs = 90;
    rows[10].row.maskFramesShown = rows[10].row.maskFramesPlanned + 1;
    ExclusionRules rules;
    rules.incomplete = rules.interrupted = rules.wrongMasks = true;
    rules.fastest = 0.1;
    const Excluded excluded = exclude(rows, only(rules), {}, {});
    EXPECT_EQ(rows.size(), 32u - 4 - 3);
    ASSERT_EQ(excluded.reasons.size(), 4u);
    EXPECT_THAT(excluded.reasons[0].reason, HasSubstr("3 of 4 trials"));
    EXPECT_THAT(excluded.reasons[3].reason, HasSubstr("within 0.1 s"));
    EXPECT_EQ(excluded.reasons[3].participant, "");
}

TEST(Exclusions, OfSessionsThatTheLedgerVoids) {
    auto rows = sampleRows();
    const std::string person = rows[0].row.participantId;
    SlotRecord held;
    held.slot = 3;
    held.session = {person, std::stoi(rows[0].row.sessionId.text())};
    SlotRecord returned = held;
    returned.state = SlotState::returned;
    EXPECT_TRUE(exclude(rows, {}, std::vector{returned, held}, {}).rows.empty()) << "gone on with";
    const Excluded excluded = exclude(rows, {}, std::vector{held, returned}, {});
    ASSERT_EQ(excluded.reasons.size(), 1u);
    EXPECT_THAT(excluded.reasons[0].reason, HasSubstr("slot 3 was given back"));
    EXPECT_EQ(excluded.reasons[0].participant, person);
    EXPECT_EQ(rows.size(), 28u);
    ExclusionRules keep;
    keep.voided = false;
    rows = sampleRows();
    EXPECT_TRUE(exclude(rows, only(keep), std::vector{held, returned}, {}).rows.empty());
}

TEST(Exclusions, OfAFileNameEachReason) {
    const test::Folder folder;
    const auto file = folder.path() / "exclude.csv";
    auto rows = sampleRows();
    const std::string person = rows[0].row.participantId;
    writeFile(file, "participant_id,session_id,condition_id,reason\n" + person +
                        ",,,\"fell asleep, twice\"\n,,c2,the wrong picture\n");
    const Excluded excluded = exclude(rows, {}, {}, file);
    EXPECT_EQ(rows.size(), 32u - 4 - 7);
    EXPECT_EQ(excluded.reasons[0].reason, "fell asleep, twice");
    writeFile(file, "participant_id,session_id,condition_id,reason\nP0l,,,typed wrongly\n");
    rows = sampleRows();
    EXPECT_THAT(test::errorOf([&] { exclude(rows, {}, {}, file); }),
                AllOf(HasSubstr("exclude.csv:2"), HasSubstr("fits no row")));
    writeFile(file, "participant_id,session_id,condition_id,reason\n,,,everything\n");
    EXPECT_THAT(test::errorOf([&] { exclude(rows, {}, {}, file); }), HasSubstr("found none"));
    writeFile(file, "participant,reason\n");
    EXPECT_THAT(test::errorOf([&] { exclude(rows, {}, {}, file); }),
                HasSubstr("expected the header"));
}

// What the exclusion changes is said, and the answer with the excluded stands beside.
TEST(Exclusions, AreToldWithAndWithout) {
    Answers answers;
    answers.files = 1;
    for (int person = 1; person <= 24; ++person) {
        Response response = sampleResponse(person, "c1", person <= 17);
        answers.counted.push_back({Vote(response), Symbol("x.csv"), 2});
    }
    Claim claim;
    claim.name = "b is better";
    claim.conditions = {"c1"};
    answers.declared.claims = {claim};
    // 17 of 24: p = .0639; without three who chose a, 17 of 21: .0072
    Findings findings = findingsOf(answers, std::nullopt);
    EXPECT_FALSE(findings.whole);
    EXPECT_EQ(nameOf(findings.claims[0].outcome), "undecided");
    for (int i = 0; i < 3; ++i) {
        answers.excluded.rows.push_back(answers.counted.back());
        answers.counted.pop_back();
    }
    answers.excluded.reasons = {{"", "", "not looking", 3}};
    findings = findingsOf(answers, std::nullopt);
    ASSERT_TRUE(findings.whole);
    EXPECT_EQ(findings.whole->tallies[0].votes.total(), 24);
    EXPECT_THAT(summaryOf(findings),
                Contains(AllOf(HasSubstr("3 votes do not count"),
                               HasSubstr("would be undecided instead of supported"))));
}

} // namespace
} // namespace obscura
