#include "analysis/figure_list.h"
#include "analysis/methods_text.h"
#include "report/paper_figure.h"
#include "tests/analysis/sample_findings.h"
#include "tests/report/xml.h"

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace obscura {
namespace {

using test::studied;
using test::thesis;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string svgOf(const Figure& figure) { return pageSvg(figure, 760, 400, "test"); }

std::vector<std::string> column(const Table& table, std::size_t i) {
    std::vector<std::string> cells;
    for (const auto& row : table.rows)
        cells.push_back(row.at(i));
    return cells;
}

TEST(SharesFigure, HasEveryLabelAndCountAtBothWidths) {
    const std::vector<StudyFigure> figures = sharesFigures(thesis());
    ASSERT_THAT(figures, SizeIs(1));
    for (const Figure& drawing : {figures[0].drawing, figures[0].narrow.value()}) {
        const std::string svg = svgOf(drawing);
        EXPECT_EQ(test::faultOfXml(svg), "");
        for (const char* text : {"moderate", "characters:", "Blizzard8 / RayMarching30", "16 : 20",
                                 "50 %", "undecided"})
            EXPECT_THAT(svg, HasSubstr(text));
    }
}

TEST(SharesFigure, DrawsNamesAsTheyAreWritten) {
    Findings findings = thesis();
    findings.tallies.resize(1);
    findings.tallies[0].scene = "it's \"a_b^c\" {d} \\e @f &g ~h <i> é";
    findings.tallies[0].level = "low_{er}\nlevel";
    const std::string svg = svgOf(sharesFigures(findings)[0].drawing);
    EXPECT_THAT(svg, HasSubstr("it's \"a_b^c\" {d} \\e @f &amp;g ~h &lt;i> é"));
    EXPECT_THAT(svg, HasSubstr("low_{er} level"));
    EXPECT_EQ(test::faultOfXml(svg), "");
}

TEST(SharesFigure, IsDrawnWithoutAnyVotes) {
    Findings findings = thesis();
    for (Tally& tally : findings.tallies)
        tally.votes = {};
    EXPECT_THAT(svgOf(sharesFigures(findings)[0].drawing), HasSubstr("0 : 0"));
    EXPECT_THAT(powerFigures(findings), IsEmpty());
}

TEST(SharesFigure, MarksWhatTheVerdictSays) {
    Findings findings = thesis();
    findings.tallies.resize(4);
    findings.tallies[0].votes = {2, 34};
    findings.tallies[1].votes = {500, 500};
    findings.tallies[1].margin = 0.1;
    findings.tallies[2].votes = {18, 18};
    findings.tallies[3].votes = {0, 3};
    const StudyFigure figure = sharesFigures(findings)[0];
    EXPECT_THAT(column(figure.numbers, figure.numbers.columns.size() - 1),
                ElementsAre("differs", "equivalent", "undecided", "unusable"));
    for (const char* key : {"differs:", "as good as even", "undecided", "not to be used"})
        EXPECT_THAT(figure.drawing.script, HasSubstr(key));
}

// Shapes tell the verdicts apart: nothing lies over a cross.
TEST(SharesFigure, DrawsACrossAsACross) {
    Findings findings = thesis();
    findings.tallies.resize(1);
    findings.tallies[0].votes = {0, 3};
    const std::string svg = svgOf(sharesFigures(findings)[0].drawing);
    EXPECT_THAT(svg, HasSubstr("<use xlink:href='#test-gpPt1' ")); // in the key and in the chart
    const std::regex circle(
        R"re(<use xlink:href='#test-gpPt6' transform='[^']*scale\(([\d.]+)\)')re");
    for (std::sregex_iterator it(svg.begin(), svg.end(), circle), end; it != end; ++it)
        EXPECT_LT(std::stod((*it)[1]), 1) << "a circle that can be seen";
}

TEST(SharesFigure, IsSplitBeforeItOutgrowsAPage) {
    Findings findings = thesis();
    for (int i = 0; i < 5; ++i)
        findings.tallies.insert(findings.tallies.end(), findings.tallies.begin(),
                                findings.tallies.begin() + 7);
    const std::vector<StudyFigure> figures = sharesFigures(findings);
    ASSERT_THAT(figures, SizeIs(2));
    EXPECT_EQ(figures[0].numbers.rows.size() + figures[1].numbers.rows.size(), 42u);
    EXPECT_NE(figures[0].drawing.name, figures[1].drawing.name);
    for (const StudyFigure& figure : figures) // A4 between margins of 15 mm, shrunk to its width
        EXPECT_LT(figure.drawing.height / figure.drawing.width, 267.0 / 180);
}

// Of 36 votes the exact test rejects 11 : 25 at .05 and 10 : 26 at .05 / 3 and .05 / 4. Sums of
// binomial probabilities in Python's integers reach 80 % at a share of .74128 and .76685.
TEST(PowerFigure, SaysWhatThirtySixPeopleCouldShow) {
    const std::vector<StudyFigure> figures = powerFigures(thesis());
    ASSERT_THAT(figures, SizeIs(1));
    EXPECT_THAT(figures[0].numbers.rows[2], ElementsAre("3", "36", "69 %", "74 %", "4", "77 %"));
    EXPECT_THAT(figures[0].numbers.rows[1], ElementsAre("2", "36", "61 %", "74 %", "3", "77 %"));
}

SlotRecord taken(const std::string& participant, SlotState state) {
    SlotRecord record;
    record.session.participant = participant;
    record.state = state;
    return record;
}

TEST(FlowFigure, LosesNobody) {
    Answers answers;
    for (int number = 1; number <= 5; ++number) {
        Answer answer{Vote(test::sampleResponse(number, "c1", true)), Symbol("a.csv"), 2};
        (number <= 2 ? answers.excluded.rows : answers.counted).push_back(answer);
        answers.slots.push_back(taken(fmt::format("P{:02}", number), SlotState::reserved));
        answers.slots.push_back(taken(fmt::format("P{:02}", number), SlotState::completed));
    }
    answers.slots.push_back(taken("P06", SlotState::returned));
    answers.slots.push_back(taken("P07", SlotState::reserved));
    answers.excluded.reasons = {{"P01", "1", "1 of 4 catch trials right", 7},
                                {"P02", "1", "2 of 4 catch trials right", 7},
                                {"P03", "1", "too fast", 2},
                                {"", "", "interrupted", 3}};
    const Flow flow = flowOf(answers, 3, 3);
    EXPECT_EQ(flow.begun, 7);
    ASSERT_THAT(flow.excluded, SizeIs(1));
    EXPECT_EQ(flow.excluded[0].reason, "… of … catch trials right");
    EXPECT_EQ(Flow::sum(flow.excluded), 2);
    EXPECT_EQ(Flow::sum(flow.unanswered), 2);
    EXPECT_EQ(Flow::sum(flow.leftOut), 5) << "trials of sessions that count otherwise";
    EXPECT_EQ(*flow.begun, Flow::sum(flow.unanswered) + Flow::sum(flow.excluded) + flow.sessions);

    Findings findings = thesis();
    findings.conduct.emplace().flow = flow;
    const StudyFigure figure = flowFigures(findings).at(0);
    for (const char* text : {"Begun: 7 sessions", "Excluded: 2", "Analysed: 3 participants",
                             "voided before any answer"})
        for (const Figure& drawing : {figure.drawing, figure.narrow.value()})
            EXPECT_THAT(svgOf(drawing), HasSubstr(text));
    findings.conduct->flow = {};
    EXPECT_THAT(flowFigures(findings), IsEmpty()) << "nothing is known";
}

TEST(TimingFigures, CountEveryTrial) {
    const test::Folder folder;
    Findings findings = studied(folder, false);
    std::vector<StudyFigure> figures = timingFigures(findings);
    ASSERT_THAT(figures, SizeIs(1)) << "nothing went amiss";
    EXPECT_THAT(figures[0].numbers.rows, ElementsAre(ElementsAre("2000", "56")));

    findings.conduct->maskTimes = {{1999, 5}, {2000, 40}, {2090, 11}};
    findings.conduct->wrongMasks = 11;
    findings.conduct->maskFrames = {{0, 45}, {5, 11}};
    findings.conduct->missedFrames = 11;
    findings.conduct->missed = {{0, 45}, {2, 11}};
    figures = timingFigures(findings);
    ASSERT_THAT(figures, SizeIs(3));
    EXPECT_THAT(figures[0].numbers.rows,
                ElementsAre(ElementsAre("1999–2001", "45"), ElementsAre("2089–2091", "11")));
    EXPECT_THAT(figures[2].numbers.rows,
                ElementsAre(ElementsAre("0", "45"), ElementsAre("2", "11")));
    EXPECT_THAT(timingFigures(thesis()), IsEmpty());
}

TEST(Figures, AreStampedWhereverTheyGo) {
    const test::Folder folder;
    for (const StudyFigure& figure : figuresOf(studied(folder, true)))
        EXPECT_THAT(svgOf(figure.drawing), HasSubstr("SIMULATED DATA")) << figure.drawing.name;
    for (const StudyFigure& figure : figuresOf(studied(folder, false)))
        EXPECT_THAT(svgOf(figure.drawing), Not(HasSubstr("SIMULATED"))) << figure.drawing.name;
}

TEST(MethodsText, SaysWhatIsKnownAndMarksWhatIsNot) {
    const test::Folder folder;
    const auto joined = [](const Findings& findings) {
        return fmt::format("{}", fmt::join(methodsText(findings), "\n"));
    };
    EXPECT_THAT(joined(thesis()), HasSubstr("The counts were published. [Add: where;"));
    const std::string people = joined(studied(folder, false));
    EXPECT_THAT(people, HasSubstr("28 participants took part in 28 sessions"));
    EXPECT_THAT(people, HasSubstr("grey mask of 2.00 s"));
    EXPECT_THAT(people, HasSubstr("at 60.00 Hz"));
    EXPECT_THAT(people, HasSubstr("finish (56 of 56 trials)"));
    EXPECT_THAT(people, HasSubstr("No claim was declared before the data"));
    EXPECT_THAT(people, Not(HasSubstr("SIMULATED")));
    EXPECT_THAT(joined(studied(folder, true)), HasSubstr("SIMULATED: 56 of 56"));
}

} // namespace
} // namespace obscura
