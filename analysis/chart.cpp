#include "analysis/chart.h"

#include "analysis/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

// Lengths in the SVG's units, which a browser takes for pixels.
constexpr int pageWidth = 920, rowHeight = 30, headHeight = 54, footHeight = 76;
constexpr int fontSize = 14;
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

int labelWidth(const std::vector<Line>& lines) {
    std::size_t longest = 0;
    for (const Line& line : lines)
        longest = std::max(longest, line.text.size());
    return std::min(pageWidth / 2, static_cast<int>(glyphWidth * static_cast<double>(longest)) + 30);
}

// Where the plot lies, as fractions of the picture.
std::string frame(int height, int left) {
    return fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
                       "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                       static_cast<double>(left) / pageWidth, 1 - 100.0 / pageWidth,
                       1 - static_cast<double>(headHeight) / height,
                       static_cast<double>(footHeight) / height);
}

std::string labels(const std::vector<Line>& lines) {
    std::string script;
    for (std::size_t y = 0; y < lines.size(); ++y) {
        const Line& line = lines[y];
        const std::string text = gnuplotQuoted(line.text);
        if (!line.tally) {
            script += fmt::format("set label {} at graph 0, first {} offset screen -0.012, 0 right "
                                  "noenhanced font ':Bold'\n",
                                  text, y);
            continue;
        }
        script += fmt::format("set label {} at graph 0, first {} offset screen -0.012, 0 right "
                              "noenhanced\n",
                              text, y);
        script += fmt::format("set label '{} : {}' at graph 1, first {} offset screen 0.055, 0 "
                              "center\n",
                              line.tally->votes.a, line.tally->votes.b, y);
    }
    return script;
}

// Rows "x low high y" of the conditions that differ from an even split, or of the others; first a
// row outside the picture, because gnuplot refuses to plot nothing.
std::string data(const std::vector<Line>& lines, const char* name, bool different) {
    std::string block = fmt::format("${} << END\n-9 -9 -9 -9\n", name);
    for (std::size_t y = 0; y < lines.size(); ++y) {
        const Tally* tally = lines[y].tally;
        if (!tally || tally->votes.total() == 0 || differs(tally->votes) != different)
            continue;
        const Interval interval = wilson(tally->votes.b, tally->votes.total());
        block += fmt::format("{} {} {} {}\n", 100.0 * tally->votes.b / tally->votes.total(),
                             100 * interval.low, 100 * interval.high, y);
    }
    return block + "END\n";
}

std::string heading(const Findings& findings) {
    const std::string stamp = stampOf(findings).empty() ? "" : sourceOf(findings) + " DATA";
    return fmt::format("set label {} at screen 0.5, 0.5 center rotate by 20 font ',60' textcolor "
                       "rgb '#F0D5C8' back\n"
                       "set label 'votes a : b' at graph 1, graph 1 offset screen 0.055, char 1 "
                       "center\n",
                       gnuplotQuoted(stamp));
}

constexpr const char* style = R"(set encoding utf8
set border 1 linecolor rgb '#555555'
set xrange [0:100]
set xtics 0, 10, 100 nomirror out format '%.0f %%'
set mxtics 2
set grid xtics linetype 1 linewidth 0.5 linecolor rgb '#DDDDDD'
unset ytics
set xlabel '← more votes for a          share of votes for b, 95 % Wilson interval          more votes for b →'
set arrow from first 50, graph 0 to first 50, graph 1 nohead linewidth 1.5 dashtype 2 linecolor rgb '#333333'
set key at screen 0.5, screen 0.02 center bottom horizontal maxrows 1 samplen 2
set bars small
)";

} // namespace

std::string chartScript(const Findings& findings) {
    const std::vector<Line> lines = linesOf(findings.tallies);
    const int rows = static_cast<int>(lines.size());
    const int height = headHeight + rows * rowHeight + footHeight;
    return fmt::format("set terminal svg size {},{} dynamic font 'sans-serif,{}' background rgb "
                       "'white'\n",
                       pageWidth, height, fontSize) +
           style + frame(height, labelWidth(lines)) +
           fmt::format("set yrange [{}:-0.5]\n", rows - 0.5) + heading(findings) + labels(lines) +
           data(lines, "different", true) + data(lines, "other", false) +
           fmt::format("plot $different using 1:4:2:3 with xerrorbars linewidth 2 pointtype 7 "
                       "pointsize 1.2 linecolor rgb '{}' title 'exact p < .05, uncorrected', "
                       "$other using 1:4:2:3 with xerrorbars linewidth 2 pointtype 6 pointsize 1.2 "
                       "linecolor rgb '{}' title 'not'\n",
                       blue, grey);
}

std::string chartSvg(const Findings& findings) {
    return gnuplotSvg(chartScript(findings), "Share of votes for b, per condition");
}

} // namespace obscura
