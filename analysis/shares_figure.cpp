#include "analysis/figures.h"
#include "analysis/verdict.h"
#include "report/gnuplot.h"
#include "report/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace obscura {

namespace {

// For each condition, grouped by complexity level, the share of b with the interval of its
// test, the even split marked, and the counts beside it. Lengths are pixels of the page, in which
// the type is 13 high.
constexpr double glyphWidth = 7.3; // of the sans-serif faces browsers use, on average
constexpr double lineHeight = 19, rowHeight = 29, countsWidth = 84, footHeight = 70, edge = 6;
constexpr std::size_t mostConditions = 24; // of one picture: more do not fit a printed page

// How a verdict looks: what colour says is also said by the mark.
struct Look {
    const char *name, *key, *colour;
    int mark;
    bool open = false; // a mark with a white inside, through which the interval does not run
};
constexpr std::array<Look, 4> looks = {{
    // in the order of Verdict::Outcome
    {"differs", "differs: p < .05 after Holm", "#0072B2", 7},
    {"equivalent", "as good as even: equivalence p < .05", "#00805B", 5},
    {"undecided", "undecided", "#555555", 6, true},
    {"unusable", "not to be used", "#B33A00", 2},
}};
std::size_t lookOf(const Verdict& verdict) { return static_cast<std::size_t>(verdict.outcome); }

constexpr const char *gridLine = "linewidth 0.5 linecolor rgb '#BBBBBB'",
                     *evenSplit = "linewidth 1.5 dashtype 2 linecolor rgb '#333333'";

double widthOf(const std::string& text) { return glyphWidth * static_cast<double>(letters(text)); }

std::string fitted(const std::string& text, double width) {
    return shortened(text, static_cast<std::size_t>(width / glyphWidth));
}

std::string pairText(const Tally& tally) {
    return fmt::format("{} / {}", tally.techniqueA, tally.techniqueB);
}

std::string labelOf(const Tally& tally) {
    return tally.scene.empty() ? pairText(tally)
                               : fmt::format("{}: {}", tally.scene, pairText(tally));
}

struct Chart {
    std::span<const Tally> tallies;
    std::span<const std::optional<Verdict>> verdicts;
    double width = 0, height = 0;
    double left = 0, right = 0;                    // of the plot
    double head = 0;                               // what stands above the plot
    std::string labels{};                          // as a script
    std::array<std::string, looks.size()> marks{}; // of each look, rows "share low high y"
};

// A text whose place is given from the left and, within the plot, from its top.
std::string label(const Chart& chart, const std::string& quoted, double x, double y,
                  const char* side) {
    return fmt::format("set label {} at screen {:.5f}, first {} {}\n", quoted, x / chart.width, y,
                       side);
}

void mark(Chart& chart, std::size_t i, double y) {
    if (!chart.verdicts[i])
        return;
    const Votes votes = chart.tallies[i].votes;
    const Interval interval = intervalOf(chart.tallies[i]);
    chart.marks[lookOf(*chart.verdicts[i])] += fmt::format(
        "{} {} {} {}\n", 100.0 * static_cast<double>(votes.b) / static_cast<double>(votes.total()),
        100 * interval.low, 100 * interval.high, y);
}

// The scale behind an interval that has text above and below it.
std::string scaleAt(double y) {
    std::string script;
    for (const int share : {0, 25, 50, 75, 100})
        script += fmt::format("set arrow from {0}, {1} to {0}, {2} nohead back {3}\n", share,
                              y - 10, y + 10, share == 50 ? evenSplit : gridLine);
    return script;
}

// The condition's name above its interval, in two lines if it is long; returns the row's height.
double stackedRow(Chart& chart, std::size_t i, double y) {
    const Tally& tally = chart.tallies[i];
    const double room = chart.width - countsWidth + 20 - chart.left;
    std::vector<std::string> lines = {labelOf(tally)};
    if (widthOf(lines[0]) > room && !tally.scene.empty())
        lines = {tally.scene + ":", pairText(tally)};
    chart.labels += label(chart, gnuplotText(fmt::format("{} : {}", tally.votes.a, tally.votes.b)),
                          chart.width - edge, y + lineHeight / 2, "right");
    for (std::size_t line = 0; line < lines.size(); ++line)
        chart.labels += label(
            chart, gnuplotText(fitted(lines[line], line == 0 ? room : chart.right - chart.left)),
            chart.left, y + lineHeight * (0.5 + static_cast<double>(line)), "left");
    const double below = lineHeight * static_cast<double>(lines.size());
    mark(chart, i, y + below + 10);
    chart.labels += scaleAt(y + below + 10);
    return below + rowHeight;
}

double row(Chart& chart, std::size_t i, double y) {
    const Tally& tally = chart.tallies[i];
    const double middle = y + rowHeight / 2;
    chart.labels += label(chart, gnuplotText(labelOf(tally)), 20, middle, "left") +
                    label(chart, gnuplotText(fmt::format("{} : {}", tally.votes.a, tally.votes.b)),
                          chart.width - edge, middle, "right");
    mark(chart, i, middle);
    return rowHeight;
}

// Of the key: entries side by side, as far as there is room, and the heading of the counts below.
struct KeyEntry {
    const Look* look;
    double x = 0, y = 0; // from the top
};

std::vector<KeyEntry> keyOf(const Chart& chart) {
    std::vector<KeyEntry> entries;
    double x = edge, y = edge + lineHeight / 2;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        if (chart.marks[i].empty())
            continue;
        const double width = widthOf(looks[i].key) + 40;
        if (x > edge && x + width > chart.width) {
            x = edge;
            y += lineHeight;
        }
        entries.push_back({&looks[i], x + 6, y});
        x += width;
    }
    return entries;
}

std::string headScript(const Chart& chart, const std::vector<KeyEntry>& key) {
    std::string script = fmt::format(
        "set label 'votes a : b' at screen {:.5f}, screen {:.5f} right\n",
        (chart.width - edge) / chart.width, 1 - (chart.head - lineHeight / 2) / chart.height);
    for (const auto& [look, x, y] : key)
        script +=
            fmt::format("set label '{}' at screen {:.5f}, screen {:.5f} offset char 0.8, -0.2 "
                        "point pointtype {} pointsize 1 linewidth 2 linecolor rgb '{}'\n",
                        look->key, x / chart.width, 1 - y / chart.height, look->mark, look->colour);
    return script;
}

constexpr const char* sharesStyle = R"(set encoding utf8
set border 1 linecolor rgb '#555555'
set xrange [0:100]
set xtics 0, 25, 100 nomirror out format '%.0f %%'
set mxtics 5
unset ytics
unset key
set bars small
)";

// Below the plot; lengths from its lower edge.
std::string footScript(const Chart& chart, double bottom) {
    const auto text = [&](const char* what, double x, double y, const char* side) {
        return label(chart, gnuplotText(what), x, bottom + y, side);
    };
    return text("← more for a", chart.left, 37, "left") +
           text("more for b →", chart.right, 37, "right") +
           text("share of votes for b, 95 % interval", (chart.left + chart.right) / 2, 57,
                "center");
}

std::string plots(const Chart& chart) {
    std::string data;
    std::vector<std::string> elements;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const Look& look = looks[i];
        if (chart.marks[i].empty())
            continue;
        data += plot::block(look.name, chart.marks[i]);
        elements.push_back(fmt::format("${} using 1:4:2:3 with xerrorbars linewidth 2 pointtype 7 "
                                       "pointsize 0.1 linecolor rgb '{}' title '{}'",
                                       look.name, look.colour, look.key));
        if (look.open)
            elements.push_back(fmt::format("${} using 1:4 with points pointtype 7 pointsize 1 "
                                           "linecolor rgb 'white' title ''",
                                           look.name));
        elements.push_back(fmt::format("${} using 1:4 with points pointtype {} pointsize 1 "
                                       "linewidth 2 linecolor rgb '{}' title '{}'",
                                       look.name, look.mark, look.colour, look.key));
    }
    if (elements.empty())
        elements.push_back("NaN title ''");
    return data + "plot " + plot::list(elements) + "\n";
}

Figure draw(const Findings& findings, std::span<const Tally> tallies,
            std::span<const std::optional<Verdict>> verdicts, const std::string& name,
            double inches) {
    Chart chart{tallies, verdicts};
    chart.width = 96 * inches;
    for (const Tally& tally : tallies)
        chart.left = std::max(chart.left, widthOf(labelOf(tally)) + 36);
    const bool stacked = chart.left > 0.45 * chart.width;
    if (stacked)
        chart.left = 14;
    chart.right = stacked ? chart.width - 22 : chart.width - countsWidth - edge;
    double y = 0;
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        if (i == 0 || tallies[i].level != tallies[i - 1].level) {
            chart.labels +=
                label(chart, gnuplotBold(fitted(tallies[i].level, chart.width - 2 * edge)), edge,
                      y + rowHeight / 2, "left");
            y += rowHeight;
        }
        y += stacked ? stackedRow(chart, i, y) : row(chart, i, y);
    }
    const std::vector<KeyEntry> key = keyOf(chart);
    chart.head = (key.empty() ? edge : key.back().y + lineHeight / 2) + lineHeight;
    chart.height = chart.head + y + footHeight;
    const std::string script =
        sharesStyle + headScript(chart, key) +
        fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
                    "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n"
                    "set yrange [{}:0]\n",
                    chart.left / chart.width, chart.right / chart.width,
                    1 - chart.head / chart.height, footHeight / chart.height, y) +
        stampScript(findings, inches, chart.height / 96) + footScript(chart, y) +
        (stacked ? std::string()
                 : fmt::format(
                       "set grid xtics back {}\nset arrow from 50, 0 to 50, {} nohead back {}\n",
                       gridLine, y, evenSplit)) +
        chart.labels + plots(chart);
    return {name, "Share of votes for b, by condition and level", script, inches,
            chart.height / 96};
}

Table numbersOf(std::span<const Tally> tallies, std::span<const std::optional<Verdict>> verdicts) {
    Table table{{{"Level"},
                 {"Condition"},
                 {"Scene"},
                 {"a"},
                 {"b"},
                 {"Votes a", true},
                 {"Votes b", true},
                 {"Share of b", true},
                 {"Low", true},
                 {"High", true},
                 {"p (Holm)", true},
                 {"Drawn as"}},
                {}};
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        const Tally& tally = tallies[i];
        auto& cells = table.rows.emplace_back(std::vector<std::string>{
            tally.level, tally.condition, tally.scene, tally.techniqueA, tally.techniqueB,
            fmt::format("{}", tally.votes.a), fmt::format("{}", tally.votes.b)});
        if (!verdicts[i]) {
            cells.insert(cells.end(), {"–", "–", "–", "–", "no votes"});
            continue;
        }
        const Interval interval = intervalOf(tally);
        for (const double share :
             {static_cast<double>(tally.votes.b) / static_cast<double>(tally.votes.total()),
              interval.low, interval.high})
            cells.push_back(fmt::format("{:.1f} %", 100 * share));
        cells.push_back(fmt::format("{:.3g}", verdicts[i]->holm));
        cells.emplace_back(looks[lookOf(*verdicts[i])].name);
    }
    return table;
}

} // namespace

std::vector<StudyFigure> sharesFigures(const Findings& findings) {
    const auto verdicts = verdictsOf(findings.tallies);
    std::vector<StudyFigure> figures;
    for (std::size_t first = 0; first < verdicts.size(); first += mostConditions) {
        const std::size_t count = std::min(mostConditions, verdicts.size() - first);
        const auto some = std::span(findings.tallies).subspan(first, count);
        const auto theirs = std::span(verdicts).subspan(first, count);
        const std::string name =
            first == 0 ? "shares" : fmt::format("shares-{}", figures.size() + 1);
        figures.push_back(
            {draw(findings, some, theirs, name, wideFigure),
             "Each mark is the share of votes for b of one condition (a / b), its line the 95 % "
             "interval that belongs to the test: of Clopper and Pearson or, where people voted "
             "several times, of the mean of their shares. Filled: the share differs from an even "
             "split after Holm's correction. Open: the data do not decide, which is not to say "
             "that both look equally real. Square: within the margin of an even split. Cross: the "
             "votes cannot be believed, or are too few. The dashed line is the even split of "
             "guessing.",
             numbersOf(some, theirs), draw(findings, some, theirs, name, narrowFigure)});
    }
    return figures;
}

} // namespace obscura
