#include "analysis/chart.h"

#include "analysis/verdict.h"
#include "report/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

// Lengths in the SVG's units; a browser scales the whole.
constexpr int plotWidth = 500, countsWidth = 100;
constexpr int rowHeight = 30, headHeight = 54, footHeight = 76, fontSize = 14;
constexpr double glyphWidth = 0.56 * fontSize; // of the sans-serif faces browsers use, on average

constexpr const char* blue = "#0072B2";
constexpr const char* grey = "#555555";

std::string pairText(const Tally& tally) {
    return fmt::format("{}: {} / {}", tally.scene, tally.techniqueA, tally.techniqueB);
}

// One line of the chart: a level's heading or a condition.
struct Line {
    const Tally* tally; // null for a heading
    std::string text;
};

std::vector<Line> linesOf(const std::vector<Tally>& tallies) {
    std::vector<Line> lines;
    for (const Tally& tally : tallies) {
        if (lines.empty() || lines.back().tally->level != tally.level)
            lines.push_back({nullptr, tally.level});
        lines.push_back({&tally, pairText(tally)});
    }
    return lines;
}

// The picture and, within it, the plot.
struct Frame {
    int width = 0, height = 0, left = 0;

    double x(double length) const { return length / width; } // as gnuplot's screen coordinates
    double y(double fromTop) const { return 1 - fromTop / height; }
    double counts() const { return x(width - countsWidth / 2.0); }
};

Frame frameOf(const std::vector<Line>& lines) {
    std::size_t longest = 0;
    for (const Line& line : lines)
        longest = std::max(longest, line.text.size());
    const int left = static_cast<int>(glyphWidth * static_cast<double>(longest)) + 40;
    return {left + plotWidth + countsWidth,
            headHeight + static_cast<int>(lines.size()) * rowHeight + footHeight, left};
}

std::string setFrame(const Frame& frame, std::size_t rows) {
    return fmt::format("set terminal svg size {},{} dynamic font 'sans-serif,{}' background rgb "
                       "'white'\n"
                       "set lmargin at screen {}\nset rmargin at screen {}\n"
                       "set tmargin at screen {}\nset bmargin at screen {}\n"
                       "set yrange [{}:-0.5]\n",
                       frame.width, frame.height, fontSize, frame.x(frame.left),
                       frame.x(frame.left + plotWidth), frame.y(headHeight),
                       frame.y(frame.height - footHeight), static_cast<double>(rows) - 0.5);
}

std::string labels(const std::vector<Line>& lines, const Frame& frame) {
    std::string script;
    for (std::size_t y = 0; y < lines.size(); ++y) {
        const auto& [tally, text] = lines[y];
        script +=
            fmt::format("set label {} at screen {}, first {} left\n",
                        tally ? gnuplotText(text) : gnuplotBold(text), frame.x(tally ? 22 : 4), y);
        if (tally)
            script += fmt::format("set label '{} : {}' at screen {}, first {} center\n",
                                  tally->votes.a, tally->votes.b, frame.counts(), y);
    }
    return script;
}

// Rows "x low high y" of the conditions that differ from an even split, or of the others; first a
// row outside the picture, because gnuplot refuses to plot nothing.
std::string data(const Findings& findings, const std::vector<Line>& lines, const char* name,
                 bool different) {
    const auto verdicts = verdictsOf(findings.tallies);
    std::string block = fmt::format("${} << END\n-9 -9 -9 -9\n", name);
    for (std::size_t y = 0; y < lines.size(); ++y) {
        const Tally* tally = lines[y].tally;
        const auto verdict =
            tally ? verdicts[static_cast<std::size_t>(tally - findings.tallies.data())]
                  : std::nullopt;
        if (!verdict || verdict->differs() != different)
            continue;
        const Interval interval = intervalOf(*tally);
        block += fmt::format("{} {} {} {}\n", 100.0 * tally->votes.b / tally->votes.total(),
                             100 * interval.low, 100 * interval.high, y);
    }
    return block + "END\n";
}

// What stands over the plot: the key and, large and pale behind everything, the stamp.
std::string heading(const Findings& findings, const Frame& frame) {
    const std::string stamp = stampOf(findings).empty() ? "" : sourceOf(findings) + " DATA";
    const auto keyEntry = [&](const char* text, double x, int mark, const char* colour) {
        return fmt::format("set label '{}' at graph {}, screen {} offset char 0.8, -0.25 point "
                           "pointtype {} pointsize 1.2 linewidth 2 linecolor rgb '{}'\n",
                           text, x, frame.y(headHeight / 2.0), mark, colour);
    };
    return fmt::format("set label {} at screen 0.5, screen 0.5 center rotate by 15 back "
                       "font 'sans-serif,64' textcolor rgb '#F3DACD'\n"
                       "set label 'votes a : b' at screen {}, screen {} center\n",
                       gnuplotBold(stamp), frame.counts(), frame.y(headHeight / 2.0)) +
           keyEntry("exact p < .05, Holm", 0.02, 7, blue) + keyEntry("p ≥ .05", 0.55, 6, grey);
}

constexpr const char* style = R"(set encoding utf8
set border 1 linecolor rgb '#555555'
set xrange [0:100]
set xtics 0, 25, 100 nomirror out format '%.0f %%'
set mxtics 5
set grid xtics linetype 1 linewidth 0.5 linecolor rgb '#DDDDDD'
unset ytics
unset key
set xlabel '← more votes for a        share of votes for b, 95 % exact interval        more votes for b →'
set arrow from first 50, graph 0 to first 50, graph 1 nohead linewidth 1.5 dashtype 2 linecolor rgb '#333333'
set bars small
)";

// An open mark is a white one with a rim, so that the interval does not run through it.
constexpr const char* plot =
    R"(plot $different using 1:4:2:3 with xerrorbars linewidth 2 pointtype 7 pointsize 1.2 linecolor rgb '{0}' title 'exact p < .05', \
  $other using 1:4:2:3 with xerrorbars linewidth 2 pointtype 7 pointsize 0.1 linecolor rgb '{1}' title 'p ≥ .05', \
  $other using 1:4 with points pointtype 7 pointsize 1.2 linecolor rgb 'white' title 'p ≥ .05', \
  $other using 1:4 with points pointtype 6 pointsize 1.2 linewidth 2 linecolor rgb '{1}' title 'p ≥ .05'
)";

} // namespace

std::string chartScript(const Findings& findings) {
    const std::vector<Line> lines = linesOf(findings.tallies);
    const Frame frame = frameOf(lines);
    return style + setFrame(frame, lines.size()) + heading(findings, frame) + labels(lines, frame) +
           data(findings, lines, "different", true) + data(findings, lines, "other", false) +
           fmt::format(plot, blue, grey);
}

std::string chartSvg(const Findings& findings) {
    return gnuplotSvg(chartScript(findings), "Share of votes for b, per condition");
}

} // namespace obscura
