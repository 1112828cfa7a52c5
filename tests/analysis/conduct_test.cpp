#include "analysis/conduct.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace obscura {
namespace {

using test::sampleResponse;
using testing::ElementsAre;
using testing::Pair;

Answers answersOf(const std::vector<Response>& rows) {
    Answers answers;
    for (const Response& row : rows)
        answers.counted.push_back({Vote(row), Symbol("a.csv"), 2});
    answers.files = 1;
    return answers;
}

std::string fact(const Conduct& conduct, const std::string& name) {
    const auto facts = factsOf(conduct);
    const auto found = std::find_if(facts.begin(), facts.end(),
                                    [&](const Fact& candidate) { return candidate.name == name; });
    return found == facts.end() ? "no such fact" : found->text;
}

TEST(Spread, IsRsTypeSevenPercentiles) {
    // quantile(c(3, 1, 4, 1, 5), c(.05, .5, .95)) in R 4.2.2: 1.0 3.0 4.8
    const Percentiles spread = obscura::spread({3, 1, 4, 1, 5});
    EXPECT_DOUBLE_EQ(spread.low, 1);
    EXPECT_DOUBLE_EQ(spread.median, 3);
    EXPECT_DOUBLE_EQ(spread.high, 4.8);
    EXPECT_DOUBLE_EQ(obscura::spread({2}).high, 2);
}

// 36 sessions of the thesis' scheme: two whole groups of 14 and one group broken off at 8.
TEST(Conduct, ShowsHowFarTheThesisSchemeIsFromBalance) {
    std::vector<Response> rows;
    for (int number = 1; number <= 36; ++number)
        rows.push_back(sampleResponse(number, "c1", true));
    const Conduct conduct = conductOf(answersOf(rows));
    EXPECT_EQ(conduct.participants, 36);
    ASSERT_EQ(conduct.squares.size(), 3u);
    EXPECT_EQ(conduct.squares.at(1).base, 7);
    EXPECT_EQ(conduct.squares.at(1).exchanged, 7);
    EXPECT_EQ(conduct.squares.at(3).exchanged, 1);
    EXPECT_EQ(conduct.shown.at("c1").bSecond, 21);
    EXPECT_EQ(conduct.shown.at("c1").bFirst, 15);
    EXPECT_EQ(conduct.secondChosen, 21); // all chose b
    EXPECT_EQ(fact(conduct, "Order within pairs"),
              "b was the second image in 58 % of each condition's trials");
}

TEST(Conduct, TellsPeopleSessionsAndRepeatsApart) {
    Response again = sampleResponse(1, "c1", true);
    again.sessionId = "2";
    again.slotId = 2;
    const Conduct conduct =
        conductOf(answersOf({sampleResponse(1, "c1", true), sampleResponse(1, "c2", true), again,
                             sampleResponse(2, "c1", false), sampleResponse(2, "c2", false)}));
    EXPECT_EQ(conduct.participants, 2);
    EXPECT_EQ(conduct.sessions, 3);
    EXPECT_EQ(conduct.incomplete, 1);
    EXPECT_EQ(conduct.mostVotes, 2);
    EXPECT_THAT(conduct.slots, ElementsAre(Pair(1, 1), Pair(2, 2)));
    EXPECT_EQ(fact(conduct, "Order of conditions"),
              "square 1: 3 sessions in base order, 0 exchanged; slots used more than once: 2");
}

TEST(Conduct, GrowsNotWithTheNumberOfSessions) {
    std::vector<Response> rows;
    for (int number = 1; number <= 112; ++number) { // eight squares
        rows.push_back(sampleResponse(number, "c1", true));
        rows.push_back(rows.back());
        rows.back().sessionId = "2";
    }
    EXPECT_EQ(fact(conductOf(answersOf(rows)), "Order of conditions"),
              "8 squares: 112 sessions in base order, 112 exchanged; slots used more than once: 1, "
              "2, 3, 4, 5, 6 and 106 more");
}

TEST(Conduct, CountsWhatWentWrongOnTheDisplay) {
    Response late = sampleResponse(1, "c1", true), pressed = sampleResponse(2, "c1", true);
    late.maskFramesShown = 121;
    late.missedFrames = 1;
    pressed.earlyPressesInMask = 3;
    pressed.timestampSource = "none";
    pressed.refreshHz = 59.95;
    pressed.interrupted = true;
    const Conduct conduct = conductOf(answersOf({late, pressed}));
    EXPECT_EQ(fact(conduct, "Grey mask, median (5–95 %)"),
              "2.00 s (2.00–2.00); 1 of 2 trials showed other than the planned number of "
              "refreshes, 1 had a missed frame; a key was pressed and ignored in 1");
    EXPECT_EQ(fact(conduct, "Display"),
              "59.95–60.00 Hz; timestamps from \"finish\" in 1 trials; timestamps from \"none\" in "
              "1 trials (no vertical blank: not fit for claims about timing)");
    EXPECT_EQ(fact(conduct, "Trials"), "2 main trials from 1 files, 1 of them interrupted (the "
                                       "window lost the keyboard); nothing left out");
}

TEST(Conduct, NoticesWhenTheImagesChanged) {
    Response other = sampleResponse(2, "c2", true);
    other.sha256First = std::string(64, 'c');
    const Conduct conduct = conductOf(answersOf(
        {sampleResponse(1, "c1", true), sampleResponse(8, "c1", true), // b first: the same images
         sampleResponse(1, "c2", true), other}));
    EXPECT_THAT(conduct.changedImages, ElementsAre("c2"));
}

TEST(Conduct, ListsWhatWasLeftOut) {
    Answers answers = answersOf({sampleResponse(1, "c1", true)});
    answers.leftOut = {.practice = 2, .duplicates = 1};
    answers.bad = {{{"a.csv", 3, 0, {}}, "bad"}};
    EXPECT_EQ(fact(conductOf(answers), "Trials"),
              "1 main trials from 1 files; left out: 2 practice, 1 answered twice, 1 unreadable");
}

} // namespace
} // namespace obscura
