#include "base/error.h"
#include "protocols/reader/design.h"
#include "protocols/reader/protocol.h"
#include "tests/error_of.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A study with these lines of [trial] and of its only condition.
std::string study(const std::string& trial,
                  const std::string& roles = "pair = [\"none\", \"crytek24\"]") {
    return fmt::format(R"(name = "small"
seed = 7
[scenes.box]
builtin = "sculpture"
camera = {{ position = [0, 1, 3], target = [0, 0.5, 0] }}
radius = 0.2
[levels.day]
ambient = [1, 1, 1]
[techniques.none]
technique = "none"
[techniques.crytek24]
technique = "crytek"
[[conditions]]
id = "one"
scene = "box"
level = "day"
{}
[texts]
instructions = "Look."
start = "Start"
question = "Which?"
first = "first"
second = "second"
thanks = "Thanks"
)",
                       roles) +
           trial;
}

Protocol parsed(const std::string& trial,
                const std::string& roles = "pair = [\"none\", \"crytek24\"]") {
    return parseProtocol(study(trial, roles), "small.toml");
}

std::string errorOf(const std::string& trial,
                    const std::string& roles = "pair = [\"none\", \"crytek24\"]") {
    return test::errorOf([&] { parsed(trial, roles); });
}

// One phase after an image, so that the study has one.
std::string phase(const std::string& lines) {
    return "[[trial.phases]]\nname = \"look\"\nimage = 1\n[[trial.phases]]\nname = \"it\"\n" +
           lines;
}

std::string asked(const std::string& question) {
    return phase("questions = [ { name = \"q\", " + question + " } ]\n");
}

TEST(TrialPhases, OfTheShorthandAreThoseOfAPair) {
    const std::vector<Phase> phases = phasesOf(Trial{0.3, 90, 1.5, {}});
    std::vector<std::string> names;
    for (const Phase& each : phases)
        names.push_back(each.name);
    EXPECT_THAT(names, ElementsAre("start", "first", "mask", "second", "question"));
    EXPECT_EQ(phases[1].atLeast, 1.5);
    EXPECT_TRUE(phases[2].locked());
    EXPECT_EQ(phases[2].grey, 90);
    EXPECT_EQ(phases[2].seconds, 0.3);
    EXPECT_THAT(phases[3].images, ElementsAre("2"));
    EXPECT_TRUE(phases[4].questions.at(0).images);
}

TEST(TrialPhases, AreLockedWhereTimeEndsThemAndNoKeyDoes) {
    const Protocol protocol = parsed(phase("grey = 40\nframes = 30\n"));
    const Phase& grey = protocol.trial.given.at(1);
    EXPECT_TRUE(grey.counted());
    EXPECT_TRUE(grey.locked());
    EXPECT_EQ(grey.grey, 40);
    EXPECT_FALSE(parsed(phase("image = 2\nseconds = 4\nkey = true\n")).trial.given.at(1).locked());
}

TEST(TrialPhases, BelongToTheDesign) {
    const std::string one = designOf(parsed(phase("grey = 40\nseconds = 2\n"))),
                      other = designOf(parsed(phase("grey = 40\nseconds = 3\n")));
    EXPECT_THAT(differences(one, other), ElementsAre("trial.phases.it.seconds was 2, is now 3"));
}

struct Mistake {
    const char* name;
    std::string trial;
    const char* message;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class TrialMistake : public testing::TestWithParam<Mistake> {};

TEST_P(TrialMistake, IsNamedWithItsPlace) {
    const std::string error = errorOf(GetParam().trial);
    EXPECT_THAT(error, testing::StartsWith("small.toml:"));
    EXPECT_THAT(error, HasSubstr(GetParam().message));
}

const Mistake mistakes[] = {
    {"NothingShown", phase("seconds = 1\n"),
     "trial.phases[2]: expected one of \"image\", \"images\", \"grey\", \"text\" and \"questions\" "
     "(which images may stand beside), found none"},
    {"TwoThings", phase("image = 1\ngrey = 3\n"), "found several"},
    {"NothingEndsIt", phase("image = 2\nkey = false\n"),
     "trial.phases[2].key: nothing ends this phase"},
    {"TwoTimes", phase("grey = 3\nseconds = 1\nframes = 3\n"),
     "trial.phases[2].frames: expected \"seconds\" or \"frames\", found both"},
    {"NoSuchPlace", phase("image = 3\n"),
     "trial.phases[2]: expected a place from 1 to 2, the number of roles in \"order\", found 3"},
    {"PlaceZero", phase("image = \"0\"\n"), "expected a place from 1 to 2"},
    {"NoSuchRole", phase("image = \"reference\"\n"),
     "conditions[1].pair: expected an image \"reference\", which the trial shows, found none"},
    {"ListOfOne", phase("images = [1]\n"), "expected a list of two images or more"},
    {"AlternatesUncounted", phase("images = [1, 2]\nalternate = 0.1\n"),
     "trial.phases[2].alternate: expected two images or more and \"seconds\" or \"frames\""},
    {"TurnsWithoutAlternate", phase("images = [[1, 2], [2, 1]]\nseconds = 1\n"),
     "trial.phases[2].images: expected \"alternate\""},
    {"UnequalTurns", phase("images = [[1, 2], [2, 1, 2]]\nalternate = 0.1\nseconds = 1\n"),
     "expected as many images in turn at each place, found 2 and 3"},
    {"NoTurn", phase("images = [[], []]\nalternate = 0.1\nseconds = 1\n"),
     "expected two images or more in turn at a place, found "},
    {"AlternatesBesideQuestions",
     phase("images = [1, 2]\nalternate = 0.1\nseconds = 1\nquestions = [{ name = \"q\", kind = "
           "\"text\" }]\n"),
     "trial.phases[2].alternate: expected no questions beside images that alternate"},
    {"LeastWithoutKey", phase("image = 2\nseconds = 2\natLeast = 1\n"),
     "trial.phases[2].atLeast: expected \"atLeast\" only where a key ends the phase"},
    {"NameTwice", phase("image = 2\n") + "[[trial.phases]]\nname = \"it\"\ngrey = 1\nframes = 1\n",
     "trial.phases[3]: expected a new name, found \"it\" again"},
    {"AnswerTwice",
     phase(
         "questions = [ { name = \"q\", kind = \"text\" }, { name = \"q\", kind = \"text\" } ]\n"),
     "expected a new name, found \"q\" again"},
    {"MaskOfTheShorthand", "[trial]\nmask = 2\n" + phase("image = 2\n"), "trial.mask: unknown key"},
    {"UnknownKind", asked("kind = \"chioce\""), "did you mean \"choice\"?"},
    {"OneOption", asked("options = [\"first\"]"), "expected 2 to 10 options"},
    {"NoOptions", asked("kind = \"scale\""), "expected 2 to 10 options"},
    {"EmptyRange", asked("kind = \"slider\", least = 3, most = 3"),
     "expected more than \"least\", 3, found 3"},
    {"TextMissing", phase("text = \"owm\"\n"), "texts.owm: expected a text in quotes"},
    {"OrderTwice", "[trial]\norder = [\"a\", \"a\"]\n" + phase("image = 2\n"),
     "trial.order[2]: expected a new name, found \"a\" again"},
};
INSTANTIATE_TEST_SUITE_P(All, TrialMistake, testing::ValuesIn(mistakes),
                         [](const auto& param) { return std::string(param.param.name); });

// Pages around the trials.

constexpr const char* consent = R"([[before]]
name = "consent"
text = "start"
questions = [ { name = "consent", text = "question", options = ["first", "second"], endsUnless = ["first"] } ]
[[after]]
name = "mood"
questions = [ { name = "mood", kind = "number", least = 0, most = 9, optional = true } ]
)";

TEST(Pages, AreThoseBeforeAndAfterTheTrials) {
    const Protocol protocol = parsed(consent);
    ASSERT_EQ(protocol.before.size(), 1u);
    ASSERT_EQ(protocol.after.size(), 1u);
    const Question& question = protocol.before[0].questions[0];
    EXPECT_THAT(question.endsUnless, ElementsAre("first"));
    EXPECT_TRUE(admits(question, "1"));
    EXPECT_FALSE(admits(question, "2"));
    EXPECT_FALSE(admits(question, "")) << "nothing was answered in time";
    EXPECT_TRUE(admits(protocol.after[0].questions[0], ""));
}

TEST(Pages, OfAScaleAdmitByItsNumbers) {
    Question scale;
    scale.kind = Question::Kind::scale;
    scale.options = {"bad", "fair", "good"};
    scale.lowest = -1;
    scale.endsUnless = {"fair", "good"};
    EXPECT_FALSE(admits(scale, "-1"));
    EXPECT_TRUE(admits(scale, "0"));
    EXPECT_TRUE(admits(scale, "1"));
}

TEST(Pages, BelongToTheDesignOfStudiesThatHaveThem) {
    EXPECT_EQ(designOf(parsed("")).find("before"), std::string::npos);
    const std::string with = designOf(parsed(consent));
    std::string other = consent;
    other.replace(other.find("[\"first\"]"), 9, "[\"second\"]");
    EXPECT_THAT(differences(with, designOf(parsed(other))),
                ElementsAre(HasSubstr("before.consent.questions.consent.endsUnless")));
}

TEST(Pages, ThatCannotBeAreRefused) {
    const auto error = [](const std::string& lines, const std::string& kind = "before") {
        return errorOf("[[" + kind + "]]\nname = \"it\"\n" + lines);
    };
    EXPECT_THAT(error("grey = 3"), HasSubstr("before[1]: expected \"text\" or \"questions\""));
    EXPECT_THAT(error("image = 1"), HasSubstr("expected \"text\" or \"questions\""));
    EXPECT_THAT(error("text = \"start\"\nprogress = true"), HasSubstr("no \"progress\" outside"));
    EXPECT_THAT(error("text = \"nowhere\""), HasSubstr("texts.nowhere"));
    const auto question = [&](const std::string& more, const std::string& kind = "before") {
        return error("questions = [ { name = \"q\", options = [\"first\", \"second\"], " + more +
                         " } ]",
                     kind);
    };
    EXPECT_THAT(question("endsUnless = [\"frist\"]"),
                HasSubstr("expected one of the question's options, found \"frist\"; did you mean"));
    EXPECT_THAT(question("endsUnless = []"), HasSubstr("endsUnless"));
    EXPECT_THAT(question("endsUnless = [\"first\"], optional = true"),
                HasSubstr("no \"optional\""));
    EXPECT_THAT(question("images = true"), HasSubstr("no question about images"));
    EXPECT_THAT(question("endsUnless = [\"first\"]", "after"),
                HasSubstr("only in questions of [[before]]"));
    EXPECT_THAT(question("endsUnless = [\"first\"]", "trial.phases"),
                HasSubstr("only in questions of [[before]]"));
}

TEST(Screen, SaysFromWhereAndHowLarge) {
    const Protocol protocol = parsed("[screen]\ndistanceCm = 60\ndegrees = [20, 11]\n"
                                     "pixelsPerDegree = { min = 40 }\n");
    EXPECT_EQ(protocol.screen.distanceCm, 60);
    EXPECT_EQ((*protocol.screen.degrees)[1], 11);
    EXPECT_EQ((*protocol.screen.pixelsPerDegree)[0], 40);
    EXPECT_NE(designOf(protocol), designOf(parsed("[screen]\ndistanceCm = 61\n")));
    EXPECT_EQ(designOf(parsed("")).find("screen"), std::string::npos);
}

TEST(Screen, ThatCannotBeIsRefused) {
    EXPECT_THAT(errorOf("[screen]\ndegrees = [20, 11]\n"), HasSubstr("screen.distanceCm"));
    EXPECT_THAT(errorOf("[screen]\ndistanceCm = 0\n"), HasSubstr("screen.distanceCm"));
    EXPECT_THAT(errorOf("[screen]\ndistanceCm = nan\n"), HasSubstr("screen.distanceCm"));
    EXPECT_THAT(errorOf("[screen]\ndistanceCm = 60\ndegrees = [20]\n"),
                HasSubstr("found 1 numbers"));
    EXPECT_THAT(errorOf("[screen]\ndistanceCm = 60\npixelsPerDegree = { min = 9, max = 8 }\n"),
                HasSubstr("pixelsPerDegree.max"));
}

// What is predicted on it decides neither pictures nor procedure: studies that have begun go on.
TEST(Display, IsNoPartOfTheDesign) {
    const Protocol without = parsed("");
    EXPECT_EQ(without.display, displays().front());
    const Protocol protocol = parsed("[display]\nname = \"laptop\"\npeak = 150\n");
    EXPECT_EQ(protocol.display.peak, 150);
    EXPECT_EQ(protocol.display.width, 1280);
    EXPECT_EQ(designOf(protocol), designOf(without));
    EXPECT_NE(partsOf(protocol).texts, partsOf(without).texts);
    EXPECT_EQ(partsOf(without).texts.find("\"display\""), std::string::npos);
    EXPECT_THAT(errorOf("[display]\nname = \"laptob\"\n"), HasSubstr("display.name"));
    EXPECT_THAT(errorOf("[display]\nlux = 3\n"), HasSubstr("display.lux"));
}

TEST(Display, StandsWhereTheScreenIsSeenFrom) {
    const std::string screen = "[screen]\ndistanceCm = 75\n";
    EXPECT_EQ(parsed(screen).display.distance, 0.75);
    EXPECT_EQ(parsed(screen + "[display]\ndistanceCm = 50\n").display.distance, 0.5);
}

TEST(Roles, MayBeAnyNumberAndAreSortedByName) {
    const Protocol protocol =
        parsed("[trial]\norder = [\"c\"]\n[[trial.phases]]\nname = \"look\"\nimage = 1\n"
               "[[trial.phases]]\nname = \"other\"\nimage = \"reference\"\n",
               "roles = { reference = \"none\", c = \"crytek24\" }");
    ASSERT_EQ(protocol.conditions[0].roles.size(), 2u);
    EXPECT_EQ(protocol.conditions[0].roles[0].name, "c");
    EXPECT_EQ(protocol.conditions[0].roles[1].technique, "none");
}

TEST(Roles, ThatCannotBeAreRefused) {
    const std::string trial = phase("image = 2\n");
    EXPECT_THAT(errorOf(trial, "roles = { a = \"none\", b = \"crytek24\", 1x = \"none\" }"),
                HasSubstr("conditions[1].roles.1x: expected a role that begins with a letter"));
    EXPECT_THAT(errorOf(trial, "roles = { a = \"none\" }"),
                HasSubstr("expected an image \"b\", which the trial shows, found none"));
    EXPECT_THAT(errorOf(trial, "roles = { a = \"none\", b = \"none\" }"),
                HasSubstr("expected different techniques, found \"none\" twice"));
    EXPECT_THAT(errorOf(trial, "roles = { a = \"none\", b = \"crytek24\" }\n"
                               "pair = [\"none\", \"crytek24\"]"),
                HasSubstr("found both"));
    EXPECT_THAT(errorOf(trial, "roles = { a = \"none\", b = \"cryteck24\" }"),
                HasSubstr("did you mean \"crytek24\"?"));
}

} // namespace
} // namespace obscura
