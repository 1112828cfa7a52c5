#include "bench/choose/figure.h"

#include "bench/choose/words.h"
#include "bench/sweep/pareto.h"
#include "renderer/found_cameras.h"
#include "report/gnuplot.h"
#include "report/lettering.h"
#include "report/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace obscura {

namespace {

using fmt::format;

constexpr double width = 7.2, rowHeight = 0.18, glanceHeight = 2.1; // inches
constexpr double lineHeight = 0.15, axisHeight = 0.5, gap = 0.45;
constexpr const char *green = "#009E73", *blue = "#0072B2", *orange = "#D55E00", *grey = "#888888";
constexpr std::size_t mostRows = 16, mostBeforeChosen = 10;
constexpr std::size_t lettersInLine = 122, lettersInName = 36;

// One of the columns of numbers: milliseconds, or a measure.
struct Column {
    const Measure* measure = nullptr; // nullptr: milliseconds
    std::optional<double> limit;
};

std::vector<Column> columnsOf(const Budget& budget) {
    std::vector<Column> columns = {{nullptr, budget.milliseconds}};
    for (const Measure& measure : measures())
        if (budget.*measure.limit || budget.best == &measure)
            columns.push_back({&measure, budget.*measure.limit});
    if (columns.size() == 1)
        columns.push_back({&measureNamed("rmse"), {}});
    return columns;
}

// A number with the end of its interval that decides.
struct Interval {
    double mean = 0, bound = 0;
};

Interval intervalOf(const Column& column, const Candidate& candidate) {
    if (!column.measure) {
        double dearest = 0;
        for (const ViewResult& view : candidate.views)
            dearest = std::max(dearest, view.milliseconds);
        return {candidate.milliseconds, std::max(dearest, candidate.milliseconds)};
    }
    std::vector<double> distances;
    for (const ViewResult& view : candidate.views)
        distances.push_back(column.measure->distance(view.*column.measure->value));
    const double bound = upperBound(distances);
    return {meanOf(candidate.views, column.measure->value),
            column.measure->moreIsBetter() ? column.measure->perfect - bound : bound};
}

// The measured candidates from the top: the order in which the answer is found by going down.
std::vector<const Candidate*> rowsOf(const Budget& budget, const Choice& choice) {
    if (!choice.chosen)
        return nearestFirst(budget, choice);
    std::vector<const Candidate*> rows;
    for (const Candidate& candidate : choice.candidates)
        if (candidate.rung != Rung::glance)
            rows.push_back(&candidate);
    if (budget.best)
        std::stable_sort(rows.begin(), rows.end(), [&](const Candidate* a, const Candidate* b) {
            return worth(budget, *a) < worth(budget, *b);
        });
    return rows;
}

// Those of them that are drawn: some before the chosen one, and those that follow.
std::vector<const Candidate*> drawnOf(const std::vector<const Candidate*>& rows) {
    const auto chosen = std::find_if(rows.begin(), rows.end(), [](const Candidate* candidate) {
        return candidate->rung == Rung::chosen;
    });
    const auto before = chosen == rows.end() ? 0 : chosen - rows.begin();
    const auto first =
        rows.begin() + std::max<std::ptrdiff_t>(0, before - std::ptrdiff_t(mostBeforeChosen));
    return {first, first + std::min(std::ptrdiff_t(mostRows), rows.end() - first)};
}

const char* colourOf(const Candidate& candidate) {
    return candidate.rung == Rung::chosen ? green : candidate.verdict.empty() ? blue : orange;
}

// Where the parts of the figure are, in shares of its height from below.
struct Layout {
    std::vector<std::string> head;
    double height = 0;
    double top = 0, rowsLow = 0, glanceTop = 0, glanceLow = 0; // of the plots themselves

    Layout(const Headline& headline, std::size_t rows) {
        head = wrapped(headline.answer, lettersInLine * 8 / 10);
        boldLines = head.size();
        for (const std::string& line : wrapped(headline.reason, lettersInLine))
            head.push_back(line);
        const double headHeight = 0.12 + lineHeight * static_cast<double>(head.size()) + 0.3,
                     rowsHeight = rowHeight * static_cast<double>(std::max<std::size_t>(rows, 1));
        height = headHeight + rowsHeight + axisHeight + gap + glanceHeight + axisHeight;
        top = 1 - headHeight / height;
        rowsLow = top - rowsHeight / height;
        glanceTop = rowsLow - (axisHeight + gap) / height;
        glanceLow = axisHeight / height;
    }
    std::size_t boldLines = 0;
};

std::string margins(double left, double right, double low, double high) {
    return format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
                  "set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n",
                  left, right, low, high);
}

std::string headScript(const Layout& layout) {
    std::string script;
    for (std::size_t i = 0; i < layout.head.size(); ++i)
        script +=
            format("set label {} {} at screen 0.012, screen {:.4f} left font ',{}'\n", i + 1,
                   i < layout.boldLines ? gnuplotBold(layout.head[i]) : gnuplotText(layout.head[i]),
                   1 - (0.14 + lineHeight * static_cast<double>(i)) / layout.height,
                   i < layout.boldLines ? 9.5 : 8);
    return script;
}

// The rows' names and numbers, left of the first column, and their lines in the others.
std::string namesScript(const std::vector<const Candidate*>& rows, bool named) {
    std::string ticks;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string name =
            named ? format("{}  {}", shortened(nameOf(*rows[i]), lettersInName), i + 1) : "";
        ticks +=
            format("{}{} {}", i ? ", " : "",
                   rows[i]->rung == Rung::chosen ? gnuplotBold(name) : gnuplotText(name), i + 1);
    }
    return "set ytics (" + ticks + ") scale 0 nomirror font ',7'\n";
}

std::string fatesScript(const Budget& budget, const Choice& choice,
                        const std::vector<const Candidate*>& rows) {
    std::string script;
    for (std::size_t i = 0; i < rows.size(); ++i)
        script +=
            format("set label {} {} at graph 1.04, first {} left font ',7.5' tc rgb '{}'\n", i + 1,
                   gnuplotText(fateOf(budget, choice, *rows[i])), i + 1, colourOf(*rows[i]));
    return script;
}

// Ticks some fourth of the range apart, at 1, 2 or 5 times a power of ten.
double tickStep(double range) { return roundRadius(range / 4); }

// Of times above 0; what takes none has no logarithm and stands at the left edge.
Axis timeAxis(std::vector<double> times) {
    std::erase_if(times, [](double time) { return !(time > 0); });
    if (times.empty())
        times = {1};
    const auto [low, high] = std::minmax_element(times.begin(), times.end());
    times.insert(times.end(), {*low / 1.5, *high * 1.2});
    return logarithmicAxis(times);
}

Axis timeAxis(const Column& column, const std::vector<Interval>& intervals) {
    std::vector<double> times = {column.limit.value_or(0)};
    for (const Interval& each : intervals)
        times.insert(times.end(), {each.mean, each.bound});
    return timeAxis(std::move(times));
}

// From the truth's value to what holds all means, the limit and most bounds.
std::string rangeOf(const Column& column, const std::vector<Interval>& intervals) {
    if (!column.measure)
        return plot::ticks("x", timeAxis(column, intervals));
    double far = column.limit ? column.measure->distance(*column.limit) * 1.15 : 0;
    for (const Interval& each : intervals) {
        const double mean = column.measure->distance(each.mean),
                     bound = column.measure->distance(each.bound);
        far = std::max({far, 1.15 * mean, std::min(1.05 * bound, 2 * mean)});
    }
    far = std::max(far, 1e-3);
    const double perfect = column.measure->perfect;
    return format("unset logscale x\nset xtics {}\nset xrange [{}:{}]\n", tickStep(far),
                  column.measure->moreIsBetter() ? perfect - far : 0,
                  column.measure->moreIsBetter() ? perfect : far);
}

std::string limitScript(const Column& column) {
    if (!column.limit)
        return "";
    return format(
        "set arrow 1 from first {0}, graph 0 to first {0}, graph 1 nohead dashtype 2 "
        "lw 1.5 lc rgb '{1}'\nset label 100 {2} at first {0}, graph 1 center offset 0, "
        "0.6 font ',7.5' tc rgb '{1}'\n",
        *column.limit, orange,
        gnuplotText(format("limit {:.4g}{}", *column.limit, column.measure ? "" : " ms")));
}

std::string titleOf(const Column& column) {
    if (!column.measure)
        return "milliseconds; whisker: 95 of 100 frames";
    return format("{}; whisker: {:.3g} % bound", column.measure->spelt, 100 * boundLevel);
}

std::string columnScript(const Column& column, const std::vector<const Candidate*>& rows) {
    std::vector<Interval> intervals;
    for (const Candidate* candidate : rows)
        intervals.push_back(intervalOf(column, *candidate));
    std::string script = rangeOf(column, intervals) + limitScript(column), plots, data;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i]->rung == Rung::chosen)
            script += format("set object 1 rectangle from graph 0, first {} to graph 1, first {} "
                             "behind fillcolor rgb '#e3f3ed' fillstyle solid noborder\n",
                             static_cast<double>(i) + 0.55, static_cast<double>(i) + 1.45);
    const double free = timeAxis(column, intervals).low;
    for (const char* colour : {orange, blue, green}) {
        std::string lines;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            Interval each = intervals[i];
            if (colourOf(*rows[i]) != colour || std::isnan(each.mean))
                continue;
            if (!column.measure)
                each = {std::max(each.mean, free), std::max(each.bound, free)};
            if (!std::isfinite(each.bound))
                each.bound = each.mean;
            lines += format("{} {} {} {}\n", each.mean, i + 1, std::min(each.mean, each.bound),
                            std::max(each.mean, each.bound));
        }
        if (lines.empty())
            continue;
        plots += format("{} '-' using 1:2:3:4 with xerrorbars pt 7 ps {} lw {} lc rgb '{}' notitle",
                        plots.empty() ? "plot" : ",", colour == green ? 0.75 : 0.5,
                        colour == green ? 2 : 1.2, colour);
        data += lines + "e\n";
    }
    return script +
           format("set xlabel {} font ',7.5' offset 0, 0.4\n", gnuplotText(titleOf(column))) +
           plots + "\n" + data;
}

std::string rowsScript(const Budget& budget, const Choice& choice,
                       const std::vector<const Candidate*>& rows, const Layout& layout) {
    const std::vector<Column> columns = columnsOf(budget);
    const double left = 0.31, right = 0.86, between = 0.03,
                 each = (right - left + between) / static_cast<double>(columns.size());
    std::string script = format("set yrange [{}:0.4]\nset grid xtics ytics lc rgb '#e4e4e4'\n",
                                static_cast<double>(rows.size()) + 0.6);
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const double from = left + each * static_cast<double>(c);
        script += margins(from, from + each - between, layout.rowsLow, layout.top);
        script += namesScript(rows, c == 0);
        if (c + 1 == columns.size())
            script += fatesScript(budget, choice, rows);
        script += columnScript(columns[c], rows) + "unset label\nunset arrow\nunset object\n";
    }
    return script;
}

std::string restScript(std::size_t rest, const Layout& layout) {
    return rest == 0
               ? ""
               : format("set label 300 {} at screen 0.012, screen {:.4f} left font ',7' tc rgb "
                        "'{}'\n",
                        gnuplotText(format("{} more in choice.csv", rest)),
                        layout.rowsLow - 0.25 / layout.height, grey);
}

struct GlanceFrame {
    Axis times;
    double top = 0; // RMSE
    // In units of numberPlaces(), of which a number is 12 high.
    static constexpr double across = 560, up = 190;

    double milliseconds(const Candidate& candidate) const {
        return std::max(candidate.glanceMilliseconds, times.low);
    }
    Spot spot(const Candidate& candidate) const {
        return {across * times.at(milliseconds(candidate)), up * (1 - candidate.glanceRmse / top)};
    }
};

GlanceFrame glanceFrameOf(const Budget& budget, const Choice& choice) {
    std::vector<double> times = {glanceFactor * budget.milliseconds.value_or(0)};
    double top = budget.rmse ? farOver(*budget.rmse) : 0.01;
    for (const Candidate& candidate : choice.candidates) {
        times.push_back(candidate.glanceMilliseconds);
        top = std::max(top, candidate.glanceRmse);
    }
    return {timeAxis(std::move(times)), top * 1.08};
}

// Whether a number there would cover a point.
bool covers(const NumberPlace& place, const Choice& choice, const GlanceFrame& frame) {
    return std::any_of(
        choice.candidates.begin(), choice.candidates.end(), [&](const Candidate& candidate) {
            const Spot spot = frame.spot(candidate);
            return std::abs(spot.x - place.x) < 9 && std::abs(spot.y - (place.y - 4)) < 8;
        });
}

// The numbers of the rows beside the points, where there is room; the chosen one's first.
std::string numbersScript(const Choice& choice, const std::vector<const Candidate*>& rows,
                          const GlanceFrame& frame) {
    std::vector<std::size_t> order(rows.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return rows[i]->rung == Rung::chosen; });
    std::vector<Spot> spots;
    for (const std::size_t i : order)
        spots.push_back(frame.spot(*rows[i]));
    const auto places = numberPlaces(spots, 0, GlanceFrame::up);
    std::string script;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Candidate& candidate = *rows[order[k]];
        if (!places[k] || (candidate.rung != Rung::chosen &&
                           (places[k]->far || covers(*places[k], choice, frame))))
            continue;
        const std::string number = std::to_string(order[k] + 1);
        script += format("set label {} {} at graph {:.4f}, graph {:.4f} center font ',7' tc rgb "
                         "'{}'\n",
                         k + 1,
                         candidate.rung == Rung::chosen ? gnuplotBold(number) : gnuplotText(number),
                         places[k]->x / GlanceFrame::across,
                         1 - (places[k]->y - 4) / GlanceFrame::up, colourOf(candidate));
    }
    return script;
}

std::string pointsOf(const Choice& choice, const GlanceFrame& frame, const char* colour) {
    std::string lines;
    for (const Candidate& candidate : choice.candidates)
        if ((candidate.rung == Rung::glance ? grey : colourOf(candidate)) == colour)
            lines += format("{} {}\n", frame.milliseconds(candidate), candidate.glanceRmse);
    return lines;
}

std::string frontOf(const Choice& choice, const GlanceFrame& frame) {
    std::vector<ParetoPoint> points;
    for (const Candidate& candidate : choice.candidates)
        points.push_back({frame.milliseconds(candidate), candidate.glanceRmse, ""});
    std::string lines;
    for (const std::size_t i : paretoFront(points))
        lines += format("{} {}\n", points[i].milliseconds, points[i].error);
    return lines;
}

// What is beyond these lines was left out.
std::string farOverScript(const Budget& budget) {
    std::string script;
    if (budget.rmse)
        script += format("set arrow 1 from graph 0, first {0} to graph 1, first {0} nohead "
                         "dashtype 3 lc rgb '{1}'\nset label 201 {2} at graph 0.995, first {0} "
                         "right offset 0, 0.5 font ',7.5' tc rgb '{1}'\n",
                         farOver(*budget.rmse), orange,
                         gnuplotText(format("far over the limit of {:.4g}", *budget.rmse)));
    if (budget.milliseconds)
        script += format("set arrow 2 from first {0}, graph 0 to first {0}, graph 1 nohead "
                         "dashtype 3 lc rgb '{1}'\nset label 202 {2} at first {0}, graph 0.04 left "
                         "offset 0.5, 0 font ',7.5' tc rgb '{1}'\n",
                         glanceFactor * *budget.milliseconds, orange,
                         gnuplotText(format("far over {:g} ms", *budget.milliseconds)));
    return script;
}

std::string glanceScript(const Budget& budget, const Choice& choice,
                         const std::vector<const Candidate*>& rows, const Layout& layout) {
    const GlanceFrame frame = glanceFrameOf(budget, choice);
    std::string script =
        margins(0.08, 0.86, layout.glanceLow, layout.glanceTop) + plot::ticks("x", frame.times) +
        format("set yrange [0:{}]\nunset ytics\nset ytics {} nomirror out scale 1 font ',7.5'\n"
               "set xlabel {} font ',7.5' offset 0, 0.4\nset ylabel {} font ',7.5' offset 1.5\n"
               "set label 200 {} at graph 0, graph 1 left offset 0, 0.7\n",
               frame.top, tickStep(frame.top),
               gnuplotText("milliseconds, the fastest of a few frames (logarithmic; free ones at "
                           "the left edge)"),
               gnuplotText("RMSE"),
               gnuplotBold("All candidates at a glance: fitted on one small training view, seen on "
                           "all of them")) +
        numbersScript(choice, rows, frame) +
        format("set key at screen 0.865, screen {} left top samplen 0.3 font ',7.5'\n",
               layout.glanceTop) +
        farOverScript(budget);
    std::string plots = "plot '-' using 1:2 with steps lc rgb '#bbbbbb' notitle",
                data = frontOf(choice, frame) + "e\n";
    const std::pair<const char*, const char*> series[] = {
        {grey, "left out"}, {orange, "measured, fails"}, {blue, "would do"}, {green, "chosen"}};
    for (const auto& [colour, title] : series)
        if (const std::string lines = pointsOf(choice, frame, colour); !lines.empty()) {
            plots += format(", '-' using 1:2 with points pt {} ps {} lc rgb '{}' title {}",
                            colour == grey ? 6 : 7, colour == green ? 0.8 : 0.5, colour,
                            gnuplotText(title));
            data += lines + "e\n";
        }
    return script + plots + "\n" + data;
}

} // namespace

Figure choiceFigure(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    const std::vector<const Candidate*> all = rowsOf(budget, choice), rows = drawnOf(all);
    const Headline headline = headlineOf(study, budget, choice);
    const Layout layout(headline, rows.size());
    Figure figure{"choice", headline.answer, plot::style, width, layout.height};
    figure.script +=
        "set multiplot\nset xtics nomirror out font ',7.5'\nunset key\n" + headScript(layout);
    if (!rows.empty())
        figure.script +=
            rowsScript(budget, choice, rows, layout) + restScript(all.size() - rows.size(), layout);
    figure.script += glanceScript(budget, choice, rows, layout) + "unset multiplot\n";
    return figure;
}

} // namespace obscura
