#include "base/files.h"
#include "protocols/reader/claims.h"
#include "protocols/reader/design.h"
#include "protocols/reader/protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace obscura {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Conditions "low" and "low-again" at level low, "high" at level high; "watched" is a catch trial.
std::string study(const std::string& declared) {
    return R"(name = "small"
seed = 7
[scenes.hall]
builtin = "atrium"
radius = 0.2
camera = { position = [0, 1, 3], target = [0, 0.5, 0] }
[levels.low]
ambient = [1, 1, 1]
[levels.high]
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
catch = ["watched"]
catchEvery = 2
[[conditions]]
id = "low"
scene = "hall"
level = "low"
pair = ["none", "crytek24"]
[[conditions]]
id = "low-again"
scene = "hall"
level = "low"
pair = ["none", "crytek24"]
[[conditions]]
id = "high"
scene = "hall"
level = "high"
pair = ["none", "crytek24"]
[[conditions]]
id = "watched"
scene = "hall"
level = "high"
pair = ["none", "crytek24"]
correct = "b"
)" + declared;
}

Protocol parsed(const std::string& declared) {
    return parseProtocol(study(declared), "small.toml");
}

auto fails(const std::string& text) { return ThrowsMessage<Error>(HasSubstr(text)); }

const std::string three = R"([[claims]]
name = "Occlusion raises realism"
kind = "superior"
conditions = ["low", "high"]
[[claims]]
name = "None is as good in plain light"
kind = "equivalent"
conditions = ["low"]
margin = 0.15
family = "accuracy"
[[claims]]
name = "None is liked less and less"
kind = "trend"
favours = "a"
conditions = ["high", "low", "low-again"]
[exclusions]
catches = 0.75
onePosition = 0.9
fastest = 0.2
incomplete = true
)";

TEST(Claims, SayWhatIsShownOfWhichConditions) {
    const Protocol protocol = parsed(three);
    ASSERT_EQ(protocol.claims.size(), 3u);
    const Claim& superior = protocol.claims[0];
    EXPECT_EQ(superior.name, "Occlusion raises realism");
    EXPECT_EQ(superior.kind, Claim::Kind::superior);
    EXPECT_THAT(superior.conditions, ElementsAre("low", "high"));
    EXPECT_EQ(superior.favours, "b");
    EXPECT_EQ(superior.family, "");
    EXPECT_EQ(protocol.claims[1].kind, Claim::Kind::equivalent);
    EXPECT_EQ(protocol.claims[1].margin, 0.15);
    EXPECT_EQ(protocol.claims[1].family, "accuracy");
    EXPECT_EQ(protocol.claims[2].favours, "a");
    EXPECT_EQ(protocol.exclusions.catches, 0.75);
    EXPECT_EQ(protocol.exclusions.onePosition, 0.9);
    EXPECT_EQ(protocol.exclusions.fastest, 0.2);
    EXPECT_TRUE(protocol.exclusions.incomplete);
    EXPECT_FALSE(protocol.exclusions.interrupted);
}

TEST(Claims, OfATrendCountLevelsInTheirOrderUnlessScored) {
    EXPECT_THAT(parsed(three).claims[2].scores, ElementsAre(1, 2, 2));
    const Protocol scored = parsed("[[claims]]\nname = \"x\"\nkind = \"trend\"\n"
                                   "conditions = [\"low\", \"low-again\"]\nscores = [0.1, 0.3]\n");
    EXPECT_THAT(scored.claims[0].scores, ElementsAre(0.1, 0.3));
}

TEST(Claims, ArePartOfTheDesignAndReadBackFromIt) {
    const Protocol protocol = parsed(three), silent = parsed("");
    const std::string design = designOf(protocol);
    const auto kept = [](const std::string& text) { return "{\"design\": " + text + "}"; };
    const Declared declared = declaredIn(kept(design), "design.json");
    EXPECT_EQ(declared.sha256, sha256(design));
    EXPECT_THAT(declared.order, ElementsAre("low", "low-again", "high", "watched"));
    EXPECT_EQ(declared.claims, protocol.claims);
    EXPECT_EQ(declared.exclusions, protocol.exclusions);
    EXPECT_EQ(declared.correct.at("watched"), "b");
    EXPECT_TRUE(declaredIn(kept(designOf(silent)), "design.json").claims.empty());
    EXPECT_NE(design, designOf(silent));
    // Studies that claim nothing keep the design that they had.
    EXPECT_THAT(designOf(silent), AllOf(Not(HasSubstr("claims")), Not(HasSubstr("exclusions"))));
    EXPECT_THAT([] { declaredIn("{\"design\": {\"claims\": 3}}", "d.json"); },
                fails("d.json: expected a study"));
    EXPECT_THAT([] { declaredIn("{\"design\": {\"claims\": [{\"name\": \"x\"}]}}", "d.json"); },
                fails("expected a study's design"));
    EXPECT_THAT([] { declaredIn("nothing", "d.json"); }, fails("no JSON object"));
}

TEST(Claims, MistakesAreNamedWithTheirPlace) {
    const auto claim = [](const std::string& keys) {
        return [keys] { parsed("[[claims]]\nname = \"x\"\n" + keys); };
    };
    EXPECT_THAT(claim("conditions = [\"low\"]\n"), fails("claims[1].kind"));
    EXPECT_THAT(claim("kind = \"better\"\nconditions = [\"low\"]\n"), fails("superior"));
    EXPECT_THAT(claim("kind = \"superior\"\nconditions = [\"lwo\"]\n"),
                fails("did you mean \"low\""));
    EXPECT_THAT(claim("kind = \"superior\"\nconditions = [\"watched\"]\n"),
                fails("expected the id of a condition"));
    EXPECT_THAT(claim("kind = \"superior\"\nconditions = [\"low\", \"low\"]\n"), fails("again"));
    EXPECT_THAT(claim("kind = \"superior\"\nconditions = [\"low\"]\nmargin = 0.1\n"),
                fails("means nothing to a claim of kind \"superior\""));
    EXPECT_THAT(claim("kind = \"equivalent\"\nconditions = [\"low\"]\n"), fails("margin"));
    EXPECT_THAT(claim("kind = \"equivalent\"\nmargin = 0.7\nconditions = [\"low\"]\n"),
                fails("margin"));
    EXPECT_THAT(claim("kind = \"trend\"\nconditions = [\"low\", \"low-again\"]\n"),
                fails("found all alike"));
    EXPECT_THAT(claim("kind = \"trend\"\nscores = [1]\nconditions = [\"low\", \"high\"]\n"),
                fails("expected a number for each of the 2 conditions"));
    EXPECT_THAT(claim("kind = \"superior\"\nconditions = [\"low\"]\nfamly = \"x\"\n"),
                fails("famly"));
    EXPECT_THAT(
        [] {
            parsed("[[claims]]\nname = \"x\"\nkind = \"superior\"\nconditions = [\"low\"]\n"
                   "[[claims]]\nname = \"x\"\nkind = \"superior\"\nconditions = [\"high\"]\n");
        },
        fails("found \"x\" again"));
    EXPECT_THAT([] { parsed("[exclusions]\nonePosition = 0.3\n"); }, fails("onePosition"));
    EXPECT_THAT([] { parsed("[exclusions]\nslow = 3\n"); }, fails("slow"));
}

TEST(Claims, OfCatchTrialsNeedRightAnswers) {
    std::string text = study("[exclusions]\ncatches = 0.5\n");
    text.erase(text.find("correct = \"b\"\n"), 14);
    EXPECT_THAT([&] { parseProtocol(text, "small.toml"); },
                fails("expected catch trials with a right answer"));
}

} // namespace
} // namespace obscura
