#include "analysis/report.h"
#include "analysis/statistics.h"
#include "analysis/table.h"
#include "analysis/verdict.h"
#include "base/csv.h"
#include "report/html.h"
#include "tests/analysis/sample_findings.h"
#include "tests/report/xml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string_view>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using test::studied;
using test::thesis;

std::string joined(const std::vector<std::string>& sentences) {
    return fmt::format("{}", fmt::join(sentences, "\n"));
}

TEST(Summary, SaysNoMoreThanTheThesisCountsDo) {
    EXPECT_THAT(
        summaryOf(thesis()),
        ElementsAre(
            "The published counts hold 252 votes on 7 conditions.",
            "Nothing was claimed before the data: all of this is exploratory, and the hypotheses "
            "named in the data form the families for corrections.",
            "0 of 7 conditions differ from an even split at .05 (exact binomial test, "
            "corrected by Holm within each hypothesis).",
            "Without the correction one would add: 25 of 36 chose Blizzard24 over Crytek24 "
            "(sponza, moderate); 25 of 36 chose Blizzard24 over None (sponza, high). With "
            "7 tests at .05, guessing alone gives up to 0.35 such differences on average, "
            "so one small p among them is weak evidence.",
            "For all 7 the data do not decide: a large p, even 1, does not show that "
            "two images look equally real, and the intervals leave room for shares from 26 "
            "to 84 %."));
}

// Holm and Benjamini-Hochberg within each hypothesis, and among those that have none, against
// psychophysics.md 5.1: .0864 for H1, .1153 for H2.
TEST(Verdict, IsCorrectedWithinItsHypothesis) {
    Findings findings = thesis();
    const auto verdicts = verdictsOf(findings.tallies);
    EXPECT_NEAR(verdicts[2]->holm, 0.1153, 5e-5);
    EXPECT_NEAR(verdicts[2]->benjaminiHochberg, 0.1153, 5e-5);
    EXPECT_NEAR(verdicts[4]->holm, 3 * 0.0288167196559, 1e-9);
    EXPECT_FALSE(verdicts[2]->differs() || verdicts[4]->differs());
    findings.tallies[4].family = "alone";
    EXPECT_TRUE(verdictsOf(findings.tallies)[4]->differs()) << "a family of one";
    EXPECT_THAT(summaryOf(findings)[2], HasSubstr("1 of 7 conditions differs"));
    EXPECT_THAT(resultTable(findings.tallies).rows[4], testing::Contains("0.029"));
    findings.tallies[4].votes = {};
    EXPECT_FALSE(verdictsOf(findings.tallies)[4].has_value());
}

TEST(Summary, SaysWhereOnlyTheApproximationRejects) {
    Findings findings = thesis();
    findings.tallies.resize(1);
    findings.tallies[0].votes = {24, 12}; // p .0455 by chi-square, .065 exactly
    EXPECT_THAT(joined(summaryOf(findings)),
                HasSubstr("0 of 1 conditions differ from an even split at .05 (exact binomial "
                          "test, corrected by Holm within each hypothesis).\nBy chi-square alone, "
                          "an approximation that is too "
                          "lenient here, one would add: 24 of 36 chose Crytek24 over Blizzard24"));
}

TEST(Summary, DoesNotTakeNoDifferenceForEquality) {
    Findings findings = thesis();
    for (Tally& tally : findings.tallies)
        tally.votes = {18, 18};
    EXPECT_THAT(joined(summaryOf(findings)),
                HasSubstr("0 of 7 conditions differ from an even split at .05 (exact binomial "
                          "test, corrected by Holm within each hypothesis)."));
    EXPECT_THAT(joined(summaryOf(findings)), HasSubstr("For all 7 the data do not decide:"));
}

TEST(Summary, WarnsOfRepeatedVotesAndNamesEmptyConditions) {
    const test::Folder folder;
    Findings findings = studied(folder, false);
    EXPECT_THAT(joined(summaryOf(findings)), HasSubstr("No votes yet: c3."));
    EXPECT_THAT(joined(summaryOf(findings)), Not(HasSubstr("Caution")));
    findings.conduct->mostVotes = 2;
    EXPECT_THAT(joined(summaryOf(findings)), HasSubstr("voted up to 2 times on one condition"));
}

TEST(Table, AlignsColumnsByCharactersNotBytes) {
    EXPECT_EQ(alignedText({{{"χ²", true}, {"Scene"}}, {{"5.444", "höhle"}, {"–", "x"}}}),
              "   χ²  Scene\n"
              "─────  ─────\n"
              "5.444  höhle\n"
              "    –  x\n");
}

TEST(Table, ShowsAbsentFiguresAsADashAndUnanimityAsABound) {
    Tally none, unanimous;
    unanimous.votes = {0, 9};
    const Table table = resultTable({none, unanimous});
    EXPECT_THAT(table.rows[0],
                ElementsAre("", "", "", "", "", "0 : 0", "–", "–", "–", "–", "–", "–", "–"));
    EXPECT_EQ(table.rows[1][11], "+0.500");
    EXPECT_EQ(table.rows[1][12], "≥ +0.63");
}

TEST(Table, HasThesisTable4InItsCsv) {
    const auto records = splitCsv(resultCsv(thesis()));
    ASSERT_EQ(records.size(), 8u);
    const std::vector<std::string>& names = records[0].cells;
    EXPECT_THAT(fmt::format("{}", fmt::join(names, ",")),
                testing::StartsWith("source,condition_id,level,scene,hypothesis,technique_a,"
                                    "technique_b,votes_a,votes_b,share_b,wilson_low,"));
    EXPECT_EQ(names.back(), "caution");
    const auto cell = [&](const char* name, std::size_t condition = 3) {
        return std::stod(records[condition].cells.at(
            static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())));
    };
    EXPECT_EQ(records[3].cells[0], "published counts");
    EXPECT_NEAR(cell("chi_square"), 49.0 / 9, 1e-12);
    EXPECT_NEAR(cell("p_holm"), 0.1153, 5e-5);
    EXPECT_NEAR(cell("clopper_pearson_low"), 0.5189, 5e-5);
    EXPECT_NEAR(cell("smallest_margin", 1), 0.147, 5e-4); // of 18 : 18
}

TEST(Table, LeavesCsvCellsEmptyWhereThereIsNoFigure) {
    Findings findings = thesis();
    findings.tallies.resize(1);
    findings.tallies[0].votes = {};
    // And p of two kinds, four counts by place, and two other shares with their intervals.
    const std::string empty(countStatistics().size() + 3 + 10, ',');
    EXPECT_THAT(resultCsv(findings), HasSubstr(",0,0" + empty + "H2,,\n"));
}

class ReportPage : public testing::Test {
  protected:
    test::Folder folder_;
};

TEST_F(ReportPage, IsWellFormed) {
    EXPECT_EQ(test::faultOfXml(reportHtml(thesis())), "");
    EXPECT_EQ(test::faultOfXml(reportHtml(studied(folder_, true))), "");
}

TEST_F(ReportPage, NeedsNothingFromElsewhere) {
    const std::string page = reportHtml(studied(folder_, true));
    EXPECT_EQ(test::foreignReference(page), "");
    EXPECT_THAT(page, Not(HasSubstr("<script")));
}

TEST_F(ReportPage, StampsSimulatedDataEverywhere) {
    const Findings findings = studied(folder_, true);
    const std::string page = reportHtml(findings);
    EXPECT_THAT(page, HasSubstr("<title>[SIMULATED] A sample &amp; its &lt;title&gt;</title>"));
    EXPECT_THAT(page, HasSubstr("<p class=\"stamp\">SIMULATED DATA: 56 of 56 votes were cast by a "
                                "program. They say nothing about people.</p>"));
    EXPECT_THAT(resultCsv(findings), HasSubstr("\nSIMULATED,c2,"));
}

TEST_F(ReportPage, DoesNotStampPeoplesData) {
    const Findings findings = studied(folder_, false);
    EXPECT_THAT(reportHtml(findings), Not(HasSubstr("SIMULATED")));
    EXPECT_THAT(resultCsv(findings), HasSubstr("\nparticipants,c2,"));
}

TEST_F(ReportPage, StampsPartlySimulatedData) {
    Findings findings = studied(folder_, false);
    findings.conduct->simulated = 3;
    EXPECT_THAT(reportHtml(findings), HasSubstr("SIMULATED DATA: 3 of 56 votes"));
    EXPECT_THAT(resultCsv(findings), HasSubstr("\npartly SIMULATED,c2,"));
}

TEST_F(ReportPage, HoldsTheContactSheetAndRefusesAnotherFile) {
    const Findings findings = studied(folder_, false);
    EXPECT_THAT(reportHtml(findings), HasSubstr(dataAddress("image/png", "\x89PNG, or so we say")));
    writeFile(folder_ / "stimuli/contact_sheet.png", "another");
    EXPECT_THAT(test::errorOf([&] { reportHtml(findings); }),
                HasSubstr("contact_sheet.png: not the contact sheet that the stimuli's manifest "
                          "describes; run obscura-stimuli again"));
}

TEST_F(ReportPage, ListsRowsThatCouldNotBeRead) {
    Findings findings = studied(folder_, false);
    findings.conduct->bad = {{{"a.csv", 3, 7, "slot_id"}, "expected \"1\""}};
    EXPECT_THAT(reportHtml(findings),
                HasSubstr("<li>a.csv:3:7: slot_id: expected &quot;1&quot;</li>"));
}

} // namespace
} // namespace obscura
