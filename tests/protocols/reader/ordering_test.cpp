#include "protocols/reader/design.h"
#include "protocols/reader/protocol.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::ThrowsMessage;

// Five conditions: one and two in the hall by day, three and four in the hall and the box by night,
// five in the box by day. The right answer of all but five is b.
std::string study(const std::string& ordering) {
    std::string text = fmt::format(R"(name = "small"
seed = 7
[scenes.hall]
builtin = "atrium"
radius = 0.2
camera = {{ position = [0, 1, 3], target = [0, 0.5, 0] }}
[scenes.box]
builtin = "sculpture"
radius = 0.2
camera = {{ position = [0, 1, 3], target = [0, 0.5, 0] }}
[levels.day]
ambient = [1, 1, 1]
[levels.night]
ambient = [0.1, 0.1, 0.1]
[techniques.none]
technique = "none"
[techniques.crytek24]
technique = "crytek"
[texts]
instructions = "Look."
start = "Start"
question = "Which?"
first = "first"
second = "second"
thanks = "Thanks"
[ordering]
{}
)",
                                   ordering);
    const std::vector<std::vector<std::string>> conditions = {{"one", "hall", "day"},
                                                              {"two", "hall", "day"},
                                                              {"three", "hall", "night"},
                                                              {"four", "box", "night"},
                                                              {"five", "box", "day"}};
    for (const auto& one : conditions)
        text += fmt::format("[[conditions]]\nid = \"{}\"\nscene = \"{}\"\nlevel = \"{}\"\n"
                            "pair = [\"none\", \"crytek24\"]\n{}",
                            one[0], one[1], one[2], one[0] == "five" ? "" : "correct = \"b\"\n");
    return text;
}

// Of the five conditions, four have a right answer, and four show a pair that no other shows.
const std::string questOrder =
    "scheme = \"quest\"\npractice = [\"five\"]\nscores = [3, 1, 2.5, -1]";
const std::string pairsOrder = "scheme = \"information\"\npractice = [\"two\"]";

Ordering read(const std::string& ordering) {
    return parseProtocol(study(ordering), "small.toml").ordering;
}

TEST(Ordering, NewStudiesHaveTheRecommendedOrder) {
    EXPECT_EQ(read("").scheme, OrderScheme::williams);
    EXPECT_EQ(read("participants = 56").scheme, OrderScheme::williams);
    const std::string text = study("");
    const Protocol without =
        parseProtocol(std::string(text).erase(text.find("[ordering]"), 11), "small.toml");
    EXPECT_EQ(without.ordering.scheme, OrderScheme::williams);
    EXPECT_EQ(without.ordering.participants, 28);
    EXPECT_EQ(without.ordering.repeats, 1);
}

TEST(Ordering, ShippedStudiesNameTheirs) {
    for (const char* file : {"aalborg-2010", "demo"})
        EXPECT_EQ(
            readProtocol(fmt::format("{}/protocols/{}.toml", OBSCURA_SOURCE, file)).ordering.scheme,
            OrderScheme::thesis);
}

TEST(Ordering, ReadsEveryKey) {
    const Ordering shuffled =
        read("scheme = \"shuffle\"\nparticipants = 12\nrepeats = 2\n"
             "apart = \"condition\"\npractice = [\"one\"]\ncatch = [\"three\"]\ncatchEvery = 2\n"
             "breakEvery = 4");
    EXPECT_EQ(shuffled.scheme, OrderScheme::shuffle);
    EXPECT_EQ(shuffled.repeats, 2);
    EXPECT_EQ(shuffled.blocks, std::nullopt);
    EXPECT_EQ(read("blocks = \"level\"").blocks, Likeness::level);
    EXPECT_EQ(shuffled.apart, Likeness::condition);
    EXPECT_THAT(shuffled.practice, ElementsAre("one"));
    EXPECT_THAT(shuffled.catches, ElementsAre("three"));
    EXPECT_EQ(shuffled.catchEvery, 2);
    EXPECT_EQ(shuffled.breakEvery, 4);

    const Ordering stairs = read("scheme = \"staircase\"\npractice = [\"five\"]\ndown = 3\nup = 2\n"
                                 "reversals = 6\ntrials = 40\nanswer = \"choice\"");
    EXPECT_EQ(stairs.scheme, OrderScheme::staircase);
    EXPECT_EQ(stairs.staircase.down, 3);
    EXPECT_EQ(stairs.staircase.up, 2);
    EXPECT_EQ(stairs.staircase.reversals, 6);
    EXPECT_EQ(stairs.staircase.trials, 40);
    EXPECT_EQ(stairs.staircase.answer, "choice");

    const Ordering quest = read(questOrder + "\ntrials = 40\nwidth = 0.5\nguess = 0");
    EXPECT_EQ(quest.scheme, OrderScheme::quest);
    EXPECT_THAT(quest.adaptive.scores, ElementsAre(3, 1, 2.5, -1));
    EXPECT_EQ(quest.adaptive.trials, 40);
    EXPECT_EQ(quest.adaptive.width, 0.5);
    EXPECT_EQ(quest.adaptive.guess, 0);
    EXPECT_EQ(read(questOrder).adaptive.guess, 0.5);
    EXPECT_EQ(adaptiveTrials(read(questOrder)), 100);

    const Ordering pairs = read(pairsOrder + "\ntrials = 30\nwidth = 1.5\nbreakEvery = 10");
    EXPECT_EQ(pairs.scheme, OrderScheme::information);
    EXPECT_EQ(pairs.adaptive.trials, 30);
    EXPECT_EQ(pairs.adaptive.width, 1.5);
    EXPECT_EQ(adaptiveTrials(pairs), 30);
    EXPECT_EQ(adaptiveTrials(read("")), 0);
}

struct OrderingMistake {
    const char* name;
    std::string ordering, message; // what follows the file's name
};
void PrintTo(const OrderingMistake& mistake, std::ostream* out) { *out << mistake.name; }

const OrderingMistake mistakes[] = {
    {"UnknownPractice", "practice = [\"on\"]",
     ":27:13: ordering.practice[1]: expected the id of a condition that is not yet named under "
     "\"practice\" or \"catch\", found \"on\"; did you mean \"one\"?"},
    {"PracticeAndCatch", "practice = [\"one\"]\ncatch = [\"two\", \"one\"]\ncatchEvery = 1",
     ":28:17: ordering.catch[2]: expected the id of a condition that is not yet named under "
     "\"practice\" or \"catch\", found \"one\"; one of: three, four, five"},
    {"NothingLeft", "practice = [\"one\", \"two\", \"three\", \"four\", \"five\"]",
     ":27:12: ordering.practice: expected a condition that is left for main trials, found none; "
     "add one, or name fewer here"},
    {"CatchWithoutNumber", "catch = [\"one\"]",
     ":27:9: ordering.catch: expected both \"catch\" and \"catchEvery\", found only one of them"},
    {"NumberWithoutCatch", "catchEvery = 2",
     ":27:14: ordering.catchEvery: expected both \"catch\" and \"catchEvery\", found only one of "
     "them"},
    {"CatchNever", "catch = [\"one\"]\ncatchEvery = 4",
     ":28:14: ordering.catchEvery: expected fewer than the 4 main trials of a session, found 4: it "
     "would never come"},
    {"BreakNever", "breakEvery = 5",
     ":27:14: ordering.breakEvery: expected fewer than the 5 main trials of a session, found 5: it "
     "would never come"},
    {"ApartWithoutShuffle", "apart = \"scene\"",
     ":27:9: ordering.apart: means nothing to the scheme \"williams\"; remove it, or choose "
     "another "
     "scheme"},
    {"ApartAndRepeated", "scheme = \"shuffle\"\nrepeats = 2\napart = \"scene\"",
     ":29:9: ordering.apart: cannot be kept: 3 of the 5 conditions have the scene \"hall\"; add "
     "others, or keep something else apart"},
    {"ApartInABlock",
     "scheme = \"shuffle\"\nblocks = \"scene\"\napart = \"level\"\n"
     "practice = [\"three\"]",
     ":29:9: ordering.apart: cannot be kept: 2 of the 2 conditions of block \"hall\" have the "
     "level "
     "\"day\"; add others, or keep something else apart"},
    {"ApartAlone",
     "scheme = \"shuffle\"\nrepeats = 2\napart = \"condition\"\n"
     "practice = [\"one\", \"two\", \"three\", \"four\"]",
     ":29:9: ordering.apart: cannot be kept: 1 of the 1 conditions have the condition \"five\"; "
     "add others, or keep something else apart"},
    {"BlocksOfConditions", "blocks = \"condition\"",
     ":27:10: ordering.blocks: expected one of \"scene\", \"level\", found \"condition\""},
    {"StaircaseKeyElsewhere", "reversals = 8",
     ":27:13: ordering.reversals: means nothing to the scheme \"williams\"; remove it, or choose "
     "another scheme"},
    {"RepeatedStaircase", "scheme = \"staircase\"\nrepeats = 2",
     ":28:11: ordering.repeats: means nothing to the scheme \"staircase\"; remove it, or choose "
     "another scheme"},
    {"NoRightAnswer", "scheme = \"staircase\"",
     ":27:10: ordering.scheme: expected a right answer to each condition of a staircase, found "
     "none "
     "to \"five\"; give it the key \"correct\""},
    {"UnknownAnswer", "scheme = \"staircase\"\nanswer = \"chioce\"",
     ":28:10: ordering.answer: expected the name of a question of the trial, found \"chioce\"; did "
     "you mean \"choice\"?"},
    {"StaircaseOfOne",
     "scheme = \"staircase\"\npractice = [\"two\", \"three\", \"four\", \"five\"]",
     ":27:10: ordering.scheme: expected a staircase of two conditions or more, found one"},
    {"ScoresElsewhere", "scores = [1, 2, 3, 4, 5]",
     ":27:10: ordering.scores: means nothing to the scheme \"williams\"; remove it, or choose "
     "another scheme"},
    {"ScoresOfPairs", pairsOrder + "\nscores = [1, 2, 3, 4]",
     ":29:10: ordering.scores: means nothing to the scheme \"information\"; remove it, or choose "
     "another scheme"},
    {"RepeatedPairs", pairsOrder + "\nrepeats = 2",
     ":29:11: ordering.repeats: means nothing to the scheme \"information\"; remove it, or choose "
     "another scheme"},
    {"ReversalsOfQuest", questOrder + "\nreversals = 8",
     ":30:13: ordering.reversals: means nothing to the scheme \"quest\"; remove it, or choose "
     "another scheme"},
    {"WidthOfAStaircase", "scheme = \"staircase\"\nwidth = 2",
     ":28:9: ordering.width: means nothing to the scheme \"staircase\"; remove it, or choose "
     "another scheme"},
    {"NoScores", "scheme = \"quest\"\npractice = [\"five\"]",
     ":27:10: ordering.scheme: expected under \"scores\" 4 different numbers, one for each "
     "condition of main trials, found 0 (0 of them different)"},
    {"TooFewScores", "scheme = \"quest\"\npractice = [\"five\"]\nscores = [1, 2, 3]",
     ":29:10: ordering.scores: expected under \"scores\" 4 different numbers, one for each "
     "condition of main trials, found 3 (3 of them different)"},
    {"EqualScores", "scheme = \"quest\"\npractice = [\"five\"]\nscores = [1, 2, 3, 1]",
     ":29:10: ordering.scores: expected under \"scores\" 4 different numbers, one for each "
     "condition of main trials, found 4 (3 of them different)"},
    {"QuestWithoutRightAnswer", "scheme = \"quest\"\nscores = [1, 2, 3, 4, 5]",
     ":27:10: ordering.scheme: expected a right answer to each condition of a quest, found none to "
     "\"five\"; give it the key \"correct\""},
    {"GuessingTooOften", questOrder + "\nguess = 0.95",
     ":30:9: ordering.guess: expected a number from 0 to 0.9, found 0.95"},
    {"NoWidth", pairsOrder + "\nwidth = 0",
     ":29:9: ordering.width: expected a number from 1e-06 to 1000000, found 0"},
    {"ThePairTwice", "scheme = \"information\"",
     ":27:10: ordering.scheme: expected each pair of images once, found that of \"one\" again as "
     "\"two\""},
    {"UnknownAnswerOfPairs", pairsOrder + "\nanswer = \"chioce\"",
     ":29:10: ordering.answer: expected the name of a question of the trial, found \"chioce\"; did "
     "you mean \"choice\"?"},
};

class OrderingMistakes : public testing::TestWithParam<OrderingMistake> {};

TEST_P(OrderingMistakes, AreNamedWithTheirPlace) {
    EXPECT_THAT([] { read(GetParam().ordering); },
                ThrowsMessage<Error>("small.toml" + GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(Ordering, OrderingMistakes, testing::ValuesIn(mistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

// The tightest that can be kept: three of five in one scene, in one pass.
TEST(Ordering, ApartIsAllowedWhereItCanJustBeKept) {
    EXPECT_NO_THROW(read("scheme = \"shuffle\"\napart = \"scene\""));
    EXPECT_NO_THROW(read("scheme = \"shuffle\"\napart = \"level\"\nrepeats = 2\n"
                         "practice = [\"one\"]"));
}

// Each thing that decides an order, and only those, is part of the design.
TEST(Ordering, AllThatDecidesAnOrderIsInTheDesign) {
    const auto design = [](const std::string& text) {
        return designOf(parseProtocol(text, "small.toml"));
    };
    const std::string shuffle = "scheme = \"shuffle\"\n", stairs = "scheme = \"staircase\"\n"
                                                                   "practice = [\"five\"]\n";
    const std::string catching = "catch = [\"one\"]\ncatchEvery = 2";
    for (const auto& [one, other] : std::vector<std::pair<std::string, std::string>>{
             {"", "scheme = \"thesis\""},
             {"", "scheme = \"latin\""},
             {"", "scheme = \"listed\""},
             {"", shuffle},
             {shuffle, shuffle + "apart = \"scene\""},
             {shuffle + "apart = \"condition\"", shuffle + "apart = \"scene\""},
             {"", "repeats = 2"},
             {"", "blocks = \"level\""},
             {"blocks = \"scene\"", "blocks = \"level\""},
             {"", "practice = [\"one\"]"},
             {"practice = [\"two\", \"one\"]", "practice = [\"one\", \"two\"]"},
             {"practice = [\"one\"]", catching},
             {catching, "catch = [\"one\"]\ncatchEvery = 3"},
             {catching, "catch = [\"two\"]\ncatchEvery = 2"},
             {"", "breakEvery = 2"},
             {stairs, stairs + "down = 1"},
             {stairs, stairs + "up = 2"},
             {stairs, stairs + "reversals = 9"},
             {stairs, stairs + "trials = 99"},
             {questOrder, questOrder + "\ntrials = 99"},
             {questOrder, questOrder + "\nwidth = 1"},
             {questOrder, questOrder + "\nguess = 0.4"},
             {questOrder, "scheme = \"quest\"\npractice = [\"five\"]\nscores = [3, 1, 2, -1]"},
             {pairsOrder, "practice = [\"two\"]"},
             {pairsOrder, pairsOrder + "\ntrials = 99"},
             {pairsOrder, pairsOrder + "\nwidth = 1"}})
        EXPECT_NE(design(study(one)), design(study(other))) << one << "\n" << other;
    EXPECT_EQ(design(study("")), design(study("scheme = \"williams\"\nrepeats = 1")));
    EXPECT_EQ(design(study("")), design(study("participants = 3")));

    std::string other = study(stairs);
    other.replace(other.find("correct = \"b\""), 13, "correct = \"a\"");
    EXPECT_NE(design(other), design(study(stairs)));
}

TEST(Ordering, ARightAnswerAmongImagesIsARole) {
    std::string text = study("scheme = \"staircase\"\npractice = [\"five\"]");
    text.replace(text.find("correct = \"b\""), 13, "correct = \"B\"");
    EXPECT_THAT(
        [&] { parseProtocol(text, "small.toml"); },
        ThrowsMessage<Error>("small.toml:27:10: ordering.scheme: expected \"a\" or \"b\" as "
                             "the right answer to \"one\", found \"B\""));
}

// Nothing to compare: questions that are no choice between images, and trials of one image.
TEST(Ordering, PairsNeedAChoiceBetweenTwoImages) {
    const auto reading = [](const std::string& phases) {
        return [phases] {
            parseProtocol(
                study("scheme = \"information\"\npractice = [\"two\"]\n[trial]\n" + phases),
                "small.toml");
        };
    };
    EXPECT_THAT(
        reading("phases = [{ name = \"p\", images = [1, 2], questions = [{ name = \"choice\", "
                "kind = \"scale\", text = \"question\", options = [\"first\", \"second\"] }] }]"),
        ThrowsMessage<Error>(testing::HasSubstr(
            "small.toml:27:10: ordering.scheme: expected a choice between images, found "
            "\"choice\", which is none")));
}

// As it was before there was a choice, or studies that run could not go on.
TEST(Ordering, TheDesignOfTheThesisSchemeIsAsItWas) {
    EXPECT_THAT(partsOf(parseProtocol(study("scheme = \"thesis\""), "small.toml")).procedure,
                testing::HasSubstr("\"ordering\":{\"scheme\":\"thesis\"},"));
}

} // namespace
} // namespace obscura
