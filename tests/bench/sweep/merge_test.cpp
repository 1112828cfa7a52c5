#include "base/files.h"
#include "bench/sweep/files.h"
#include "bench/sweep/merge.h"
#include "tests/bench/sweep/sample_sweep.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace obscura {
namespace {

using testing::HasSubstr;

// The small sweep in two parts, with a thumbnail of the same name in each.
class SweepParts : public testing::Test {
  protected:
    SweepParts() {
        const Sweep all = test::smallSweep();
        for (std::size_t part = 0; part < 2; ++part) {
            Sweep& sweep = part ? second_ : first_;
            sweep.machine = all.machine;
            for (std::size_t i = part; i < all.rows.size(); i += 2)
                sweep.rows.push_back(all.rows[i]);
            sweep.rows[0].thumbnail = "thumbnails/0.png";
            writeFile(folder_ / (part ? "b" : "a") / "thumbnails/0.png", part ? "two" : "one");
        }
        first_.growth = all.growth;
    }

    Sweep merge() {
        writeSweep(folder_ / "a", first_);
        writeSweep(folder_ / "b", second_);
        return mergeSweeps({folder_ / "a", folder_ / "b"}, folder_ / "all");
    }
    std::string mergeError() {
        std::string text = test::errorOf([&] { merge(); });
        const std::string path = folder_.path().string() + "/";
        for (std::size_t at; (at = text.find(path)) != text.npos;)
            text.erase(at, path.size());
        return text;
    }

    test::Folder folder_;
    Sweep first_, second_;
};

std::size_t timed(const Sweep& sweep) {
    return static_cast<std::size_t>(std::count_if(
        sweep.rows.begin(), sweep.rows.end(), [](const SweepRow& row) { return row.hasTimes(); }));
}

TEST_F(SweepParts, BecomeOneWithTheirThumbnails) {
    second_.machine.date = "tomorrow";
    const Sweep all = merge();
    EXPECT_EQ(all.rows.size(), test::smallSweep().rows.size());
    EXPECT_EQ(all.growth.size(), first_.growth.size());
    EXPECT_EQ(all.machine.date, first_.machine.date + "; tomorrow");
    EXPECT_EQ(all.machine.notes, "");
    EXPECT_EQ(sweepCsv(readSweep(folder_ / "all").rows), sweepCsv(all.rows));
    EXPECT_EQ(readFile(folder_ / "all" / all.rows[0].thumbnail), "one");
    EXPECT_EQ(readFile(folder_ / "all" / all.rows[first_.rows.size()].thumbnail), "two");
}

TEST_F(SweepParts, SayHowMuchIsMissing) {
    const auto rows = static_cast<int>(first_.rows.size() + second_.rows.size());
    first_.machine.rows = second_.machine.rows = rows;
    EXPECT_EQ(incompleteness(merge()), "");
    EXPECT_EQ(incompleteness(readSweep(folder_ / "a")),
              fmt::format("{} of the study's {} rows; the others are in other parts, or were not "
                          "measured yet",
                          first_.rows.size(), rows));
    EXPECT_THAT(mergeError(), HasSubstr("all/sweep.json: expected a folder without a sweep"));
}

TEST_F(SweepParts, MayNotMeasureTheSameTwice) {
    second_.rows[1] = first_.rows[0];
    second_.rows[1].thumbnail = "";
    EXPECT_EQ(mergeError(),
              "b/sweep.csv: \"hbao samples=2 blur=1\" on view \"view 1\" of \"atrium\" at "
              "640 x 360, R 0.5 was measured already in a/sweep.csv");
    static_cast<SweepErrors&>(second_.rows[1]) = {};
    EXPECT_THAT(mergeError(), testing::StartsWith("b/sweep.csv: the time of \"hbao samples=2"));
    second_.rows.pop_back();
    second_.rows.resize(1);
    second_.growth = {first_.growth[0]};
    EXPECT_THAT(mergeError(), HasSubstr("was measured already in a/growth.csv"));
}

// Errors of one machine and times of another, of the same rows.
TEST_F(SweepParts, GiveARowItsErrorsAndItsTimes) {
    first_ = second_ = test::smallSweep();
    first_.growth.clear();
    first_.machine.errorsBy = "a GPU";
    static_cast<TimedOn&>(first_.machine) = {};
    for (SweepRow& row : first_.rows)
        static_cast<SweepTimes&>(row) = {};
    for (SweepRow& row : second_.rows)
        static_cast<SweepErrors&>(row) = {};
    second_.rows.pop_back();
    const Sweep all = merge();
    Sweep expected = test::smallSweep();
    static_cast<SweepTimes&>(expected.rows.back()) = {};
    EXPECT_EQ(sweepCsv(all.rows), sweepCsv(expected.rows));
    EXPECT_EQ(all.machine.renderer, expected.machine.renderer);
    EXPECT_EQ(all.machine.errorsBy, "a GPU");
    EXPECT_EQ(all.machine.notes, "");
    EXPECT_EQ(incompleteness(all),
              fmt::format("1 of {0} rows have no times, which obscura-bench sweep STUDY --measure "
                          "times adds",
                          expected.rows.size()));
}

// Neither processors nor renderers nor clocks may be mixed; but errors stay, and so does what most
// rows have.
TEST_F(SweepParts, KeepTheTimesOfOneKindOfMachine) {
    second_.machine.method = second_.machine.method + ": a load takes 28.4 ms";
    EXPECT_EQ(merge().machine.notes, "") << "what the clock was chosen by is no other clock";
    std::filesystem::remove_all(folder_ / "all");

    second_.machine.processor = "another";
    first_.rows.push_back(second_.rows.back());
    second_.rows.pop_back();
    const Sweep all = merge();
    EXPECT_EQ(timed(all), first_.rows.size());
    EXPECT_EQ(all.machine.processor, first_.machine.processor);
    EXPECT_EQ(all.growth.size(), first_.growth.size());
    EXPECT_TRUE(std::all_of(all.rows.begin(), all.rows.end(),
                            [](const SweepRow& row) { return row.hasErrors(); }));
    EXPECT_THAT(all.machine.notes,
                testing::StartsWith(fmt::format("{} rows were timed on another kind of machine "
                                                "(llvmpipe",
                                                second_.rows.size())));
    EXPECT_THAT(all.machine.notes, HasSubstr("another, glFinish"));
    EXPECT_THAT(all.machine.notes, HasSubstr("--measure times"));
    EXPECT_EQ(readSweep(folder_ / "all").machine.notes, all.machine.notes);
}

TEST_F(SweepParts, MustBeOfOneStudyAndProgram) {
    second_.machine.study = "another";
    EXPECT_THAT(mergeError(), HasSubstr("b/sweep.json: study: expected \"aaaa"));
    second_.machine.study = first_.machine.study;
    first_.machine.program = "obscura 0.1 (abc, code 0123)";
    second_.machine.program = "obscura 0.1 (abc, code 4567)";
    EXPECT_THAT(mergeError(), HasSubstr("b/sweep.json: program: expected"));
    second_.machine.program = "obscura 0.1 (def, code 0123)"; // a commit that measures alike
    second_.machine.display = "a screen";
    EXPECT_THAT(mergeError(), HasSubstr("b/sweep.json: display: expected"));
    second_.machine.display = first_.machine.display;
    EXPECT_EQ(merge().rows.size(), test::smallSweep().rows.size());
}

} // namespace
} // namespace obscura
