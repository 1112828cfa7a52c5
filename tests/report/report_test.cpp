#include "report/gnuplot.h"
#include "report/html.h"
#include "report/lettering.h"
#include "report/number.h"
#include "report/paper_figure.h"
#include "tests/error_of.h"
#include "tests/report/xml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Gnuplot, ReportsAFaultInItsScript) {
    EXPECT_THAT(test::errorOf([] { gnuplotSvg("set terminal svg\nplot sin(\n", "x"); }),
                StartsWith("gnuplot failed (status 1): "));
    EXPECT_THAT(test::errorOf([] { gnuplotPdf("set terminal svg\nplot sin(x)\n"); }),
                StartsWith("gnuplot failed (status 0): "));
}

TEST(Gnuplot, DrawsPdf) {
    EXPECT_THAT(gnuplotPdf("set terminal pdfcairo\nplot sin(x)\n"),
                AllOf(StartsWith("%PDF-"), HasSubstr("%%EOF"),
                      HasSubstr("CreationDate (D:19800101000000")));
}

TEST(Number, HasSignificantDigitsAndNoExponent) {
    EXPECT_EQ(readable(0.0123456), "0.0123");
    EXPECT_EQ(readable(12.3456), "12.3");
    EXPECT_EQ(readable(123456), "123456");
    EXPECT_EQ(readable(0.9996), "1.00"); // and not 1.000
    EXPECT_EQ(readable(-2.5, 2), "−2.5");
    EXPECT_EQ(readable(0), "0.00");
    EXPECT_EQ(readable(std::nan("")), "–");
    EXPECT_EQ(readable(-HUGE_VAL), "−∞");
}

TEST(Html, LoadsNothingAndRunsScriptsOnlyWhereAsked) {
    const std::string page = pageHead("a < b", "p { color: red; }");
    EXPECT_THAT(page, AllOf(HasSubstr("<title>a &lt; b</title>"), HasSubstr("p { color: red; }"),
                            Not(HasSubstr("script-src"))));
    EXPECT_EQ(test::foreignReference(page), "");
    EXPECT_THAT(pageHead("", "", true), HasSubstr("; script-src 'unsafe-inline'\""));
    EXPECT_EQ(element("p", "a & b"), "<p>a &amp; b</p>\n");
}

TEST(Html, EscapesAndEncodes) {
    EXPECT_EQ(escaped("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
    EXPECT_EQ(dataAddress("text/plain", ""), "data:text/plain;base64,");
    EXPECT_EQ(dataAddress("text/plain", "a"), "data:text/plain;base64,YQ==");
    EXPECT_EQ(dataAddress("text/plain", "abc"), "data:text/plain;base64,YWJj");
}

TEST(Lettering, CountsLettersNotBytes) {
    EXPECT_EQ(letters("χ² – é"), 6u);
    EXPECT_EQ(shortened("χ² – é", 6), "χ² – é");
    EXPECT_EQ(shortened("χ² – é!", 6), "χ² – …");
    EXPECT_EQ(shortened("ab", 1), "…");
    EXPECT_THAT(wrapped(" one  two three", 7), testing::ElementsAre("one two", "three"));
    EXPECT_THAT(wrapped("unbreakable é é", 3), testing::ElementsAre("unbreakable", "é é"));
    EXPECT_TRUE(wrapped("", 3).empty());
}

TEST(PageSvg, CanStandTwiceInOnePage) {
    const Figure figure{"x", "A & B", "plot x with points title ' id=\"gp'\n", 4, 3};
    const std::string svg = pageSvg(figure, 340, 255, "left");
    EXPECT_THAT(svg, StartsWith("<svg class=\"left\" role=\"img\" aria-label=\"A &amp; B\""));
    EXPECT_THAT(svg, AllOf(HasSubstr("viewBox=\"0 0 340 255\""), HasSubstr("id='left-gpPt0'"),
                           HasSubstr("xlink:href='#left-gpPt0'"), Not(HasSubstr("id='gp")),
                           Not(HasSubstr("='#gp")), HasSubstr("> id=\"gp<")));
    EXPECT_EQ(test::faultOfXml(svg), "");
}

TEST(Xml, FindsFaults) {
    EXPECT_EQ(test::faultOfXml("<a><b/></a>"), "");
    EXPECT_EQ(test::faultOfXml("<a><b></a>"), "</a>");
    EXPECT_EQ(test::faultOfXml("<a>x & y</a>"), "& y</a>");
}

} // namespace
} // namespace obscura
