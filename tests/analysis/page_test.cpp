// The report's page as its readers meet it: wide and narrow, light and dark, by eye, by keyboard
// and by ear.

#include "analysis/figure_list.h"
#include "analysis/report.h"
#include "analysis/report_parts.h"
#include "analysis/table.h"
#include "report/html.h"
#include "tests/analysis/sample_findings.h"
#include "tests/report/xml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::smatch> matches(const std::string& text, const char* pattern) {
    const std::regex regex(pattern);
    return {std::sregex_iterator(text.begin(), text.end(), regex), std::sregex_iterator()};
}

class Page : public testing::Test {
  protected:
    test::Folder folder_;
    const Findings findings_ = test::studied(folder_, true);
    const std::string page_ = reportHtml(findings_);
};

// A drawing is never shown narrower than 760 pixels, or 288 in a window of 320.
TEST_F(Page, HasNoTypeBelowElevenPixels) {
    struct Kind {
        const char* name;
        double drawn, least;
    };
    for (const auto& [name, drawn, least] : {Kind{"broad", 760, 760}, Kind{"narrow", 340, 288}}) {
        const std::string opening = fmt::format("<div class=\"drawing {}\">", name);
        std::size_t figures = 0;
        for (std::size_t at = 0; (at = page_.find(opening, at)) != page_.npos; ++at, ++figures) {
            const std::string svg = page_.substr(at, page_.find("</svg>", at) - at);
            EXPECT_THAT(svg, HasSubstr(fmt::format("viewBox=\"0 0 {:.0f} ", drawn)));
            const auto sizes = matches(svg, R"re(font-size="([\d.]+)")re");
            EXPECT_FALSE(sizes.empty());
            for (const std::smatch& size : sizes)
                EXPECT_GE(std::stod(size[1]) * least / drawn, 11) << opening;
        }
        EXPECT_EQ(figures, figuresOf(findings_).size());
    }
    EXPECT_THAT(std::string(reportStyle), HasSubstr("screen and (max-width: 820px)"));
}

TEST_F(Page, IsWellFormedAndNamesEverythingOnce) {
    EXPECT_EQ(test::faultOfXml(page_), "");
    std::set<std::string> ids;
    for (const std::smatch& id : matches(page_, R"re(<[^>]*\sid=["']([^"']+)["'])re"))
        EXPECT_TRUE(ids.insert(id[1]).second) << id[1];
    for (const std::smatch& link : matches(page_, R"re(href=["']#([^"']+)["'])re"))
        EXPECT_TRUE(ids.contains(link[1])) << link[1];
}

TEST_F(Page, CanBeHeard) {
    int level = 0;
    for (const std::smatch& heading : matches(page_, "<h([1-6])")) {
        const int now = std::stoi(heading[1]);
        EXPECT_LE(now, level + 1);
        level = now;
    }
    EXPECT_THAT(page_, HasSubstr("<html lang=\"en\">"));
    EXPECT_THAT(page_, HasSubstr("<main>"));
    for (const std::smatch& head : matches(page_, "<th[ >][^>]*>?"))
        EXPECT_THAT(head.str(), HasSubstr("scope=\"")) << head.str();
    for (const std::smatch& svg : matches(page_, "<svg[^>]*>"))
        EXPECT_THAT(svg.str(),
                    testing::AllOf(HasSubstr("role=\"img\""), HasSubstr("aria-label=\"")));
    for (const std::smatch& image : matches(page_, "<img[^>]{0,80}"))
        EXPECT_THAT(image.str(), HasSubstr("alt=\""));
}

// Whatever is wider than a narrow window scrolls in a box of its own, which the keyboard reaches.
TEST_F(Page, ScrollsTablesInTheirOwnBoxes) {
    const auto
        tables = matches(page_, "<table>"),
        boxes = matches(
            page_,
            "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"[^\"]+\"><table>");
    EXPECT_GE(tables.size(), 4u);
    EXPECT_EQ(tables.size(), boxes.size());
}

TEST_F(Page, GivesTheAnswerBeforeFiguresAndFiguresBeforeNumbers) {
    const std::size_t stamp = page_.find("SIMULATED DATA:"), answer = page_.find("id=\"answer\""),
                      figures = page_.find("id=\"figures\""),
                      numbers = page_.find("id=\"numbers\""),
                      methods = page_.find("id=\"methods\"");
    EXPECT_LT(stamp, answer);
    EXPECT_LT(answer, figures);
    EXPECT_LT(figures, numbers);
    EXPECT_LT(numbers, methods);
    EXPECT_NE(methods, page_.npos);
    for (const StudyFigure& figure : figuresOf(findings_))
        for (const auto& row : figure.numbers.rows)
            for (const std::string& cell : row)
                EXPECT_GT(page_.rfind(escaped(cell)), numbers) << figure.drawing.name;
}

TEST_F(Page, ShowsResultsWithWhatWasExcludedToo) {
    EXPECT_THAT(page_, Not(HasSubstr("id=\"numbers-excluded\"")));
    Findings findings = findings_;
    findings.exclusions = {{"P01", "1", "fell asleep", 2}};
    findings.whole = {findings.tallies, {}};
    const std::string page = reportHtml(findings);
    EXPECT_THAT(page, HasSubstr("id=\"numbers-excluded\""));
    EXPECT_THAT(page, HasSubstr("fell asleep"));
    EXPECT_THAT(page, HasSubstr("aria-label=\"Each condition, with all answers\""));
}

// WCAG 2.2, relative luminance and contrast ratio; a colour is three shares, 0 to 1.
using Colour = std::array<double, 3>;

Colour hex(const std::string& text) {
    const auto part = [&](std::size_t at) {
        return std::stoi(text.substr(at, 2), nullptr, 16) / 255.0;
    };
    return {part(1), part(3), part(5)};
}

double luminance(const Colour& colour) {
    const auto linear = [](double c) {
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
}

double contrast(const Colour& x, const Colour& y) {
    const double a = luminance(x), b = luminance(y);
    return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

// invert(.92) hue-rotate(180deg), by the matrices of the W3C's Filter Effects.
Colour turnedOver(Colour colour) {
    for (double& c : colour)
        c = c * (1 - 2 * 0.92) + 0.92;
    const double r = 0.213, g = 0.715, b = 0.072;
    const auto [x, y, z] = colour;
    const auto clamped = [](double c) { return std::clamp(c, 0.0, 1.0); };
    return {clamped((2 * r - 1) * x + 2 * g * y + 2 * b * z),
            clamped(2 * r * x + (2 * g - 1) * y + 2 * b * z),
            clamped(2 * r * x + 2 * g * y + (2 * b - 1) * z)};
}

// The custom properties of the first block, light, or of the second, dark.
std::map<std::string, Colour> scheme(std::size_t which) {
    const std::string style(reportStyle);
    const std::string block = matches(style, R"re(:root \{[^}]*\})re").at(which).str();
    std::map<std::string, Colour> colours;
    for (const std::smatch& match : matches(block, R"re(--(\w+): (#[0-9A-Fa-f]{6}))re"))
        colours[match[1]] = hex(match[2]);
    return colours;
}

TEST(PageColours, HaveTheContrastOfWcagInLightAndDark) {
    for (const std::size_t which : {0u, 1u}) {
        const auto colours = scheme(which);
        for (const auto& [text, ground] :
             {std::pair("ink", "paper"), std::pair("soft", "paper"), std::pair("link", "paper"),
              std::pair("ink", "shade"), std::pair("ink", "panel")})
            EXPECT_GE(contrast(colours.at(text), colours.at(ground)), 4.5) << text << which;
    }
    EXPECT_GE(contrast(hex("#B33A00"), hex("#ffffff")), 4.5) << "the stamp";
    EXPECT_THAT(std::string(reportStyle), HasSubstr(".stamp { background: #B33A00; color: white"));
}

// What figures are drawn with, but for the grid and the pale stamp, of which nothing depends.
TEST(PageColours, OfFiguresHaveItTooTurnedOverOrNot) {
    const test::Folder folder;
    EXPECT_THAT(std::string(reportStyle), HasSubstr("invert(.92) hue-rotate(180deg)"));
    const Colour white = hex("#ffffff"), dark = scheme(1).at("paper");
    const Colour ground = turnedOver(white);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(ground[i], dark[i], 2.0 / 255) << "white turns into the page's colour";
    for (const StudyFigure& figure : figuresOf(test::studied(folder, false)))
        for (const std::smatch& match :
             matches(figure.drawing.script, R"re(linecolor rgb '(#[0-9A-F]{6})')re")) {
            const std::string colour = match[1];
            if (colour == "#DDDDDD" || colour == "#BBBBBB")
                continue;
            EXPECT_GE(contrast(hex(colour), white), 3) << colour << figure.drawing.name;
            EXPECT_GE(contrast(turnedOver(hex(colour)), dark), 3) << colour << figure.drawing.name;
        }
}

class Starters : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Starters, LoadTheTablesAndDisagreeWithAWrongOne) {
    const char *program = GetParam().first, *script = GetParam().second;
    if (std::system(fmt::format("command -v {} >/dev/null", program).c_str()) != 0)
        GTEST_SKIP() << program << " is not installed: " << script << " WAS NOT RUN";
    const test::Folder folder;
    const Findings findings = test::thesis();
    std::string votes = resultCsv(findings);
    const auto run = [&] {
        writeFile(folder / "out/the \"votes\".csv", votes);
        writeFile(folder / "out/tests.csv", testsCsv(findings));
        writeBesideReport(folder / "out", folder / "out/the \"votes\".csv", findings);
        return std::system(fmt::format("cd / && {} '{}' >'{}' 2>&1", program,
                                       (folder / "out" / script).string(),
                                       (folder / "log").string())
                               .c_str());
    };
    EXPECT_EQ(run(), 0) << readFile(folder / "log");
    EXPECT_THAT(readFile(folder / "log"), HasSubstr("7 conditions, "));
    const std::size_t at = votes.find("0.0288167");
    ASSERT_NE(at, votes.npos);
    votes.replace(at, 9, "0.0388167");
    EXPECT_NE(run(), 0) << readFile(folder / "log");
}

INSTANTIATE_TEST_SUITE_P(All, Starters,
                         testing::Values(std::pair("Rscript", "start.R"),
                                         std::pair("python3", "start.py")),
                         [](const auto& given) {
                             return std::string(given.index == 0 ? "R" : "Python");
                         });

TEST(BesideReport, LieTheFiguresForPapers) {
    const test::Folder folder;
    writeBesideReport(folder / "out", folder / "out/votes.csv", test::thesis());
    EXPECT_THAT(readFile(folder / "out/figures/shares.svg"), testing::StartsWith("<svg"));
    EXPECT_THAT(readFile(folder / "out/figures/shares.pdf"), testing::StartsWith("%PDF"));
    EXPECT_THAT(readFile(folder / "out/figures/power.gnuplot"), HasSubstr("plot"));
}

} // namespace
} // namespace obscura
