#include "base/error.h"
#include "base/files.h"
#include "bench/stability/csv.h"
#include "bench/stability/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr StabilityTest tests[] = {
    {"halo", "Halo behind a <pole>", "A pole & a wall.", "darkness", 0.02, 0.25},
    {"scale", "Scale", "Twice the size.", "RMSE", 0.01, 0.1}};

std::vector<StabilityCell> sample() {
    return {
        {"truth", "", "halo", "darkness", 0, "pictures/truth.png", "ray tracing"},
        {"hbao steps=8", "hbao", "halo", "darkness", -0.1234, "pictures/halo.png", "5°, \"far\""},
        {"hbao steps=8", "hbao", "halo", "the most", 0.5},
        {"hbao steps=8", "hbao", "scale", "RMSE", 0.01},
        {"hbao steps=8", "hbao", "halo", "worst flicker", 0.25, "pictures/worst.gif",
         "below: none"},
        {"none", "none", "halo", "darkness"}};
}

class StabilityFiles : public testing::Test {
  protected:
    StabilityFiles() {
        writeFile(folder / "pictures/truth.png", "truth's bytes");
        writeFile(folder / "pictures/halo.png", "halo's bytes");
        writeFile(folder / "pictures/worst.gif", "it moves");
    }
    ~StabilityFiles() override { fs::remove_all(folder); }
    const fs::path folder = fs::path(testing::TempDir()) /
                            testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(StabilityFiles, CsvComesBackAsItWas) {
    writeFile(folder / "stability.csv", stabilityCsv(tests, sample()));
    const std::vector<StabilityCell> back = readStabilityCsv(folder / "stability.csv");
    ASSERT_EQ(back.size(), sample().size());
    for (std::size_t i = 0; i < back.size(); ++i) {
        EXPECT_EQ(back[i].configuration, sample()[i].configuration);
        EXPECT_EQ(back[i].measure, sample()[i].measure);
        EXPECT_EQ(back[i].picture, sample()[i].picture);
        EXPECT_EQ(back[i].note, sample()[i].note);
        EXPECT_THAT(back[i].value, testing::NanSensitiveDoubleEq(sample()[i].value));
    }
}

TEST_F(StabilityFiles, CsvSaysWhichHeadlinesPass) {
    const std::string csv = stabilityCsv(tests, sample());
    EXPECT_THAT(csv, HasSubstr("hbao steps=8,hbao,halo,darkness,-0.1234,0,"));
    EXPECT_THAT(csv, HasSubstr("hbao steps=8,hbao,halo,the most,0.5,,"));
    EXPECT_THAT(csv, HasSubstr("hbao steps=8,hbao,scale,RMSE,0.01,1,"));
    EXPECT_THAT(csv, HasSubstr("none,none,halo,darkness,nan,0,")); // no answer is a failure
}

TEST_F(StabilityFiles, BrokenCsvNamesTheLine) {
    const auto fault = [&](const std::string& text) -> std::string {
        writeFile(folder / "stability.csv", text);
        try {
            readStabilityCsv(folder / "stability.csv");
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const std::string whole = stabilityCsv(tests, sample());
    EXPECT_THAT(fault("a,b\n"), HasSubstr("unknown column"));
    EXPECT_THAT(fault(whole + "x,y,z\n"), HasSubstr(":8: expected 8 columns, found 3"));
    EXPECT_THAT(fault(whole + "a,b,c,d,many,,,\n"), HasSubstr("expected a number, found \"many\""));
}

TEST_F(StabilityFiles, PageHasNumbersPicturesAndNothingFromElsewhere) {
    const std::string page = stabilityHtml(tests, sample(), folder, "{\"program\": \"obscura\"}");
    EXPECT_THAT(page, HasSubstr("default-src 'none'; img-src data:"));
    EXPECT_THAT(page, HasSubstr(">−0.123</a>"));
    EXPECT_THAT(page, HasSubstr(">0.010</a>"));
    EXPECT_THAT(page, HasSubstr(">–</a>"));
    EXPECT_THAT(page, HasSubstr("href=\"#halo-hbao_steps=8\""));
    EXPECT_THAT(page, HasSubstr("<figure id=\"halo-hbao_steps=8\">"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,aGFsbydzIGJ5dGVz")); // "halo's bytes"
    EXPECT_THAT(page, HasSubstr("data:image/gif;base64,aXQgbW92ZXM="));     // "it moves"
    EXPECT_THAT(page, HasSubstr("<b>hbao steps=8, halo: 0.250</b> (below: none)"));
    EXPECT_THAT(page, Not(HasSubstr("<td>worst flicker</td>")));
    EXPECT_THAT(page, HasSubstr("<td>the most</td><td>0.500</td>"));
    EXPECT_THAT(page, HasSubstr("Halo behind a &lt;pole&gt;"));
    EXPECT_THAT(page, HasSubstr("<td class=\"count\">1</td>")); // hbao fails one of two
    EXPECT_THAT(page, HasSubstr("{&quot;program&quot;: &quot;obscura&quot;}"));
    EXPECT_THAT(page, Not(HasSubstr("http://")));
    EXPECT_THAT(page, Not(HasSubstr("src=\"pictures")));
    EXPECT_THAT(page, Not(HasSubstr("<th scope=\"row\">truth</th>")));
}

TEST_F(StabilityFiles, MissingPictureIsNamed) {
    fs::remove(folder / "pictures/halo.png");
    try {
        stabilityHtml(tests, sample(), folder, "{\"program\": \"obscura\"}");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("pictures/halo.png"));
    }
}

// As the results in docs/results are: what was measured is there all the same.
TEST_F(StabilityFiles, PageHasNoPicturesWhereTheFolderHasNone) {
    const std::string with = stabilityHtml(tests, sample(), folder, "{}");
    fs::remove_all(folder / "pictures");
    const std::string page = stabilityHtml(tests, sample(), folder, "{}");
    EXPECT_THAT(with, Not(HasSubstr("no pictures")));
    EXPECT_THAT(page, HasSubstr("no pictures"));
    EXPECT_THAT(page, Not(HasSubstr("<img")));
    EXPECT_THAT(page, HasSubstr("<figure id=\"halo-hbao_steps=8\"><figcaption><b>hbao steps=8: "));
    EXPECT_THAT(page, HasSubstr("<td>the most</td><td>0.500</td>"));
}

} // namespace
} // namespace obscura
