#include "base/csv.h"
#include "base/files.h"
#include "bench/sweep/files.h"
#include "tests/bench/sweep/sample_sweep.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>

namespace obscura {
namespace {

using testing::HasSubstr;

class SweepFiles : public testing::Test {
  protected:
    // What writing, changing a text in a file, and reading complains of, without the folder.
    std::string errorAfter(const std::string& file, const std::string& from,
                           const std::string& to) {
        writeSweep(folder_ / "s", test::smallSweep());
        std::string text = readFile(folder_ / "s" / file);
        const std::size_t at = text.find(from);
        EXPECT_NE(at, text.npos);
        writeFile(folder_ / "s" / file, text.replace(at, from.size(), to));
        return withoutFolder(test::errorOf([&] { readSweep(folder_ / "s"); }));
    }

    std::string withoutFolder(std::string text) {
        const std::string path = folder_.path().string() + "/";
        for (std::size_t at; (at = text.find(path)) != text.npos;)
            text.erase(at, path.size());
        return text;
    }

    test::Folder folder_;
};

TEST_F(SweepFiles, ReadBackExactly) {
    Sweep sweep = test::smallSweep();
    SweepRow& row = sweep.rows[0];
    row.name = "a,b \"c\"\n<d> & 'é'";
    row.total = {0.1 + 0.2, 5e-324, 1.7976931348623157e308};
    row.raw = {std::nan(""), -0.0, HUGE_VAL, -1.0 / 3};
    row.frames = -7;
    row.thumbnail = "";
    sweep.growth[0].axis = "\"";
    sweep.machine.clocks = "1 GHz\n\"turbo\"";
    sweep.machine.display = "24-inch";
    writeSweep(folder_ / "s", sweep);
    const Sweep read = readSweep(folder_ / "s");
    EXPECT_EQ(sweepCsv(read.rows), sweepCsv(sweep.rows));
    EXPECT_EQ(growthCsv(read.growth), growthCsv(sweep.growth));
    EXPECT_EQ(read.machine.clocks, sweep.machine.clocks);
    EXPECT_EQ(read.machine.study, sweep.machine.study);
    const SweepRow& same = read.rows[0];
    EXPECT_EQ(same.name, row.name);
    EXPECT_EQ(same.total.median, 0.1 + 0.2);
    EXPECT_EQ(same.total.low, 5e-324);
    EXPECT_EQ(same.total.high, 1.7976931348623157e308);
    EXPECT_TRUE(std::isnan(same.raw.rmse));
    EXPECT_TRUE(std::signbit(same.raw.bias));
    EXPECT_EQ(same.raw.ssim, HUGE_VAL);
    EXPECT_EQ(same.raw.flip, -1.0 / 3);
    EXPECT_EQ(same.frames, -7);
    EXPECT_EQ(same.litMatched.flip, row.litMatched.flip);
    EXPECT_EQ(same.litMatched.jod, row.litMatched.jod);
    EXPECT_TRUE(std::isnan(same.matched.jod));
    EXPECT_EQ(read.machine.display, sweep.machine.display);
    EXPECT_EQ(same.work, row.work);
}

TEST_F(SweepFiles, HaveAColumnForEachFieldAndAnEmptyCellForNaN) {
    SweepRow row;
    row.configuration = "hbao";
    row.raw.rmse = std::nan("");
    row.total.high = 1.5;
    const auto records = splitCsv(sweepCsv({row}));
    ASSERT_EQ(records.size(), 2u);
    const auto& names = records[0].cells;
    ASSERT_EQ(names.size(), records[1].cells.size());
    const auto cell = [&](const std::string& name) {
        const auto at = std::find(names.begin(), names.end(), name);
        EXPECT_NE(at, names.end()) << name;
        return at == names.end() ? ""
                                 : records[1].cells[static_cast<std::size_t>(at - names.begin())];
    };
    EXPECT_EQ(names.size(), 10u + 14 + 6 * 4 + 2 + 1);
    EXPECT_EQ(cell("configuration"), "hbao");
    EXPECT_EQ(cell("full_raw_rmse"), "");
    EXPECT_EQ(cell("frames"), "0");
    EXPECT_EQ(cell("bytes_per_pixel"), "0");
    EXPECT_EQ(cell("lit_raw_jod"), "");
    EXPECT_EQ(cell("total_95th_percentile_ms"), "1.5");
    EXPECT_EQ(cell("prepare_median_ms"), "");
}

TEST_F(SweepFiles, NameThePlaceOfAFault) {
    EXPECT_EQ(errorAfter("sweep.csv", ",640,", ",6.40,"),
              "s/sweep.csv:2:9: width: expected a whole number, found \"6.40\"");
    EXPECT_EQ(errorAfter("sweep.csv", ",0.5,", ",half,"),
              "s/sweep.csv:2:8: radius: expected a number, found \"half\"");
    EXPECT_EQ(errorAfter("growth.csv", "axis", "axes"),
              "s/growth.csv:1: axes: unknown column; did you mean \"axis\"?");
    EXPECT_THAT(errorAfter("sweep.csv", "atrium,", ""),
                testing::StartsWith("s/sweep.csv:2: expected 51 columns, found 50"));
    EXPECT_THAT(errorAfter("sweep.json", "\"vendor\"", "\"seller\""),
                HasSubstr("s/sweep.json: vendor: expected a text of this name, found none"));
    EXPECT_THAT(errorAfter("sweep.json", ",", ";"), HasSubstr("line 2, column"));
    EXPECT_THAT(errorAfter("sweep.json", "\"formatVersion\": 4", "\"formatVersion\": 5"),
                HasSubstr("s/sweep.json: formatVersion: expected 1 ... 4, found 5; a later"));
}

// Takes a column, the last but one, out of every line.
std::string withoutJod(const std::string& csv) {
    std::string result;
    for (const CsvRecord& record : splitCsv(csv))
        for (std::size_t i = 0; i < record.cells.size(); ++i)
            if (i + 2 != record.cells.size())
                result += csvCell(record.cells[i]) + (i + 1 < record.cells.size() ? "," : "\n");
    return result;
}

TEST_F(SweepFiles, OfAnEarlierVersionMayLackColumns) {
    writeSweep(folder_ / "s", test::smallSweep());
    writeFile(folder_ / "s/sweep.csv", withoutJod(readFile(folder_ / "s/sweep.csv")));
    EXPECT_THAT(test::errorOf([&] { readSweep(folder_ / "s"); }),
                HasSubstr("expected column \"lit_matched_jod\", found \"thumbnail\""));
    std::string json = readFile(folder_ / "s/sweep.json");
    const std::string version = "  \"formatVersion\": 4,\n";
    writeFile(folder_ / "s/sweep.json", json.erase(json.find(version), version.size()));
    const Sweep read = readSweep(folder_ / "s");
    EXPECT_EQ(read.machine.formatVersion, 1);
    EXPECT_EQ(read.machine.display, test::smallSweep().machine.display);
    EXPECT_TRUE(std::isnan(read.rows.at(0).litMatched.jod));
    EXPECT_EQ(read.rows.at(0).litMatched.flip, test::smallSweep().rows.at(0).litMatched.flip);
    EXPECT_EQ(read.rows.at(0).thumbnail, test::smallSweep().rows.at(0).thumbnail);
}

TEST_F(SweepFiles, RefuseALineThatWasCutOff) {
    writeSweep(folder_ / "s", test::smallSweep());
    std::string text = readFile(folder_ / "s/sweep.csv");
    text.pop_back();
    writeFile(folder_ / "s/sweep.csv", text);
    EXPECT_THAT(test::errorOf([&] { readSweep(folder_ / "s"); }), HasSubstr("it was cut off"));
}

} // namespace
} // namespace obscura
