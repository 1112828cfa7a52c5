#include "base/error.h"
#include "experiment/play.h"
#include "experiment/simulated.h"
#include "tests/experiment/tiny_study.h"

#include "inference/scales.h"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

using Jods = std::map<std::string, double>; // by role

// A study whose conditions have images of these JODs: a trial, further lines of each condition, and
// further tables.
Protocol studyOf(const std::vector<Jods>& conditions, const std::string& trial,
                 const std::string& more = "", const std::string& tables = "") {
    std::string text = "name = \"seen\"\ntitle = \"Seen\"\nseed = 1\n"
                       "[scenes.s]\nbuiltin = \"sculpture\"\n"
                       "camera = { position = [0, 1, 3], target = [0, 0.5, 0] }\nradius = 0.5\n"
                       "[levels.l]\nambient = [1, 1, 1]\n[texts]\ninstructions = \"i\"\n"
                       "thanks = \"t\"\nstart = \"s\"\nquestion = \"q\"\nfirst = \"1\"\n"
                       "second = \"2\"\n"
                       "[ordering]\nscheme = \"listed\"\n" +
                       tables + "[trial]\n" + trial;
    for (const char role : {'a', 'b', 'c', 'd', 'r'})
        text += fmt::format("[techniques.t{}]\ntechnique = \"crytek\"\nsamples = {}\n", role,
                            static_cast<int>(role));
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        text += fmt::format("[[conditions]]\nid = \"c{}\"\nscene = \"s\"\nlevel = \"l\"\n{}\n", i,
                            more);
        for (const auto& [role, jod] : conditions[i])
            text += fmt::format("roles.{} = \"t{}\"\n", role, role[0]);
    }
    return parseProtocol(text, "seen.toml");
}

Manifest imagesOf(const std::vector<Jods>& conditions) {
    Manifest manifest;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        ConditionRecord& record = manifest.conditions.emplace_back();
        record.condition = fmt::format("c{}", i);
        for (const auto& [role, jod] : conditions[i])
            record.image(role).quality = ImageQuality{0, jod, {}};
    }
    return manifest;
}

constexpr int people = 4000; // a multiple of all orders

// How often each answer was given to the first question of trials, by condition, roles in order and
// value: "0 ab 1". Each of 4000 people sees each condition once, half of them backwards.
std::map<std::string, int> answersTo(const std::vector<Jods>& conditions, const std::string& trial,
                                     const std::string& more = "", const std::string& tables = "") {
    const Protocol protocol = studyOf(conditions, trial, more, tables);
    const Manifest manifest = imagesOf(conditions);
    const std::vector<Phase> phases = phasesOf(protocol.trial);
    std::map<std::string, int> counts;
    for (int slot = 1; slot <= people; ++slot) {
        SimulatedObserver observer(protocol, 5, fmt::format("S{}", slot), &manifest);
        std::vector<PastTrial> history;
        while (const auto planned = next(protocol, slot, history)) {
            const Upcoming upcomingTrial = upcoming(protocol, *planned, 1, 1);
            TrialMachine machine(phases, static_cast<int>(upcomingTrial.order.size()), 60);
            observer.prepare(upcomingTrial);
            EXPECT_TRUE(play(machine, observer, [] {}));
            history.push_back(remember(phases, upcomingTrial, machine.record()));
            std::string order;
            for (const std::string& role : upcomingTrial.order)
                order += role;
            ++counts[fmt::format("{} {} {}", planned->condition, order,
                                 machine.record().answers.at(0).value)];
        }
    }
    return counts;
}

// Within 4.5 standard errors: a sound program fails once in 150,000 draws, and the seed is fixed.
void expectShare(int count, int of, double share, const std::string& where) {
    EXPECT_NEAR(static_cast<double>(count) / of, share, 4.5 * std::sqrt(share * (1 - share) / of))
        << where;
}

const std::string pair = "mask = 0.1\nminimumView = 0\n";

std::string asking(const std::string& question, const std::string& order = "\"a\", \"b\"") {
    return fmt::format("order = [{}]\nphases = [{{ name = \"look\", text = \"start\" }}, {{ name = "
                       "\"ask\", image = 1, questions = [{{ name = \"x\", text = \"question\", "
                       "{} }}] }}]\n",
                       order, question);
}

// R: u <- qnorm(.75); .02 + .96 * pnorm((d + qnorm(.6) / u) * u), d of -2, -1, 0, .5, 1, 2 and
// minus that.
TEST(Eyes, ChooseByPredictedJodWithLapsesAndBias) {
    const double bSecond[] = {.151155045437, .343352442323, .596,
                              .713698956323, .810323742024, .927639965245};
    const double aSecond[] = {.927639965245, .810323742024, .596,
                              .467906101296, .343352442323, .151155045437};
    const double apart[] = {-2, -1, 0, .5, 1, 2};
    std::vector<Jods> conditions;
    for (const double jod : apart)
        conditions.push_back({{"a", 7}, {"b", 7 + jod}});
    auto counts =
        answersTo(conditions, pair, "", "[simulation]\nlapse = 0.04\npositionBias = 0.1\n");
    for (std::size_t i = 0; i < std::size(apart); ++i) {
        expectShare(counts[fmt::format("{} ab 2", i)], people / 2, bSecond[i],
                    fmt::format("b second, {} JOD", apart[i]));
        expectShare(counts[fmt::format("{} ba 2", i)], people / 2, aSecond[i],
                    fmt::format("a second, {} JOD", apart[i]));
    }
}

// So many looks that 1 in place of lookDeviation would be seen: 76.0 %.
TEST(Eyes, SeeOneJodInThreeQuartersOfLooks) {
    constexpr int looks = 200'000;
    const std::vector<Jods> conditions = {{{"a", 9}, {"b", 10}}};
    const Protocol protocol = studyOf(conditions, pair);
    Eyes eyes(protocol, imagesOf(conditions), Random(1, "eyes"));
    Question which;
    which.images = true;
    which.options = {"first", "second"};
    int better = 0;
    for (int i = 0; i < looks; ++i) {
        eyes.look({1, 1, {PlannedTrial::Kind::main, 0, {0, 1}}, {"a", "b"}});
        better += eyes.answer(which, {}) == 2;
    }
    expectShare(better, looks, .75, "1 JOD");
}

TEST(Eyes, GuessInEveryLapseAndFollowAnUtterBias) {
    auto lapses = answersTo({{{"a", 2}, {"b", 10}}}, pair, "", "[simulation]\nlapse = 1\n");
    expectShare(lapses["0 ab 2"], people / 2, .5, "lapse of 1");
    auto leans = answersTo({{{"a", 8}, {"b", 9}}}, pair, "", "[simulation]\npositionBias = 0.5\n");
    EXPECT_EQ(leans["0 ab 2"] + leans["0 ba 2"], people);
}

// What the protocol says of preferences is what people without eyes go by.
TEST(Eyes, DoNotReadThePreference) {
    auto counts = answersTo({{{"a", 10}, {"b", 8}}}, pair, "simulatedPreference = 1");
    expectShare(counts["0 ab 1"] + counts["0 ba 2"], people, .911328224673824, "2 JOD");
}

// R: pnorm((-.8 - .5) * u), pnorm((.8 - .5) * u).
TEST(Eyes, MayBeUnsure) {
    auto counts = answersTo({{{"a", 7}, {"b", 7.8}}},
                            asking("options = [\"first\", \"second\"], images = true, unsure = "
                                   "\"start\""));
    expectShare(counts["0 ab 1"] + counts["0 ba 2"], people, .190287677748, "a");
    expectShare(counts["0 ab 2"] + counts["0 ba 1"], people, .580177241140, "b");
    expectShare(counts["0 ab unsure"] + counts["0 ba unsure"], people, .229535081112, "unsure");
}

// Whoever else is ranked, of two images 1 JOD apart the better stands above in 75 %.
TEST(Eyes, RankByOneWorthOfEachImage) {
    int bAboveA = 0, cAboveB = 0;
    for (const auto& [key, count] :
         answersTo({{{"a", 8}, {"b", 9}, {"c", 10}, {"d", 7}}},
                   asking("kind = \"rank\"", "\"a\", \"b\", \"c\", \"d\""))) {
        const std::string order = key.substr(2, 4), places = key.substr(7); // "2>1>4>3"
        const auto rankOf = [&](char role) {
            return places.find(static_cast<char>('1' + order.find(role)));
        };
        bAboveA += rankOf('b') < rankOf('a') ? count : 0;
        cAboveB += rankOf('c') < rankOf('b') ? count : 0;
    }
    expectShare(bAboveA, people, .75, "b above a");
    expectShare(cAboveB, people, .75, "c above b");
}

// R: s <- 1 / (u * sqrt(2)); diff(pnorm(c(-Inf, 6.5, 7.5, 8.5, 9.5, Inf), 8.3, s)).
TEST(Eyes, RateAnImageAStepForEachJod) {
    const double shares[] = {.0429922724684, .1797101913926, .3529464063480, .2981734355659,
                             .1261776942250};
    auto counts =
        answersTo({{{"a", 8.3}}}, asking("kind = \"scale\", options = [\"start\", \"question\", "
                                         "\"first\", \"second\", \"thanks\"]",
                                         "\"a\""));
    for (int step = 1; step <= 5; ++step)
        expectShare(counts[fmt::format("0 a {}", step)], people, shares[step - 1],
                    fmt::format("step {}", step));
}

// R: diff(pnorm(c(-Inf, -2.5, -1.5, -.5, .5, 1.5, 2.5, Inf), .8, s * sqrt(2))).
TEST(Eyes, CompareTheSecondImageWithTheFirst) {
    const double shares[] = {.0130132484424, .0473984901382, .1298759391669, .2295350811129,
                             .2617648178438, .1926456696130, .1257667536828};
    auto counts = answersTo({{{"a", 8}, {"b", 8.8}}},
                            asking("kind = \"scale\", lowest = -3, options = [\"start\", "
                                   "\"question\", \"first\", \"second\", \"thanks\", "
                                   "\"instructions\", \"start\"]"));
    for (int step = -3; step <= 3; ++step) {
        expectShare(counts[fmt::format("0 ab {}", step)], people / 2, shares[step + 3],
                    fmt::format("b compared with a: {}", step));
        expectShare(counts[fmt::format("0 ba {}", -step)], people / 2, shares[step + 3],
                    fmt::format("a compared with b: {}", -step));
    }
}

// A question with a right answer may ask for the worse image: which of them flickers.
TEST(Eyes, FindTheRightAnswerWhicheverIsBetter) {
    for (const char* correct : {"a", "b"}) {
        const bool isA = correct[0] == 'a';
        auto counts =
            answersTo({{{"a", 9}, {"b", 10}}}, pair, fmt::format("correct = \"{}\"", correct));
        expectShare(counts[isA ? "0 ab 1" : "0 ab 2"] + counts[isA ? "0 ba 2" : "0 ba 1"], people,
                    .75, correct);
    }
}

// Of boosted triplets, whose images take turns with the source: which flickers more?
TEST(Eyes, SeeTheWorseImageFlicker) {
    auto counts = answersTo({{{"a", 9}, {"b", 10}, {"r", 10}}},
                            asking("options = [\"first\", \"second\"], images = true"), "",
                            "[boost]\nreference = \"r\"\n");
    expectShare(counts["0 ab 1"] + counts["0 ba 2"], people, .75, "a flickers");
}

// The differences' sum and difference are independent normals. R: s as above; p <- pnorm((7 - 10) /
// (s * sqrt(2))); q <- pnorm((7 + 10 - 2 * 8.2) / (s * sqrt(6))); 1 - (p * q + (1 - p) * (1 - q)).
TEST(Eyes, CompareDifferencesOfTriads) {
    auto counts =
        answersTo({{{"a", 7}, {"b", 8.2}, {"c", 10}}},
                  "order = [\"a\", \"c\"]\nphases = [{ name = \"ask\", images = [1, "
                  "\"b\", 2], questions = [{ name = \"x\", text = \"question\", options = "
                  "[\"first\", \"second\"], images = true }] }]\n");
    expectShare(counts["0 ac 2"] + counts["0 ca 1"], people, .588397413866, "c is farther from b");
}

// A ladder of 4 images; each of 4000 people sees all six pairs once.
TEST(Eyes, GiveBackTheScaleByWhichTheyChose) {
    const double truth[] = {6.9, 7.6, 8.5, 10};
    std::vector<Jods> conditions;
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) {
            conditions.push_back({{"a", truth[i]}, {"b", truth[j]}});
            pairs.emplace_back(i, j);
        }
    auto counts = answersTo(conditions, pair);
    Wins wins = Wins::Zero(4, 4);
    for (std::size_t c = 0; c < pairs.size(); ++c) {
        const auto& [a, b] = pairs[c];
        wins(a, b) = counts[fmt::format("{} ab 1", c)] + counts[fmt::format("{} ba 2", c)];
        wins(b, a) = people - wins(a, b);
    }
    const auto scale = thurstone(wins);
    ASSERT_TRUE(scale);
    for (int i = 0; i < 3; ++i) {
        const Estimate found = difference(*scale, 3, i);
        EXPECT_NEAR(found.value, truth[3] - truth[i], 3.5 * found.standardError) << truth[i];
        EXPECT_LT(found.standardError, 0.1);
    }
}

TEST(Eyes, NeedImagesWhoseJodIsPredicted) {
    const std::vector<Jods> conditions = {{{"a", 9}, {"b", 10}}};
    Manifest manifest = imagesOf(conditions);
    manifest.folder = "images";
    manifest.conditions[0].image("b").quality.reset();
    const Protocol protocol = studyOf(conditions, pair);
    EXPECT_THAT([&] { SimulatedObserver(protocol, 1, "S01", &manifest); },
                ThrowsMessage<Error>(AllOf(HasSubstr("images/manifest.json: c0.b.quality"),
                                           HasSubstr("generate them anew"))));
    EXPECT_NO_THROW(SimulatedObserver(protocol, 1, "S01"));
}

TEST(Eyes, AreDescribedInTheSidecar) {
    const std::vector<Jods> conditions = {{{"a", 9}, {"b", 10}}};
    Manifest manifest = imagesOf(conditions);
    manifest.display = displays().front();
    const Protocol protocol = studyOf(conditions, pair, "", "[simulation]\nlapse = 0.02\n");
    nlohmann::ordered_json sees, prefers;
    SimulatedObserver(protocol, 1, "S01", &manifest).describe(sees);
    SimulatedObserver(protocol, 1, "S01").describe(prefers);
    EXPECT_EQ(sees["model"]["observer"], "jod");
    EXPECT_EQ(sees["model"]["lapse"], 0.02);
    EXPECT_EQ(sees["model"]["predicted_by"], "ColorVideoVDP");
    EXPECT_EQ(sees["model"]["display"], inWords(displays().front()));
    EXPECT_EQ(prefers["model"]["observer"], "preference");
    EXPECT_FALSE(prefers["model"].contains("lapse"));
}

} // namespace
} // namespace obscura
