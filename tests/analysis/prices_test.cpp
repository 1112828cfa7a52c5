// Milliseconds, people's JOD and predicted ones: of rows of pairs, with stimuli that tell prices.
#include "analysis/prices/label_places.h"
#include "analysis/prices/prediction.h"
#include "analysis/prices/price_axes.h"
#include "analysis/prices/price_figure.h"
#include "analysis/prices/price_table.h"
#include "analysis/prices/price_words.h"
#include "analysis/results.h"
#include "base/csv.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace obscura {
namespace {

using testing::HasSubstr;

// The tournament of psychophysics.md 5.3, whose scale is R's: None 0, Crytek24 0.293, Blizzard24
// 0.906, RayMarching30 1.119. Its last technique stands for ray tracing here.
struct Pair {
    std::string a, b;
    int chosenB; // of 24
};
const std::vector<Pair> tournament = {
    {"None", "Crytek24", 14},          {"None", "Blizzard24", 18},
    {"None", "RayMarching30", 18},     {"Crytek24", "Blizzard24", 14},
    {"Crytek24", "RayMarching30", 19}, {"Blizzard24", "RayMarching30", 12},
};

struct Technique {
    std::string name, id;
    std::optional<double> milliseconds;
    double jod, rmse;
};
const std::vector<Technique> techniques = {{"None", "none", 0, 6.9, 0.2},
                                           {"Crytek24", "crytek", 0.5, 7.0, 0.15},
                                           {"Blizzard24", "blizzard", 2, 9, 0.05},
                                           {"RayMarching30", "ray_traced", std::nullopt, 10, 0}};

std::vector<Tally> tallies(const std::vector<Pair>& pairs, int times, const std::string& scene) {
    std::vector<Tally> all;
    for (const Pair& pair : pairs) {
        Tally tally;
        tally.condition = fmt::format("{}-{}-{}", scene, pair.a, pair.b);
        tally.level = "sky";
        tally.scene = scene;
        tally.techniqueA = pair.a;
        tally.techniqueB = pair.b;
        tally.votes = {times * (24 - pair.chosenB), times * pair.chosenB};
        all.push_back(tally);
    }
    return all;
}

Manifest stimuliOf(const std::vector<Tally>& all, const std::vector<Technique>& prices) {
    Manifest stimuli;
    for (const Tally& tally : all) {
        ConditionRecord record;
        record.condition = tally.condition;
        record.view = tally.scene;
        record.level = tally.level;
        for (const auto& [role, name] :
             {std::pair("a", tally.techniqueA), std::pair("b", tally.techniqueB)})
            for (const Technique& one : prices)
                if (one.name == name) {
                    ImageRecord& image = record.image(role);
                    image.name = name;
                    image.recipe.technique = one.id;
                    image.recipe.sceneSha256 = tally.scene;
                    image.milliseconds = one.milliseconds;
                    image.quality = ImageQuality{one.rmse, one.jod, {}};
                }
        stimuli.conditions.push_back(record);
    }
    return stimuli;
}

Findings study(const std::vector<Pair>& pairs, int times,
               const std::vector<Technique>& prices = techniques,
               const std::vector<std::string>& scenes = {"atrium"}) {
    std::vector<Tally> all;
    for (const std::string& scene : scenes)
        for (const Tally& tally : tallies(pairs, times, scene))
            all.push_back(tally);
    Findings findings{"Ladder", all, std::nullopt, stimuliOf(all, prices)};
    findings.scales = scaleFindings(all, nullptr, &*findings.stimuli);
    return findings;
}

std::vector<PricedScale> pricesOf(const Findings& findings) {
    return pricedScales(findings.scales, *findings.stimuli);
}

TEST(Prices, PutPeoplesJodBesideMillisecondsRelativeToRayTracing) {
    const std::vector<PricedScale> all = pricesOf(study(tournament, 1));
    ASSERT_EQ(all.size(), 1u);
    const PricedScale& scale = all[0];
    EXPECT_TRUE(scale.isTraced);
    ASSERT_EQ(scale.techniques.size(), 4u);
    EXPECT_EQ(scale.reference, 3u);
    EXPECT_EQ(scale.techniques[0].milliseconds, 0);
    EXPECT_EQ(scale.techniques[3].milliseconds, std::nullopt);
    // R: relative to the last, whose distance from the first is 1.119 (0.287).
    EXPECT_NEAR(scale.techniques[0].people, -1.11868732395, 1e-6);
    EXPECT_NEAR(*scale.techniques[0].standardError, 0.287145220569, 1e-5);
    EXPECT_NEAR(*scale.techniques[0].interval.high, -1.11868732395 + 1.959964 * 0.287145220569,
                1e-4);
    EXPECT_NEAR(scale.techniques[1].people, 0.292984169 - 1.11868732395, 1e-6);
    EXPECT_NEAR(*scale.techniques[2].predicted, -1, 1e-12);
    EXPECT_EQ(scale.techniques[3].people, 0);
    EXPECT_EQ(scale.front, (std::vector<std::size_t>{0, 1, 2, 3}));
}

// Few people: nothing is shown, and that is what is said.
TEST(Prices, ThatFewPeopleCannotJudgeAreNotCalledEqual) {
    const PricedScale scale = pricesOf(study(tournament, 1))[0];
    EXPECT_FALSE(scale.enough);
    ASSERT_TRUE(scale.untold);
    EXPECT_EQ(scale.techniques[scale.untold->technique].name, "Blizzard24");
    EXPECT_THAT(plateauSentence(scale), HasSubstr("beyond Blizzard24 (2.0 ms) nobody was shown"));
}

// The same shares of forty times as many: Blizzard24 is within half a JOD, and seen to be worse.
TEST(Prices, OfManyPeopleTellWhereMillisecondsBuyLittle) {
    const PricedScale scale = pricesOf(study(tournament, 40))[0];
    ASSERT_TRUE(scale.enough);
    EXPECT_EQ(scale.techniques[scale.enough->technique].name, "Blizzard24");
    EXPECT_EQ(scale.enough->seen, "RayMarching30");
    EXPECT_LT(scale.enough->most, 0.5);
    EXPECT_FALSE(scale.untold);
    EXPECT_THAT(plateauSentence(scale),
                HasSubstr("bought less than 0.5 JOD: RayMarching30 was seen to be better"));
}

// Nobody tells Blizzard24 from ray tracing: 12 of 24, and the same against the others.
const std::vector<Pair> alike = {
    {"None", "Crytek24", 12},          {"None", "Blizzard24", 19},
    {"None", "RayMarching30", 19},     {"Crytek24", "Blizzard24", 19},
    {"Crytek24", "RayMarching30", 19}, {"Blizzard24", "RayMarching30", 12},
};

TEST(Prices, EndWhereNothingDearerIsBetter) {
    const PricedScale scale = pricesOf(study(alike, 10))[0];
    ASSERT_TRUE(scale.enough);
    EXPECT_EQ(scale.techniques[scale.enough->technique].name, "Blizzard24");
    EXPECT_EQ(scale.enough->seen, "");
    EXPECT_THAT(plateauSentence(scale),
                HasSubstr("beyond Blizzard24 (2.0 ms) more milliseconds bought nothing that people "
                          "saw: what is dearer is at most 0."));
    // Crytek24 is as poor as None, and so no part of what pays.
    EXPECT_NE(scale.techniques[scale.front[1]].name, "Crytek24");
}

// A dear technique that is poor does not stand in the way of a cheap one that is good, but a dear
// one that is better does, although the cheap one is like the reference.
TEST(Prices, AreComparedWithAllThatIsDearer) {
    std::vector<Technique> prices = techniques;
    prices[1].milliseconds = 5; // Crytek24, dearer than Blizzard24 and poorer
    const PricedScale poor = pricesOf(study(alike, 10, prices))[0];
    ASSERT_TRUE(poor.enough);
    EXPECT_EQ(poor.techniques[poor.enough->technique].name, "Blizzard24");

    // None is like ray tracing, Blizzard24 better than both.
    const PricedScale better = pricesOf(study({{"None", "Crytek24", 12},
                                               {"None", "Blizzard24", 19},
                                               {"None", "RayMarching30", 12},
                                               {"Crytek24", "Blizzard24", 19},
                                               {"Crytek24", "RayMarching30", 12},
                                               {"Blizzard24", "RayMarching30", 5}},
                                              10))[0];
    ASSERT_TRUE(better.enough);
    EXPECT_EQ(better.techniques[better.enough->technique].name, "Blizzard24");
}

TEST(Prices, SayThatTheReferenceIsSeen) {
    const PricedScale scale = pricesOf(study({{"None", "Crytek24", 16},
                                              {"None", "Blizzard24", 20},
                                              {"None", "RayMarching30", 23},
                                              {"Crytek24", "Blizzard24", 16},
                                              {"Crytek24", "RayMarching30", 21},
                                              {"Blizzard24", "RayMarching30", 19}},
                                             10))[0];
    EXPECT_FALSE(scale.enough);
    EXPECT_FALSE(scale.untold);
    EXPECT_THAT(plateauSentence(scale), HasSubstr("Blizzard24 (2.0 ms) of RayMarching30 by 1."));
}

TEST(Prices, WithoutRayTracingAreRelativeToTheDearest) {
    std::vector<Technique> prices = techniques;
    prices[3].id = "hbao";
    prices[3].milliseconds = 1;
    const Findings findings = study(tournament, 1, prices);
    const PricedScale scale = pricesOf(findings)[0];
    EXPECT_FALSE(scale.isTraced);
    EXPECT_EQ(scale.techniques[scale.reference].name, "Blizzard24");
    EXPECT_NEAR(*scale.techniques[0].predicted, 6.9 - 9, 1e-12);
    EXPECT_EQ(ladderCsv({scale}), "");
}

TEST(Prices, OfOldManifestsLackAndThePageSaysSo) {
    std::vector<Technique> prices = techniques;
    for (Technique& one : prices)
        one.milliseconds.reset();
    Findings findings = study(tournament, 1, prices);
    for (ConditionRecord& condition : findings.stimuli->conditions)
        for (ImageRecord& image : condition.images)
            image.quality.reset();
    EXPECT_TRUE(priceFigures(findings).empty());
    EXPECT_THAT(priceSentences(pricesOf(findings)),
                testing::ElementsAre(HasSubstr("No chart of milliseconds and JOD")));
}

// Over several scenes: the geometric mean of times, each scene counted once.
TEST(Prices, OverAllScenesAreMeans) {
    Findings findings = study(tournament, 1, techniques, {"atrium", "figures"});
    for (ConditionRecord& condition : findings.stimuli->conditions)
        for (ImageRecord& image : condition.images)
            if (condition.view == "figures" && image.name == "Crytek24") {
                image.milliseconds = 8;
                image.quality->jod = 8;
            }
    const std::vector<PricedScale> all = pricesOf(findings);
    ASSERT_EQ(all.size(), 3u);
    ASSERT_TRUE(all[2].group.isPooled());
    EXPECT_NEAR(*all[2].techniques[1].milliseconds, 2, 1e-12); // of 0.5 and 8
    EXPECT_NEAR(*all[2].techniques[1].predicted, -2.5, 1e-12); // of -3 and -2
}

TEST(Prices, AreReadByChooseAsLadderCsv) {
    const std::string csv =
        ladderCsv(pricesOf(study(tournament, 1, techniques, {"atrium", "figures"})));
    const std::vector<CsvRecord> records = splitCsv(csv);
    ASSERT_EQ(records.size(), 9u); // no line of both scenes together
    checkHeader(records[0],
                {"scene", "level", "technique", "name", "milliseconds", "jod_people", "low", "high",
                 "jod_predicted", "rmse"},
                "ladder.csv");
    EXPECT_EQ(records[1].cells[2], "none");
    EXPECT_EQ(records[1].cells[4], "0");
    EXPECT_EQ(records[3].cells[3], "Blizzard24");
    EXPECT_EQ(records[3].cells[8], "9");
    EXPECT_EQ(records[4].cells,
              (std::vector<std::string>{"atrium", "sky", "ray_traced", "RayMarching30", "", "0",
                                        "0", "0", "10", "0"}));
}

TEST(Prices, StandInTheResultsOfPrograms) {
    const Findings findings = study(tournament, 1);
    const std::string csv = resultsCsv(findings);
    EXPECT_THAT(csv,
                HasSubstr("scale,\"thurstone: atrium, sky: Blizzard24\",jod_people,-0.2127149"));
    EXPECT_THAT(csv, HasSubstr("scale,\"thurstone: atrium, sky: Blizzard24\",milliseconds,2\n"));
    EXPECT_THAT(csv, HasSubstr("scale,\"bradley-terry: atrium, sky: Blizzard24\",value,0.99361"));
    const auto json = nlohmann::json::parse(resultsJson(findings, nlohmann::ordered_json()));
    const auto& scale = json["scales"][0];
    EXPECT_EQ(scale["unit"], "JOD");
    EXPECT_EQ(scale["reference"], "RayMarching30");
    EXPECT_NEAR(scale["items"][0]["statistics"]["jod_people"].get<double>(), -1.11868732395, 1e-6);
    EXPECT_FALSE(scale["items"][3]["statistics"].contains("milliseconds"));
    EXPECT_FALSE(scale["items"][3]["statistics"].contains("jod_people_low"));
}

TEST(Prediction, IsHeldAgainstPeopleInEveryScene) {
    const Prediction prediction =
        predictionOf(pricesOf(study(tournament, 1, techniques, {"atrium", "figures"})));
    ASSERT_EQ(prediction.points.size(), 6u); // three in each of two, without the reference
    EXPECT_EQ(prediction.places, 2u);
    // R: cor(c(-3.1, -3, -1), c(0, .292984169, .905972342) - 1.11868732395), twice the same.
    EXPECT_NEAR(prediction.line->value, 0.960997996952, 1e-6);
    EXPECT_DOUBLE_EQ(prediction.ranks->value, 1);
    EXPECT_THAT(predictionSentence(prediction), HasSubstr("6 techniques in 2 scenes and levels"));
    EXPECT_THAT(predictionSentence(prediction), HasSubstr("0.78 (CGVQM, arXiv 2506.11546)"));
}

TEST(PriceFigures, AreOneOfAllAPanelOfEachAndThatOfPredictions) {
    const Findings findings = study(tournament, 40, techniques, {"atrium", "figures"});
    const std::vector<StudyFigure> figures = priceFigures(findings);
    ASSERT_EQ(figures.size(), 3u);
    EXPECT_EQ(figures[0].drawing.name, "prices");
    EXPECT_EQ(figures[1].drawing.name, "prices-each");
    EXPECT_EQ(figures[2].drawing.name, "predicted");
    EXPECT_EQ(figures[1].numbers.rows.size(), 8u);
    EXPECT_THAT(figures[0].drawing.script, HasSubstr("beyond Blizzard24: less than 0.5 JOD"));
    for (const StudyFigure& figure : figures) {
        ASSERT_TRUE(figure.narrow);
        EXPECT_THAT(figure.caption, HasSubstr("predict"));
    }
}

TEST(PriceAxes, HaveColumnsForWhatIsFreeAndWhatNobodyTimed) {
    const PricedScale scale = pricesOf(study(tournament, 1))[0];
    const PriceAxes axes({&scale}, 6, 3, 0.2);
    double before = 0;
    for (const Priced& one : scale.techniques) { // by rising price
        EXPECT_GT(axes.x(one), before);
        EXPECT_GE(axes.y(one.people), 0);
        before = axes.x(one);
        if (one.milliseconds.value_or(0) > 0) {
            EXPECT_NEAR(axes.milliseconds(axes.x(one)), *one.milliseconds, 1e-9);
        }
    }
    EXPECT_LT(before, 6);
    EXPECT_LE(axes.y(0), 2.8); // below the headroom
}

TEST(LabelPlaces, CoverNeitherBarsNorEachOther) {
    std::vector<Named> points;
    for (const double x : {1.0, 1.2, 1.4, 3.0})
        points.push_back({x, 1, 1.6, 0.5, 0.15});
    const Box frame{0, 0, 4, 3}, taken{2.7, 1.6, 3.3, 2};
    const std::vector<Box> places = labelPlaces(points, {taken}, frame);
    const auto apart = [](const Box& a, const Box& b) {
        return a.right <= b.left || b.right <= a.left || a.top <= b.bottom || b.top <= a.bottom;
    };
    ASSERT_EQ(places.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(apart(places[i], taken)) << i;
        for (const Named& point : points)
            EXPECT_TRUE(apart(places[i], {point.x, point.low, point.x, point.high})) << i;
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_TRUE(apart(places[i], places[j])) << i << " " << j;
        EXPECT_TRUE(places[i].left >= 0 && places[i].right <= 4) << i;
    }
}

} // namespace
} // namespace obscura
