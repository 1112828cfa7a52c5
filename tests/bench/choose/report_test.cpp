#include "base/csv.h"
#include "base/files.h"
#include "bench/choose/figure.h"
#include "bench/choose/report.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// Nothing is chosen: an earlier answer of ours goes, one that a person wrote is kept.
TEST(ChooseReport, AChoiceThatAPersonWroteSurvives) {
    const test::Folder root;
    EXPECT_NO_THROW(requireOwnChoice(root.path()));
    for (const std::string name : {"choice.toml", "study.toml"}) {
        const std::string mine = "[techniques.mine]\ntechnique = \"crytek\"\n";
        writeFile(root / name, mine);
        EXPECT_THAT(test::errorOf([&] { requireOwnChoice(root.path()); }),
                    HasSubstr(name + ": expected a file that obscura-bench choose wrote"));
        EXPECT_THROW(writeChoice(root.path(), {}, {}, {}, {}), Error);
        EXPECT_EQ(readFile(root / name), mine);

        writeFile(root / "elsewhere.toml", mine);
        fs::remove(root / name);
        fs::create_symlink(root / "elsewhere.toml", root / name);
        EXPECT_THROW(requireOwnChoice(root.path()), Error);
        EXPECT_THROW(writeChoice(root.path(), {}, {}, {}, {}), Error);
        EXPECT_TRUE(fs::is_symlink(root / name));
        fs::remove(root / name);
    }
}

Candidate candidate(const std::string& name, double milliseconds, const std::vector<double>& rmse) {
    Candidate made;
    made.configuration.setting.name = name;
    made.configuration.setting.technique = "gtao";
    made.glanceMilliseconds = milliseconds;
    made.glanceRmse = 0.1;
    made.milliseconds = made.rmse = made.training = std::nan("");
    if (rmse.empty())
        return made;
    made.rung = Rung::held_out;
    made.milliseconds = milliseconds;
    for (const double value : rmse) {
        ViewResult view;
        view.rmse = value;
        view.milliseconds = 2 * milliseconds;
        made.views.push_back(view);
    }
    made.rmse = meanOf(made.views, &ViewResult::rmse);
    return made;
}

// Four candidates: one that fails, one that was left out, one that is chosen, one that is dearer.
class ChooseReportTest : public testing::Test {
  protected:
    ChooseReportTest() {
        study_.sizes = {{64, 36}};
        study_.match.name = "small";
        study_.match.test.resize(3);
        study_.match.test[1].name = "left, behind";
        choice_.candidates = {
            candidate("cheap", 1, {0.2, 0.2, 0.21}), candidate("left out", 1.5, {}),
            candidate("right", 2, {0.08, 0.09, 0.085}), candidate("dear", 4, {0.05, 0.06, 0.05})};
        choice_.candidates[1].verdict = "RMSE far over the limit at a glance";
        choice_.machine.renderer = "a renderer";
        choice_.machine.program = "obscura 1 (abc)";
    }
    void judge(const Budget& budget) {
        for (Candidate& each : choice_.candidates)
            if (each.rung == Rung::held_out)
                each.verdict = excess(budget, each.views);
    }
    void chooseThird() {
        choice_.chosen = 2;
        choice_.candidates[2].rung = Rung::chosen;
    }

    SweepStudy study_;
    Choice choice_;
};

TEST_F(ChooseReportTest, SaysWhyAndWhyNot) {
    Budget budget;
    budget.rmse = 0.12;
    judge(budget);
    chooseThird();
    const std::string text = choiceText(study_, budget, choice_);
    EXPECT_THAT(text, HasSubstr("right is the cheapest with RMSE at most 0.12."));
    EXPECT_THAT(text, HasSubstr("Of 4 candidates, 3 were measured on 3 held-out views, of which 1 "
                                "missed a limit. It takes 2 ms, RMSE 0.085"));
    EXPECT_THAT(text, HasSubstr("1 ms  RMSE 0.203 (at most 0.2"));
    EXPECT_THAT(text, HasSubstr("1.5 ms  RMSE far over the limit at a glance"));
    EXPECT_THAT(text, HasSubstr("What dearer ones would add:\n  dear"));
}

TEST_F(ChooseReportTest, SaysWhatCameNearestAndWhatWouldAdmitIt) {
    Budget budget;
    // R: the bound of c(.05, .06, .05) is .07113; with as many as 7 that scatter alike, .0593.
    budget.rmse = 0.06;
    judge(budget);
    const std::string text = choiceText(study_, budget, choice_);
    EXPECT_THAT(text, HasSubstr("Nothing has RMSE at most 0.06."));
    EXPECT_THAT(text, HasSubstr("dear came nearest: 4 ms, RMSE 0.053"));
    EXPECT_THAT(text, HasSubstr("rmse=0.072 would admit it; so might 7 views that scatter like "
                                "these 3, for the mean itself meets the limit"));
    EXPECT_LT(text.find("\n  dear"), text.find("\n  right")); // ordered by nearness
    EXPECT_LT(text.find("\n  right"), text.find("\n  cheap"));
    EXPECT_THAT(text, HasSubstr("more views would not, for its mean misses the limit"));
    EXPECT_THAT(text, HasSubstr("Not measured:\n  left out"));
}

TEST_F(ChooseReportTest, SaysWhatTheViewsDoNotTellFromTheBest) {
    Budget budget;
    budget.milliseconds = 5;
    budget.best = &measureNamed("rmse");
    judge(budget);
    chooseThird();
    choice_.alike = {0};
    const std::string text = choiceText(study_, budget, choice_);
    EXPECT_THAT(text, HasSubstr("right has the best RMSE with at most 5 ms."));
    EXPECT_THAT(text, HasSubstr("The views do not tell cheap from it, which takes 1 ms."));
    EXPECT_THAT(text, HasSubstr("Better ones, and why not:\n  dear"));
    EXPECT_THAT(text, HasSubstr("8 ms in 95 of 100 frames on the dearest view, limit 5"));
}

TEST_F(ChooseReportTest, WritesWhatCanBeChecked) {
    const test::Folder folder;
    Budget budget;
    budget.rmse = 0.12;
    judge(budget);
    chooseThird();
    writeChoice(folder.path(), study_, {}, budget, choice_);
    const auto views = splitCsv(readFile(folder / "choice-views.csv"));
    ASSERT_EQ(views.size(), 1u + 9);
    EXPECT_EQ(views[2].cells[1], "left, behind");
    EXPECT_EQ(views[5].cells[4], "0.09");
    EXPECT_EQ(views[5].cells[7], ""); // JOD was not measured
    EXPECT_EQ(splitCsv(readFile(folder / "choice.csv")).size(), 1u + 4);
    const auto facts = nlohmann::json::parse(readFile(folder / "choice.json"));
    EXPECT_EQ(facts["chosen"], "right");
    EXPECT_EQ(facts["machine"]["renderer"], "a renderer");
    EXPECT_EQ(facts["program"], "obscura 1 (abc)");
    EXPECT_THAT(readFile(folder / "study.toml"), HasSubstr("name = \"small\""));
    for (const char* file : {"choice.svg", "choice.pdf", "choice.toml"})
        EXPECT_TRUE(fs::exists(folder / file)) << file;
    // Every measured candidate and the limit are named in the picture, the others not.
    const std::string svg = readFile(folder / "choice.svg");
    for (const char* name : {"cheap", "right", "dear", "limit 0.12", "RMSE too high", "chosen",
                             "dearer", "right is the cheapest"})
        EXPECT_THAT(svg, HasSubstr(name));
    EXPECT_THAT(svg, Not(HasSubstr("left out  ")));
}

// Nothing was measured, everything was free, no limit has a number: it is drawn all the same.
TEST_F(ChooseReportTest, DrawsOddChoices) {
    const test::Folder folder;
    Budget budget;
    budget.failures = {"halo"};
    choice_.candidates.resize(1);
    for (const bool measured : {false, true}) {
        choice_.candidates[0] =
            candidate("none", 0, measured ? std::vector{0.2, 0.2, 0.2} : std::vector<double>{});
        choice_.candidates[0].verdict = "halo: 3 of 4";
        EXPECT_NO_THROW(writeChoice(folder.path(), study_, {}, budget, choice_));
        EXPECT_THAT(readFile(folder / "choice.svg"), HasSubstr("</svg>"));
        EXPECT_EQ(readFile(folder / "choice.svg").find("fails halo") != std::string::npos,
                  measured);
    }
}

} // namespace
} // namespace obscura
