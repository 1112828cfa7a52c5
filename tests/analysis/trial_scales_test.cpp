// Studies whose trials are no pairs: from their tables of answers to their scales.
#include "analysis/scales/scale_table.h"
#include "analysis/scales/scale_words.h"
#include "analysis/scales/trial_findings.h"
#include "tests/analysis/trial_study.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using test::answerOf;
using test::errorOf;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class TrialScales : public testing::Test {
  protected:
    Findings study(const std::vector<AnswerRow>& rows, const std::string& design = {},
                   const AnswerRules& rules = {}) {
        const std::filesystem::path data[] = {
            test::writeTrials(folder_.path() / "study", rows, design)};
        EXPECT_TRUE(isTrialData(data));
        return trialFindings(data, rules, std::nullopt);
    }

    std::string refusal(const std::vector<AnswerRow>& rows) {
        std::string message = errorOf([&] { study(rows); });
        const std::string folder = (folder_.path() / "study" / "sessions").string() + "/";
        EXPECT_TRUE(message.starts_with(folder)) << message;
        return message.substr(std::min(folder.size(), message.size()));
    }

    test::Folder folder_;
};

const ScaleResult& resultOf(const Findings& findings, std::string_view kind) {
    for (const Scaled& one : findings.scales.all)
        if (one.kind->id == kind)
            return one.result;
    ADD_FAILURE() << "no scale " << kind;
    static const ScaleResult none{};
    return none;
}

double valueOf(const ScaleResult& result, const std::string& name) {
    for (const ScaleItem& item : result.items)
        if (item.name == name)
            return item.value;
    ADD_FAILURE() << "no item " << name;
    return 0;
}

// Davidson's model of two has a solution in closed form: wins 12 : 3 and 6 ties give worths in the
// ratio 4 : 1 and nu = 6 / sqrt(12 * 3).
TEST_F(TrialScales, OfPairsWithNotSureAreDavidsons) {
    std::vector<AnswerRow> rows;
    for (int person = 1; person <= 21; ++person) {
        const bool swapped = person % 2;
        const std::string chosen = person <= 12 ? "b" : "a";
        const std::string first = swapped ? "b" : "a";
        const std::string value = person > 15 ? "unsure" : chosen == first ? "1" : "2";
        rows.push_back(answerOf(person, 1, "c1", swapped ? "b>a" : "a>b",
                                swapped ? "good>none" : "none>good", "choice", value,
                                person > 15 ? "" : chosen));
    }
    const Findings findings = study(rows);
    const ScaleResult& scale = resultOf(findings, "davidson");
    EXPECT_NEAR(valueOf(scale, "good") - valueOf(scale, "none"), std::log(4.0), 1e-6);
    EXPECT_THAT(scaleRemarks(scale), AllOf(Contains("answers \"not sure\": 6"),
                                           Contains("nu: how readily people tie: 1")));
    EXPECT_EQ(scale.group.answers, 21);
    EXPECT_EQ(scale.group.people, 21);
    EXPECT_FALSE(resultOf(findings, "threshold").items.empty());
    EXPECT_TRUE(findings.tallies.empty());
}

// 12 for b, 3 for a and 6 "not sure": the sign test of the 15 (R: binom.test(12, 15)).
TEST_F(TrialScales, OfPairsWithNotSureHaveTheirClaimsTested) {
    const std::string design =
        R"({"claims":[{"conditions":["c1"],"family":"","favours":"b","kind":"superior",)"
        R"("margin":0.0,"name":"good is better","scores":[]}]})";
    std::vector<AnswerRow> rows;
    for (int person = 1; person <= 21; ++person) {
        const bool swapped = person % 2;
        const std::string chosen = person <= 12 ? "b" : "a", first = swapped ? "b" : "a";
        const bool isUnsure = person > 15;
        rows.push_back(answerOf(person, 1, "c1", swapped ? "b>a" : "a>b",
                                swapped ? "good>none" : "none>good", "choice",
                                isUnsure          ? "unsure"
                                : chosen == first ? "1"
                                                  : "2",
                                isUnsure ? "" : chosen));
        rows.back().designSha256 = sha256(design);
    }
    const Findings findings = study(rows, design);
    ASSERT_EQ(findings.claims.size(), 1u);
    const ClaimResult& claim = findings.claims[0];
    EXPECT_EQ(claim.outcome, ClaimResult::Outcome::supported);
    EXPECT_EQ(claim.votes, 15);
    EXPECT_NEAR(claim.test->p, 0.03515625, 1e-12);
    EXPECT_THAT(claim.notes, Contains("6 answers were \"not sure\" or left open: no votes"));
    EXPECT_EQ(summaryOf(findings).front(), sentenceOf(claim));
}

// Choices that could be "not sure", held against predicted JOD: half a choice each. 2, 5 and 8 of
// ten for differences of -1, 0 and 1 lie on a logistic curve through a half at 0.
TEST_F(TrialScales, OfPairsWithNotSureAreHeldAgainstPredictedJod) {
    std::vector<AnswerRow> rows;
    Manifest stimuli;
    const int chosen[] = {10, 40, 70}, unsure[] = {20, 20, 20}; // of 100
    for (int i = 0; i < 3; ++i) {
        const std::string id = fmt::format("c{}", i + 1);
        for (int person = 1; person <= 100; ++person) {
            const bool isUnsure = person > 100 - unsure[i];
            const std::string role = person <= chosen[i] ? "b" : "a";
            rows.push_back(answerOf(person, i + 1, id, "a>b", fmt::format("t{}>t{}", i, i + 1),
                                    "choice",
                                    isUnsure      ? "unsure"
                                    : role == "a" ? "1"
                                                  : "2",
                                    isUnsure ? "" : role));
        }
        ConditionRecord record;
        record.condition = id;
        record.image("a").quality = ImageQuality{0.1, 8, {}};
        record.image("b").quality = ImageQuality{0.1, 8.0 + i - 1, {}};
        stimuli.conditions.push_back(record);
    }
    const std::filesystem::path data[] = {test::writeTrials(folder_.path() / "study", rows)};
    const Findings findings = trialFindings(data, {}, stimuli);
    const ScaleResult& curve = resultOf(findings, "psychometric");
    ASSERT_TRUE(curve.curve);
    EXPECT_EQ(curve.unit, "difference in predicted JOD");
    EXPECT_TRUE(curve.curve->ladder.isPredicted);
    EXPECT_EQ(curve.curve->ladder.data.successes, Eigen::Vector3d(20, 50, 80));
    EXPECT_NEAR(curve.items[0].value, 0, 1e-4);
    EXPECT_NEAR(curve.items[1].value, std::log(4.0), 1e-3); // of the logistic: its slope there
}

TEST_F(TrialScales, OfRatingsAreMeansWithStudentsIntervals) {
    std::vector<AnswerRow> rows;
    const int good[] = {4, 5, 3, 4}, none[] = {2, 1, 3, 2};
    for (int person = 1; person <= 4; ++person) {
        rows.push_back(answerOf(person, 1, "c1", "test", "none", "scale",
                                fmt::format("{}", none[person - 1])));
        rows.push_back(answerOf(person, 2, "c2", "test", "good", "scale",
                                fmt::format("{}", good[person - 1])));
    }
    const Findings findings = study(rows);
    const ScaleResult& scale = resultOf(findings, "mean-opinion");
    EXPECT_DOUBLE_EQ(valueOf(scale, "good"), 4);
    EXPECT_DOUBLE_EQ(valueOf(scale, "none"), 2);
    // sd 0.8165, standard error 0.40825, Student's t at 3 degrees of freedom 3.18245
    EXPECT_NEAR(*scale.items[1].interval.high, 4 + 3.182446 * 0.4082483, 1e-5);
    ASSERT_EQ(scale.steps.size(), 1u);
    // differences 2, 4, 0, 2: t = 2 / 0.8165 = 2.4495 at 3 degrees of freedom
    EXPECT_NEAR(*scale.steps[0].p, 0.0917, 1e-4);
    EXPECT_EQ(scale.items[0].counts, (std::vector<std::pair<double, int>>{{1, 1}, {2, 2}, {3, 1}}));
}

// Answers without noise: second less first, of items at 0, 1 and 3, and 0.5 for the second place.
TEST_F(TrialScales, OfComparedRatingsGoByThePlaceOfEachTechnique) {
    const std::string design =
        R"({"conditions":{},"trial":{"phases":{"order":["vote"],"vote":{"images":[],"questions":{
            "order":["q"],"q":{"kind":2,"lowest":-4,"options":["","","","","","","","",""]}}}}}})";
    const double value[] = {0, 1, 3};
    const char* name[] = {"none", "cheap", "good"};
    std::vector<AnswerRow> rows;
    for (int person = 1; person <= 10; ++person)
        for (int pair = 0; pair < 3; ++pair) {
            const int a = pair == 2 ? 1 : 0, b = pair == 0 ? 1 : 2;
            const int first = person % 2 ? a : b, second = person % 2 ? b : a;
            rows.push_back(answerOf(person, pair + 1, fmt::format("c{}", pair + 1),
                                    person % 2 ? "a>b" : "b>a",
                                    fmt::format("{}>{}", name[first], name[second]), "slider",
                                    fmt::format("{}", value[second] - value[first] + 0.5)));
        }
    for (AnswerRow& row : rows)
        row.kind = "slider";
    const Findings findings = study(rows, design);
    const ScaleResult& scale = resultOf(findings, "mean-comparison");
    EXPECT_NEAR(valueOf(scale, "cheap") - valueOf(scale, "none"), 1, 1e-9);
    EXPECT_NEAR(valueOf(scale, "good") - valueOf(scale, "none"), 3, 1e-9);
    EXPECT_THAT(scaleRemarks(scale), Contains("what the second place adds, grades: 0.5"));
}

// Of two, Plackett and Luce's log worths differ by the logarithm of the odds.
TEST_F(TrialScales, OfRanksHaveTheBestAtTheTop) {
    std::vector<AnswerRow> rows;
    for (int person = 1; person <= 20; ++person)
        rows.push_back(answerOf(person, 1, "c1", "a>b", "none>good", "rank",
                                person <= 15 ? "2>1" : "1>2", person <= 15 ? "b>a" : "a>b"));
    const Findings findings = study(rows);
    const ScaleResult& scale = resultOf(findings, "plackett-luce");
    EXPECT_NEAR(valueOf(scale, "good") - valueOf(scale, "none"), std::log(3.0), 1e-6);
    EXPECT_THAT(scaleRemarks(scale), Contains(HasSubstr("Kendall's W of 20 people's rankings")));
}

const char* const triadDesign =
    R"({"order of conditions":["t1","t2","t3","t4"],"conditions":{
        "t1":{"roles":{"a":"s0","b":"s1","c":"s2"}},"t2":{"roles":{"a":"s0","b":"s1","c":"s3"}},
        "t3":{"roles":{"a":"s0","b":"s2","c":"s3"}},"t4":{"roles":{"a":"s1","b":"s2","c":"s3"}}},
        "trial":{"roles":["a","c"],"phases":{"order":["p"],"p":{"images":["1","b","2"],
        "questions":{"order":["q"],"q":{"kind":0,"images":true,"options":["",""]}}}}}})";

// psi = 0, 1, 1.5, 3: shares Phi((psi_c - psi_b) - (psi_b - psi_a)) of 200 answers.
TEST_F(TrialScales, OfTriadsAreDifferences) {
    const double psi[] = {0, 1, 1.5, 3};
    const int triad[][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    std::vector<AnswerRow> rows;
    for (int t = 0; t < 4; ++t) {
        const auto& [a, b, c] = triad[t];
        const double share = 0.5 * std::erfc(-(psi[c] - 2 * psi[b] + psi[a]) / std::sqrt(2.0));
        for (int person = 1; person <= 200; ++person) {
            const bool larger = person <= std::lround(200 * share);
            const bool swapped = person % 2;
            rows.push_back(
                answerOf(person, t + 1, fmt::format("t{}", t + 1), swapped ? "c>a" : "a>c",
                         swapped ? fmt::format("s{}>s{}", c, a) : fmt::format("s{}>s{}", a, c),
                         "choice", larger == swapped ? "1" : "2", larger ? "c" : "a"));
        }
    }
    const Findings findings = study(rows, triadDesign);
    const ScaleResult& scale = resultOf(findings, "mlds");
    ASSERT_EQ(scale.items.size(), 4u);
    EXPECT_EQ(scale.items[2].name, "s2");
    EXPECT_NEAR(scale.items[1].value, 1, 0.05);
    EXPECT_NEAR(scale.items[2].value, 1.5, 0.05);
    EXPECT_NEAR(scale.items[3].value, 3, 0.05);
}

const char* const boostDesign =
    R"({"boost":{"reference":"source"},"conditions":{
        "c1":{"roles":{"a":"rough","b":"fine","source":"exact"}}},"trial":{"roles":["a","b"],
        "phases":{"order":["p"],"p":{"images":[],"questions":{"order":["q"],
        "q":{"kind":0,"images":true,"options":["",""],"unsure":"u"}}}}}})";

// 75 % say that the rough one flickers more: one JND; "not sure" is half a vote each.
TEST_F(TrialScales, OfBoostedTripletsGrowWithTheDifference) {
    std::vector<AnswerRow> rows;
    for (int person = 1; person <= 20; ++person) {
        const bool isUnsure = person > 16; // 13 + 2 of 20
        rows.push_back(answerOf(person, 1, "c1", "a>b", "rough>fine", "choice",
                                isUnsure       ? "unsure"
                                : person <= 13 ? "1"
                                               : "2",
                                isUnsure       ? ""
                                : person <= 13 ? "a"
                                               : "b"));
    }
    const Findings findings = study(rows, boostDesign);
    const ScaleResult& scale = resultOf(findings, "triplets");
    EXPECT_EQ(scale.unit, "boosted JND");
    EXPECT_NEAR(valueOf(scale, "rough") - valueOf(scale, "fine"), 1, 1e-6);
    EXPECT_THAT(scale.notes, Contains(HasSubstr("the source (exact) was never one of the two")));
}

std::string ladderDesign(int steps) {
    std::string conditions, correct, order;
    for (int i = 1; i <= steps; ++i) {
        const char* comma = i > 1 ? "," : "";
        conditions += fmt::format(R"({}"c{}":{{"pair":["rays{}","exact"]}})", comma, i, i);
        correct += fmt::format(R"({}"c{}":"b")", comma, i);
        order += fmt::format(R"({}"c{}")", comma, i);
    }
    return fmt::format(R"({{"conditions":{{{}}},"correct answers":{{{}}},)"
                       R"("order of conditions":[{}],"ordering":{{"scheme":"staircase"}}}})",
                       conditions, correct, order);
}

// Right answers by 1/2 + 1/2 / (1 + exp(1.2 (step - 3))): 75 % at the third step of five.
TEST_F(TrialScales, OfRightAnswersAreAPsychometricFunction) {
    std::vector<AnswerRow> rows;
    for (int step = 1; step <= 5; ++step)
        for (int person = 1; person <= 200; ++person) {
            const double share = 0.5 + 0.5 / (1 + std::exp(1.2 * (step - 3)));
            const bool isRight = person <= std::lround(200 * share);
            rows.push_back(answerOf(person, step, fmt::format("c{}", step), "b>a",
                                    fmt::format("exact>rays{}", step), "choice",
                                    isRight ? "1" : "2", isRight ? "b" : "a"));
        }
    const Findings findings = study(rows, ladderDesign(5));
    const ScaleResult& curve = resultOf(findings, "psychometric");
    ASSERT_TRUE(curve.curve);
    EXPECT_NEAR(valueOf(curve, "threshold"), 3, 0.05);
    EXPECT_NEAR(valueOf(curve, "slope"), 1.2, 0.1);
    EXPECT_LT(*curve.items[0].interval.low, 2.95);
    EXPECT_GT(*curve.items[0].interval.high, 3.05);
    EXPECT_LT(*curve.items[0].interval.high, 3.5);
    EXPECT_EQ(curve.curve->ladder.labels[2], "rays3");
    EXPECT_THAT(curve.notes, Contains(HasSubstr("a staircase chose the steps")));
}

TEST_F(TrialScales, SayWhereTheDataBoundNoCurve) {
    std::vector<AnswerRow> rows;
    for (int step = 1; step <= 3; ++step)
        rows.push_back(answerOf(1, step, fmt::format("c{}", step), "a>b",
                                fmt::format("rays{}>exact", step), "choice", "2", "b"));
    const Findings findings = study(rows, ladderDesign(3));
    EXPECT_FALSE(resultOf(findings, "psychometric").curve);
    EXPECT_THAT(scaleSentences(findings.scales),
                Contains(HasSubstr("the answers do not bound the curve")));
}

TEST_F(TrialScales, HaveNoneOfTextsAndSaySo) {
    const Findings findings = study({answerOf(1, 1, "c1", "test", "none", "scale", "3"),
                                     answerOf(1, 2, "c2", "test", "none", "text", "quite dark")});
    EXPECT_THAT(findings.scales.notes, Contains(HasSubstr("\"q\" (text) has no scale")));
}

TEST_F(TrialScales, CountOnlyWhatTheRulesLeave) {
    std::vector<AnswerRow> rows;
    for (int person = 1; person <= 3; ++person)
        rows.push_back(answerOf(person, 1, "c1", "test", "none", "scale", "4"));
    rows.push_back(answerOf(1, 2, "c2", "test", "none", "scale", "1"));
    rows.back().trial.trialKind = "practice";
    rows.push_back(answerOf(1, 0, "", "", "", "choice", "1"));
    rows.back().trial.trialKind = "before";
    rows.push_back(answerOf(4, 1, "c1", "test", "none", "scale", "1"));
    rows.back().trial.rehearsal = true;
    rows.push_back(answerOf(2, 3, "c3", "test", "none", "scale", ""));
    const Findings findings = study(rows);
    const ScaleResult& scale = resultOf(findings, "mean-opinion");
    EXPECT_DOUBLE_EQ(valueOf(scale, "none"), 4);
    EXPECT_EQ(scale.group.answers, 3);
    EXPECT_THAT(scale.notes, Contains("1 questions were left open"));
    EXPECT_EQ(findings.conduct->leftOut.practice, 1);
    EXPECT_EQ(findings.conduct->leftOut.rehearsed, 1);
    EXPECT_EQ(findings.conduct->participants, 3);
}

TEST_F(TrialScales, ShowWhatExcludedAnswersWouldChange) {
    std::vector<AnswerRow> rows;
    for (int person = 1; person <= 9; ++person)
        rows.push_back(answerOf(person, 1, "c1", "test", "none", "scale", "4"));
    rows.push_back(answerOf(10, 1, "c1", "test", "none", "scale", "1"));
    writeFile(folder_ / "excluded.csv",
              "participant_id,session_id,condition_id,reason\nP10,,,fell asleep\n");
    AnswerRules rules;
    rules.excluded = folder_ / "excluded.csv";
    const Findings findings = study(rows, {}, rules);
    EXPECT_DOUBLE_EQ(valueOf(resultOf(findings, "mean-opinion"), "none"), 4);
    ASSERT_FALSE(findings.scales.whole.empty());
    EXPECT_NEAR(findings.scales.whole[0].result.items[0].value, 3.7, 1e-12);
    EXPECT_THAT(scalesCsv(findings.scales, "participants"),
                AllOf(HasSubstr("participants,left out,mean-opinion,q,atrium,sky,item,none,,4,"),
                      HasSubstr("participants,included,mean-opinion,q,atrium,sky,item,none,,3.7")));
}

TEST_F(TrialScales, RefuseWhatNoQuestionCanHaveGiven) {
    const AnswerRow fine = answerOf(1, 1, "c1", "a>b", "none>good", "choice", "2", "b");
    AnswerRow row = fine;
    row.value = "zero";
    EXPECT_EQ(refusal({fine, row}),
              "study-sample_answers.csv:3:22: value: expected the number of an option or unsure, "
              "found \"zero\"; --lenient skips it");
    row = fine;
    row.role = "c";
    EXPECT_THAT(refusal({row}), HasSubstr("answers.csv:2:23: role: expected one of the roles "
                                          "\"a>b\", found \"c\""));
    row = fine;
    row.kind = "scale";
    row.value = "good";
    EXPECT_THAT(refusal({row}), HasSubstr("value: expected a number of a scale, found \"good\""));
    row = fine;
    row.trial.techniques = "none";
    EXPECT_THAT(refusal({row}), HasSubstr("techniques: expected a technique for each"));
    row = fine;
    row.wallTimeUtc = "yesterday";
    EXPECT_THAT(refusal({row}), HasSubstr("wall_time_utc: expected a time such as"));
}

TEST_F(TrialScales, RefuseAnAnswerThatStandsTwice) {
    const AnswerRow row = answerOf(1, 1, "c1", "test", "none", "scale", "3");
    EXPECT_THAT(refusal({row, row}),
                HasSubstr("answers.csv:3:20: question: \"q\" of this trial was "
                          "answered before, in line 2; --allow-duplicates"));
    AnswerRules rules;
    rules.duplicates = true;
    EXPECT_EQ(study({row, row}, {}, rules).conduct->leftOut.duplicates, 1);
    AnswerRow again = row; // the same trial under another number
    again.trial.trialIndex = 7;
    EXPECT_THAT(refusal({row, again}), HasSubstr("was answered before, in"));
}

TEST_F(TrialScales, AreNotMixedWithRowsOfPairs) {
    test::writeTrials(folder_ / "one", {answerOf(1, 1, "c1", "test", "none", "scale", "3")});
    writeFile(folder_ / "two" / "data" / "rows.csv", "schema_version\n");
    const std::filesystem::path both[] = {folder_ / "one", folder_ / "two"};
    EXPECT_THAT(errorOf([&] { isTrialData(both); }),
                AllOf(HasSubstr("two"), HasSubstr("found rows of pairs or nothing")));
}

} // namespace
} // namespace obscura
