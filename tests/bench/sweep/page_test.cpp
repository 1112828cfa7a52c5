#include "base/files.h"
#include "bench/sweep/figures.h"
#include "bench/sweep/page.h"
#include "bench/sweep/summary.h"
#include "report/html.h"
#include "tests/bench/sweep/sample_sweep.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "tests/report/xml.h"

#include <gmock/gmock.h>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t times = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size())
        ++times;
    return times;
}

TEST(SweepPage, IsWellFormedAndNeedsNothingFromElsewhere) {
    const std::string page = sweepPage(test::smallSweep(), ".");
    EXPECT_EQ(test::faultOfXml(page), "");
    EXPECT_EQ(test::foreignReference(page), "");
    EXPECT_THAT(sweepPage({}, "."), HasSubstr("</html>"));
}

TEST(SweepPage, WritesHostileNamesAsTheyAre) {
    Sweep sweep = test::smallSweep();
    const std::string name = "<script>alert(1)</script> & \"a,b\" 'c'";
    for (SweepRow& row : sweep.rows)
        row.scene = row.view = row.settings = name;
    for (std::size_t i = 0; i < 4; ++i)
        sweep.rows[i].configuration = sweep.rows[i].technique = name;
    sweep.growth[0].axis = sweep.machine.renderer = sweep.machine.clocks = name;
    const std::string page = sweepPage(sweep, ".");
    EXPECT_EQ(test::faultOfXml(page), "");
    EXPECT_EQ(count(page, "<script"), 1u);
    EXPECT_GT(count(page, escaped(name)), 20u);
}

TEST(SweepPage, HasEveryConfigurationAsAMarkOfEachErrorAndInDetail) {
    const Sweep sweep = test::smallSweep();
    const std::string page = sweepPage(sweep, ".");
    for (const SweepRow& row : sweep.rows)
        EXPECT_EQ(count(page, "aria-label=\"" + row.configuration + ": "), errorMeasures().size());
    EXPECT_EQ(count(page, "<article id=\"p"), sweep.rows.size() / 2); // of two views
}

TEST(SweepPage, SaysWhatIsMissing) {
    Sweep sweep = test::smallSweep();
    sweep.rows.pop_back();
    sweep.rows[0].matched.rmse = std::nan("");
    const std::string page = sweepPage(sweep, ".");
    EXPECT_THAT(page, HasSubstr("on fewer views: " + sweep.rows.back().configuration + ".</p>"));
    EXPECT_THAT(page, HasSubstr("1 without this error are left out."));
}

// Errors of one machine come first, times perhaps days later, or the other way round.
TEST(SweepPage, DoesWithoutTimesAndWithoutErrors) {
    Sweep untimed = test::smallSweep();
    static_cast<TimedOn&>(untimed.machine) = {};
    untimed.machine.errorsBy = "a <GPU>";
    untimed.growth.clear();
    for (SweepRow& row : untimed.rows)
        static_cast<SweepTimes&>(row) = {};
    std::string page = sweepPage(untimed, ".");
    EXPECT_EQ(test::faultOfXml(page), "");
    EXPECT_THAT(page, HasSubstr("Nothing was timed yet."));
    EXPECT_THAT(page, HasSubstr("Errors are of pictures by a &lt;GPU&gt;"));
    EXPECT_THAT(page, HasSubstr("rows have no times, which obscura-bench sweep STUDY --measure "
                                "times adds"));
    EXPECT_THAT(page, HasSubstr("No chart, for no time was measured"));
    EXPECT_THAT(page, HasSubstr("Not timed."));
    EXPECT_THAT(page, Not(HasSubstr("Without errors.")));
    EXPECT_THAT(page, Not(HasSubstr("<a class=\"mark")));
    EXPECT_THAT(page, Not(HasSubstr("FPS")));
    EXPECT_EQ(count(page, "<article id=\"p"), untimed.rows.size() / 2);
    EXPECT_THAT(sweepFigures(untimed), testing::IsEmpty());

    Sweep unjudged = test::smallSweep();
    for (SweepRow& row : unjudged.rows)
        static_cast<SweepErrors&>(row) = {};
    unjudged.machine.notes = "3 rows were timed on another kind of machine (<x>)";
    page = sweepPage(unjudged, ".");
    EXPECT_EQ(test::faultOfXml(page), "");
    EXPECT_THAT(page, HasSubstr("rows have no errors"));
    EXPECT_THAT(page, HasSubstr("3 rows were timed on another kind of machine (&lt;x&gt;)"));
    EXPECT_THAT(page, HasSubstr("No chart, for no error was measured"));
    EXPECT_THAT(page, HasSubstr("Without errors."));
    EXPECT_THAT(page, Not(HasSubstr("Not timed.")));
    EXPECT_EQ(sweepFigures(unjudged).size(), 1u); // how cost grows
}

TEST(SweepPage, WarnsOfASoftwareRenderer) {
    Sweep sweep = test::smallSweep();
    EXPECT_THAT(sweepPage(sweep, "."), HasSubstr("This renderer is software."));
    sweep.machine.renderer = "NVIDIA H200";
    EXPECT_THAT(sweepPage(sweep, "."), Not(HasSubstr("This renderer is software.")));
}

TEST(SweepPage, SaysThatJodIsPredictedAndOnWhichScreen) {
    Sweep sweep = test::smallSweep();
    sweep.machine.display = "24-inch <wide>";
    for (SweepRow& row : sweep.rows)
        row.litMatched.jod = row.view == "view 1" ? 8.5 : 9; // mean 8.75
    std::string page = sweepPage(sweep, ".");
    EXPECT_EQ(test::faultOfXml(page), "");
    EXPECT_THAT(page, HasSubstr("for a person before this screen: 24-inch &lt;wide&gt;. 10 is no"));
    EXPECT_THAT(page, HasSubstr("10 − predicted JOD of the lit image, matched, full reference"));
    EXPECT_THAT(page, HasSubstr("data-error=\"1.25\""));
    EXPECT_EQ(count(page, "<td class=\"number\">8.75</td>"), // in the ranking and the details
              2 * sweep.rows.size() / 2);
    EXPECT_EQ(count(page, "JOD"), count(page, "predicted JOD") + 1);
    sweep.machine.display.clear();
    EXPECT_THAT(sweepPage(sweep, "."), Not(HasSubstr("just-objectionable")));
}

TEST(SweepPage, HoldsEachThumbnailOnce) {
    const test::Folder folder;
    Sweep sweep = test::smallSweep();
    sweep.rows[0].thumbnail = "a.png";
    writeFile(folder / "a.png", "not quite a PNG");
    EXPECT_EQ(count(sweepPage(sweep, folder.path()), dataAddress("image/png", "not quite a PNG")),
              1u);
    for (SweepRow& row : sweep.rows)
        if (row.technique != sweep.rows[0].technique)
            row.thumbnail = "missing.png";
    EXPECT_THAT(test::errorOf([&] { sweepPage(sweep, folder.path()); }), HasSubstr("missing.png"));
}

// As the results in docs/results are.
TEST(SweepPage, HasNoThumbnailsWhereTheFolderHasNone) {
    const test::Folder folder;
    Sweep sweep = test::smallSweep();
    EXPECT_THAT(sweepPage(sweep, folder.path()), Not(HasSubstr("no thumbnails")));
    sweep.rows[0].thumbnail = "missing.png";
    const std::string page = sweepPage(sweep, folder.path());
    EXPECT_THAT(page, HasSubstr("no thumbnails"));
    EXPECT_THAT(page, HasSubstr(".thumb { display: none; }"));
}

TEST(SweepPage, StaysBelow25MegabytesWhateverThumbnailsWeigh) {
    const test::Folder folder;
    Sweep sweep = test::smallSweep();
    writeFile(folder / "big.png", std::string(1'000'000, 'x'));
    for (int resolution = 0; resolution < 3; ++resolution)
        for (SweepRow row : test::smallSweep().rows) {
            row.width += resolution;
            row.thumbnail = "big.png";
            if (row.technique != "none") // which is on every front
                row.matched = row.raw = row.depthMatched = row.depthRaw =
                    row.litMatched = {9, 9, -9, 9};
            sweep.rows.push_back(row);
        }
    const std::string page = sweepPage(sweep, folder.path());
    EXPECT_LT(page.size(), 25e6);
    EXPECT_THAT(page, HasSubstr("configurations off every front are only in the sweep's folder"));
    EXPECT_GT(count(page, dataAddress("image/png", std::string(1'000'000, 'x')).substr(0, 40)), 9u);
}

} // namespace
} // namespace obscura
