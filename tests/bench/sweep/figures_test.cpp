#include "base/files.h"
#include "bench/sweep/figures.h"
#include "bench/sweep/summary.h"
#include "tests/bench/sweep/sample_sweep.h"
#include "tests/folder.h"
#include "tests/report/xml.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST(Figures, AreDrawnWithNamesAsTheyAreWritten) {
    const test::Folder folder;
    Sweep sweep = test::smallSweep();
    for (SweepRow& row : sweep.rows) {
        row.scene = "../a <b> & \"c\" 'd'_e";
        if (row.technique == "hbao")
            row.configuration = row.technique = "it's {x}_y ^ <z> & \"w\"";
    }
    const std::vector<Figure> figures = sweepFigures(sweep);
    ASSERT_EQ(figures.size(), 3u); // two errors, growth
    EXPECT_THAT(figures[1].name, StartsWith("predicted-jod-1-"));
    writeFigures(folder.path(), figures);
    for (const Figure& figure : figures) {
        const std::string svg = readFile(folder / (figure.name + ".svg"));
        EXPECT_EQ(test::faultOfXml(svg), "") << figure.name;
        EXPECT_THAT(readFile(folder / (figure.name + ".pdf")), StartsWith("%PDF"));
        EXPECT_THAT(readFile(folder / (figure.name + ".gnuplot")), HasSubstr(figure.script));
    }
    EXPECT_THAT(readFile(folder / (figures[0].name + ".svg")),
                HasSubstr("it's {x}_y ^ &lt;z> &amp; \"w\""));
}

TEST(Figures, SayHowUncertainTimesAreWhereTheyAre) {
    Sweep sweep = test::smallSweep();
    EXPECT_THAT(sweepFigures(sweep)[0].script, Not(HasSubstr("dotted")));
    for (std::size_t i = 0; i < sweep.rows.size(); i += 4)
        sweep.rows[i].toStarcraft /= 1.2;
    EXPECT_THAT(sweepFigures(sweep)[0].script,
                HasSubstr(fmt::format("dotted: the front, times ±{:.1f} %",
                                      100 * uncertaintyOf(groupsOf(sweep.rows)[0]))));
}

TEST(Figures, AreNotDrawnOfNothing) {
    EXPECT_THAT(sweepFigures({}), IsEmpty());
    Sweep sweep = test::smallSweep();
    sweep.growth.clear();
    for (SweepRow& row : sweep.rows) {
        row.technique = "hbao";
        row.matched.rmse = row.litMatched.jod = std::nan("");
    }
    EXPECT_THAT(sweepFigures(sweep), IsEmpty());
}

} // namespace
} // namespace obscura
