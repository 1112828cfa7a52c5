#include "analysis/plan/plan.h"
#include "analysis/plan/power_curves.h"
#include "analysis/plan/preregistration.h"
#include "analysis/plan/simulation.h"
#include "tests/error_of.h"

#include "inference/tails.h"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace obscura {
namespace {

// `count` conditions of pairs, c1 and so on, and whatever else.
Protocol studyOf(int count, const std::string& more, double preference = 0.5) {
    std::string text = "name = \"planned\"\ntitle = \"Planned\"\nseed = 1\n"
                       "[scenes.s]\nbuiltin = \"sculpture\"\n"
                       "camera = { position = [0, 1, 3], target = [0, 0.5, 0] }\nradius = 0.5\n"
                       "[levels.l]\nambient = [1, 1, 1]\n"
                       "[techniques.x]\ntechnique = \"none\"\n"
                       "[techniques.y]\ntechnique = \"crytek\"\n";
    for (int i = 1; i <= count; ++i)
        text += fmt::format("[[conditions]]\nid = \"c{}\"\nscene = \"s\"\nlevel = \"l\"\n"
                            "pair = [\"x\", \"y\"]\nhypothesis = \"H\"\n"
                            "simulatedPreference = {}\n",
                            i, preference);
    return parseProtocol(text + more +
                             "[texts]\ninstructions = \"i\"\nthanks = \"t\"\nstart = \"s\"\n"
                             "question = \"q\"\nfirst = \"1\"\nsecond = \"2\"\n",
                         "planned.toml");
}

constexpr const char* oneClaim = "[[claims]]\nname = \"y is better\"\nkind = \"superior\"\n"
                                 "conditions = [\"c1\"]\n";

// psychophysics.md 5.1, R's binom.test: rows of true shares, columns of N. At 42 and .75 it prints
// .920; sums of exact fractions (Python) give .919471.
TEST(Plan, PowerOfOneConditionIsThatOfR) {
    const Protocol study = studyOf(1, oneClaim);
    const std::map<int, std::vector<double>> table = {{28, {.149, .309, .528, .750, .910}},
                                                      {36, {.162, .356, .609, .833, .958}},
                                                      {42, {.237, .481, .743, .9195, .987}},
                                                      {56, {.305, .605, .859, .974, .998}},
                                                      {84, {.406, .763, .957, .997, 1.000}}};
    const int eighty[] = {210, 97, 54, 35, 23}, ninety[] = {274, 121, 70, 42, 30};
    for (const auto& [people, powers] : table) {
        PlanOptions options;
        options.participants = people;
        options.studies = 100;
        const Plan plan = planOf(study, options);
        ASSERT_TRUE(plan.tests.at(0).exact);
        for (std::size_t i = 0; i < powers.size(); ++i) {
            const EffectPower& effect = plan.tests[0].effects.at(i + 1); // from .6 on
            EXPECT_NEAR(effect.power.share, powers[i], 0.00051) << people << " " << effect.share;
            EXPECT_EQ(effect.needed, eighty[i]);
            EXPECT_EQ(effect.ninety, ninety[i]);
        }
    }
}

// The same table's last column: the first of seven claims is tested at .05 / 7.
TEST(Plan, ClaimsOfAFamilyAreCorrected) {
    std::string claims;
    for (int i = 1; i <= 7; ++i)
        claims += fmt::format("[[claims]]\nname = \"claim {0}\"\nkind = \"superior\"\n"
                              "conditions = [\"c{0}\"]\n",
                              i);
    PlanOptions options;
    options.studies = 100;
    const int ofSeven[] = {324, 146, 82, 53, 35};
    for (const Plan& plan :
         {planOf(studyOf(7, claims), options), planOf(studyOf(7, ""), options)}) {
        ASSERT_EQ(plan.tests.size(), 7U); // declared, or the hypothesis' own
        for (std::size_t i = 0; i < 5; ++i)
            EXPECT_EQ(plan.tests[3].effects.at(i + 1).needed, ofSeven[i]);
    }
}

TEST(Plan, EquivalenceIsThatOfR) {
    const Protocol study = studyOf(1, "[[claims]]\nname = \"even\"\nkind = \"equivalent\"\n"
                                      "conditions = [\"c1\"]\nmargin = 0.15\n");
    PlanOptions options;
    options.participants = 36;
    options.studies = 2000;
    const Plan plan = planOf(study, options);
    EXPECT_NEAR(plan.tests[0].effects[0].power.share, 0.1321, 5e-5);
    EXPECT_EQ(plan.tests[0].effects[0].needed, 100);
    EXPECT_EQ(plan.tests[0].effects[0].ninety, 126);
    // The simulation knows nothing of the formula.
    EXPECT_NEAR(plan.stated[1].people, 36, 0);
    EXPECT_NEAR(plan.stated[1].supported[0].share, 0.1321, 4 * std::sqrt(0.1321 * 0.8679 / 2000));
}

// However people differ, each condition's mean share is the one asked for: a vote each is binomial,
// so that simulated power is the exact one.
TEST(Plan, SimulatedPowerOfOneConditionIsTheExactOne) {
    const Protocol study = studyOf(1, oneClaim, 0.7);
    for (const double spread : {0.0, 2.0}) {
        PlanOptions options;
        options.participants = 42;
        options.spread = spread;
        options.studies = 4000;
        const Plan plan = planOf(study, options);
        for (const StatedPower& stated : plan.stated)
            if (stated.people == 42) {
                EXPECT_NEAR(stated.supported[0].share, 0.743, 4 * std::sqrt(0.743 * 0.257 / 4000))
                    << spread;
            }
    }
}

// People who differ make a claim over several conditions harder, and one of them not.
TEST(Plan, SpreadOfPeopleCostsPower) {
    const Protocol study = studyOf(4, "[[claims]]\nname = \"all\"\nkind = \"superior\"\n"
                                      "conditions = [\"c1\", \"c2\", \"c3\", \"c4\"]\n");
    PlanOptions options;
    options.participants = 28;
    options.studies = 1000;
    const auto powerAt = [&](double spread) {
        options.spread = spread;
        return planOf(study, options).tests[0].effects.at(2).power.share;
    };
    EXPECT_GT(powerAt(0), powerAt(2) + 0.2);
}

TEST(Plan, IsTheSameEveryTime) {
    const Protocol study = studyOf(2, "[[claims]]\nname = \"all\"\nkind = \"superior\"\n"
                                      "conditions = [\"c1\", \"c2\"]\n");
    PlanOptions options;
    options.studies = 200;
    const std::string once = planText(planOf(study, options));
    EXPECT_EQ(once, planText(planOf(study, options)));
    options.seed = 2;
    EXPECT_NE(once, planText(planOf(study, options)));
}

TEST(Plan, RoundsUpToBalancedOrders) {
    const Protocol study = studyOf(7, "[ordering]\nparticipants = 36\n");
    PlanOptions options;
    options.studies = 100;
    options.dropout = 0.2;
    const Plan plan = planOf(study, options);
    EXPECT_EQ(plan.people, 36);
    EXPECT_EQ(plan.balance, 28);
    EXPECT_EQ(plan.balanced, 56);
    EXPECT_EQ(plan.invited, 70);
}

// The manifest of that study, with the JOD of each condition's a and b.
Manifest imagesOf(const std::vector<std::pair<double, double>>& jods) {
    Manifest manifest;
    for (std::size_t i = 0; i < jods.size(); ++i) {
        ConditionRecord& record = manifest.conditions.emplace_back();
        record.condition = fmt::format("c{}", i + 1);
        record.image("a").quality = ImageQuality{0, jods[i].first, {}};
        record.image("b").quality = ImageQuality{0, jods[i].second, {}};
    }
    return manifest;
}

const StatedPower& statedAt(const Plan& plan, int people) {
    return *std::find_if(plan.stated.begin(), plan.stated.end(),
                         [&](const StatedPower& stated) { return stated.people == people; });
}

// 1 JOD is a share of .75, whose power and numbers are those of R above; the preference does not
// count.
TEST(Plan, PeopleWithEyesGoByPredictedJod) {
    const Protocol study = studyOf(1, oneClaim, 0.1);
    const Manifest stimuli = imagesOf({{8.2, 9.2}});
    PlanOptions options;
    options.participants = 42;
    options.studies = 1000;
    const Plan plan = planOf(study, options, {}, &stimuli);
    ASSERT_EQ(plan.predicted.size(), 1U);
    EXPECT_DOUBLE_EQ(plan.predicted[0].shareB, 0.75);
    EXPECT_EQ(plan.predicted[0].unsure, 0);
    ASSERT_TRUE(plan.tests[0].predicted);
    EXPECT_NEAR(plan.tests[0].predicted->power.share, 0.919471, 1e-6);
    EXPECT_EQ(plan.tests[0].predicted->needed, 35);
    EXPECT_EQ(plan.tests[0].predicted->ninety, 42);
    EXPECT_NEAR(statedAt(plan, 42).supported[0].share, 0.919471, 4 * std::sqrt(.92 * .08 / 1000));
    const std::string words = planText(plan);
    EXPECT_NE(words.find("By predicted JOD (ColorVideoVDP), not by people"), std::string::npos);
    EXPECT_EQ(words.find("simulatedPreference"), std::string::npos);
    EXPECT_NE(preregistration(study, plan, "2026-01-31").find("not by people"), std::string::npos);
    EXPECT_EQ(planText(planOf(study, options)).find("predicted JOD"), std::string::npos);
}

// R: P <- function(d) .02 + .96 * pnorm((d + qnorm(.6) / u) * u); p <- (P(1) + 1 - P(-1)) / 2; n <-
// 42; sum(dbinom(k, n, p)) over the k with binom.test(k, n)$p.value <= .05.
TEST(Plan, LapsesAndPositionBiasCostPower) {
    const Protocol study =
        studyOf(1, std::string(oneClaim) + "[simulation]\nlapse = 0.04\npositionBias = 0.1\n");
    const Manifest stimuli = imagesOf({{8, 9}});
    PlanOptions options;
    options.participants = 42;
    options.studies = 100;
    const Plan plan = planOf(study, options, {}, &stimuli);
    EXPECT_NEAR(plan.predicted.at(0).shareB, 0.733485649851, 1e-11);
    EXPECT_NEAR(plan.tests[0].predicted.value().power.share, 0.874388838931, 1e-10);
}

// A claim for a has a's share, and where the right answer is the worse image, that one is chosen.
TEST(Plan, PredictedSharesAreOfTheClaimedRole) {
    const Manifest stimuli = imagesOf({{9, 8}});
    PlanOptions options;
    options.studies = 100;
    std::string claim = oneClaim;
    claim += "favours = \"a\"\n";
    EXPECT_DOUBLE_EQ(
        planOf(studyOf(1, claim), options, {}, &stimuli).tests[0].predicted.value().share, 0.75);
    Protocol flicker = studyOf(1, oneClaim);
    flicker.conditions[0].correct = "b";
    EXPECT_DOUBLE_EQ(planOf(flicker, options, {}, &stimuli).predicted.at(0).shareB, 0.75);
}

// R: of 20 people Bin(20, P(a) + P(b)) are sure, P(b) = pnorm(.5 * u), P(a) = pnorm(-1.5 * u); the
// exact test of theirs.
TEST(Plan, WhoIsNotSureHasNoVote) {
    const Protocol study = studyOf(
        1, std::string(oneClaim) +
               "[trial]\nphases = [{ name = \"ask\", images = [1, 2], questions = [{ name = "
               "\"choice\", text = \"question\", options = [\"first\", \"second\"], images "
               "= true, unsure = \"start\" }] }]\n");
    const Manifest stimuli = imagesOf({{8, 9}});
    PlanOptions options;
    options.participants = 20;
    options.studies = 4000;
    const Plan plan = planOf(study, options, {}, &stimuli);
    EXPECT_NEAR(plan.predicted.at(0).shareB, 0.632033844395, 1e-11);
    EXPECT_NEAR(plan.predicted.at(0).unsure, 0.212133677982, 1e-11);
    EXPECT_FALSE(plan.tests[0].predicted);
    EXPECT_NEAR(statedAt(plan, 20).supported[0].share, 0.634615964952,
                4.5 * std::sqrt(.6346 * .3654 / 4000));
    EXPECT_NE(planText(plan).find("21.2 %"), std::string::npos);
}

TEST(Plan, StimuliWithoutPredictedJodAreRefused) {
    Manifest stimuli = imagesOf({{8, 9}});
    stimuli.conditions[0].image("a").quality.reset();
    EXPECT_NE(test::errorOf([&] {
                  planOf(studyOf(1, oneClaim), {}, {}, &stimuli);
              }).find("generate them anew"),
              std::string::npos);
}

TEST(Preregistration, SaysWhatIsClaimedAndWhatOnlyAPersonCanSay) {
    const Protocol study = studyOf(3, std::string(oneClaim) + "family = \"main\"\n"
                                                              "[exclusions]\ninterrupted = true\n");
    PlanOptions options;
    options.studies = 100;
    const std::string text = preregistration(study, planOf(study, options), "2026-11-29");
    for (const char* part :
         {"1. **y is better** (superior)", "exact binomial test", "Family: \"main\", 1 claim(s)",
          "lost the keyboard do not count", "`c2`, the condition `c3`",
          "stops when 28 have finished", "2026-11-29", "only a person can write 3 passages"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    EXPECT_NE(text.find(study.sha256), std::string::npos);
    EXPECT_EQ(text.find("the condition `c1`"), std::string::npos);
}

} // namespace
} // namespace obscura
