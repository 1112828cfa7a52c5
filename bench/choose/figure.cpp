#include "bench/choose/figure.h"

#include "bench/choose/words.h"
#include "bench/sweep/pareto.h"
#include "report/gnuplot.h"
#include "report/lettering.h"
#include "report/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

using fmt::format;

constexpr double width = 7.2, rowHeight = 0.18, glanceHeight = 2.1; // inches
constexpr double lineHeight = 0.15, axisHeight = 0.5, gap = 0.45;
constexpr const char *green = "#009E73", *blue = "#0072B2", *orange = "#D55E00", *grey = "#888888";
constexpr std::size_t lettersInLine = 118;

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

// Least milliseconds of the axes: what takes none has no logarithm and stands at their left edge.
double leastOf(const Choice& choice) {
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : choice.candidates)
        for (const double time : {candidate.glanceMilliseconds, candidate.milliseconds})
            if (time > 0)
                least = std::min(least, time);
    return std::isfinite(least) ? least / 2 : 0.1;
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
            return budget.best->distance(meanOf(a->views, budget.best->value)) <
                   budget.best->distance(meanOf(b->views, budget.best->value));
        });
    return rows;
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

// The rows' own names at the left and fates at the right, by the ticks of the outer columns.
std::string namesScript(const std::vector<const Candidate*>& rows) {
    std::string ticks;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string name = format("{}  {}", shortened(nameOf(*rows[i]), 34), i + 1);
        ticks +=
            format("{}{} {}", i ? ", " : "",
                   rows[i]->rung == Rung::chosen ? gnuplotBold(name) : gnuplotText(name), i + 1);
    }
    return "set ytics (" + ticks + ") scale 0 nomirror\n";
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

// From the truth's value, or the left edge, to what holds all means, limits and most bounds.
std::string rangeOf(const Column& column, const std::vector<Interval>& intervals, double least) {
    if (!column.measure)
        return format("set logscale x\nset xrange [{}:*]\n", least * 0.9);
    double far = column.limit ? column.measure->distance(*column.limit) * 1.15 : 0;
    for (const Interval& each : intervals) {
        const double mean = column.measure->distance(each.mean),
                     bound = column.measure->distance(each.bound);
        far = std::max({far, 1.15 * mean, std::min(1.05 * bound, 2 * mean)});
    }
    return column.measure->moreIsBetter()
               ? format("unset logscale x\nset xrange [{}:{}]\n", column.measure->perfect - far,
                        column.measure->perfect)
               : format("unset logscale x\nset xrange [0:{}]\n", far);
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
        return "milliseconds: mean of views, and 95 of 100 frames";
    return format("{}: mean, and {:.3g} % bound", column.measure->spelt, 100 * boundLevel);
}

std::string columnScript(const Column& column, const std::vector<const Candidate*>& rows,
                         double least) {
    std::vector<Interval> intervals;
    for (const Candidate* candidate : rows)
        intervals.push_back(intervalOf(column, *candidate));
    std::string script = rangeOf(column, intervals, least) + limitScript(column), plots, data;
    for (const char* colour : {orange, blue, green}) {
        std::string lines;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            Interval each = intervals[i];
            if (colourOf(*rows[i]) != colour || std::isnan(each.mean))
                continue;
            if (!column.measure)
                each = {std::max(each.mean, least), std::max(each.bound, least)};
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
    const double left = 0.29, right = 0.865, between = 0.035,
                 each = (right - left + between) / static_cast<double>(columns.size());
    std::string script = format("set yrange [{}:0.4]\nset grid xtics ytics lc rgb '#e4e4e4'\n",
                                static_cast<double>(rows.size()) + 0.6) +
                         namesScript(rows);
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const double from = left + each * static_cast<double>(c);
        script += margins(from, from + each - between, layout.rowsLow, layout.top);
        if (c + 1 == columns.size())
            script += fatesScript(budget, choice, rows);
        script += columnScript(columns[c], rows, leastOf(choice)) +
                  "unset label\nunset arrow\nset ytics format '' \n";
    }
    return script;
}

struct GlanceFrame {
    double low = 0, high = 0, top = 0; // milliseconds at the edges; RMSE at the top
    // In units of numberPlaces(), of which a number is 12 high.
    static constexpr double across = 560, up = 190;

    Spot spot(const Candidate& candidate) const {
        return {across * std::log(std::max(candidate.glanceMilliseconds, low) / low) /
                    std::log(high / low),
                up * (1 - candidate.glanceRmse / top)};
    }
};

GlanceFrame glanceFrameOf(const Budget& budget, const Choice& choice) {
    GlanceFrame frame{leastOf(choice) * 0.9, 0, 0};
    for (const Candidate& candidate : choice.candidates) {
        frame.high = std::max(frame.high, candidate.glanceMilliseconds * 1.3);
        frame.top = std::max(frame.top, candidate.glanceRmse * 1.08);
    }
    frame.high = std::max(frame.high, frame.low * 10);
    frame.top = std::max({frame.top, budget.rmse.value_or(0) * 1.08, 0.01});
    return frame;
}

// The numbers of the rows beside the points.
std::string numbersScript(const std::vector<const Candidate*>& rows, const GlanceFrame& frame) {
    std::vector<std::size_t> order(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return frame.spot(*rows[a]).x < frame.spot(*rows[b]).x;
    });
    std::vector<Spot> spots;
    for (const std::size_t i : order)
        spots.push_back(frame.spot(*rows[i]));
    const auto places = numberPlaces(spots, 0, GlanceFrame::up);
    std::string script;
    for (std::size_t k = 0; k < order.size(); ++k)
        if (places[k]) {
            const double x = places[k]->x / GlanceFrame::across,
                         y = 1 - (places[k]->y - 4) / GlanceFrame::up;
            const Candidate& candidate = *rows[order[k]];
            const std::string number = std::to_string(order[k] + 1);
            script += format(
                "set label {} {} at graph {:.4f}, graph {:.4f} center font ',7' tc "
                "rgb '{}'\n",
                k + 1, candidate.rung == Rung::chosen ? gnuplotBold(number) : gnuplotText(number),
                x, y, colourOf(candidate));
            if (places[k]->far)
                script += format("set arrow {} from graph {:.4f}, graph {:.4f} to graph {:.4f}, "
                                 "graph {:.4f} nohead lw 0.5 lc rgb '#aaaaaa'\n",
                                 k + 10, x, y + 0.02, spots[k].x / GlanceFrame::across,
                                 1 - spots[k].y / GlanceFrame::up);
        }
    return script;
}

std::string pointsOf(const Choice& choice, double least, const char* colour) {
    std::string lines;
    for (const Candidate& candidate : choice.candidates)
        if ((candidate.rung == Rung::glance ? grey : colourOf(candidate)) == colour)
            lines += format("{} {}\n", std::max(candidate.glanceMilliseconds, least),
                            candidate.glanceRmse);
    return lines;
}

std::string frontOf(const Choice& choice, double least) {
    std::vector<ParetoPoint> points;
    for (const Candidate& candidate : choice.candidates)
        points.push_back({std::max(candidate.glanceMilliseconds, least), candidate.glanceRmse, ""});
    std::string lines;
    for (const std::size_t i : paretoFront(points))
        lines += format("{} {}\n", points[i].milliseconds, points[i].error);
    return lines;
}

std::string glanceScript(const Budget& budget, const Choice& choice,
                         const std::vector<const Candidate*>& rows, const Layout& layout) {
    const GlanceFrame frame = glanceFrameOf(budget, choice);
    const double least = leastOf(choice);
    std::string script =
        margins(0.09, 0.865, layout.glanceLow, layout.glanceTop) +
        format("set logscale x\nset xrange [{}:{}]\nset yrange [0:{}]\nset ytics autofreq format "
               "'%g' scale 1\nset xlabel {} font ',7.5' offset 0, 0.4\nset ylabel {} font ',7.5' "
               "offset 1.5\nset label 200 {} at graph 0, graph 1 left offset 0, 0.7\n",
               frame.low, frame.high, frame.top,
               gnuplotText("milliseconds, median of a few frames (logarithmic; free ones at the "
                           "left edge)"),
               gnuplotText("RMSE"),
               gnuplotBold("All candidates at a glance: fitted on one small training view, seen on "
                           "another")) +
        numbersScript(rows, frame) + "set key outside right top samplen 1 font ',7.5' width -4\n";
    if (budget.rmse)
        script += format("set arrow 1 from graph 0, first {0} to graph 1, first {0} nohead "
                         "dashtype 2 lw 1.5 lc rgb '{1}'\nset label 201 {2} at graph 0.995, first "
                         "{0} right offset 0, 0.5 font ',7.5' tc rgb '{1}'\n",
                         *budget.rmse, orange, gnuplotText(format("limit {:.4g}", *budget.rmse)));
    std::string plots = "plot '-' using 1:2 with steps lc rgb '#bbbbbb' notitle",
                data = frontOf(choice, least) + "e\n";
    const std::pair<const char*, const char*> series[] = {{grey, "left out"},
                                                          {orange, "measured, failed"},
                                                          {blue, "measured, would do"},
                                                          {green, "chosen"}};
    for (const auto& [colour, title] : series)
        if (const std::string lines = pointsOf(choice, least, colour); !lines.empty()) {
            plots += format(", '-' using 1:2 with points pt {} ps {} lc rgb '{}' title {}",
                            colour == grey ? 6 : 7, colour == green ? 0.8 : 0.5, colour,
                            gnuplotText(title));
            data += lines + "e\n";
        }
    return script + plots + "\n" + data;
}

} // namespace

Figure choiceFigure(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    const std::vector<const Candidate*> rows = rowsOf(budget, choice);
    const Headline headline = headlineOf(study, budget, choice);
    const Layout layout(headline, rows.size());
    Figure figure{"choice", headline.answer, plot::style, width, layout.height};
    figure.script +=
        "set multiplot\nset xtics nomirror out font ',7.5'\nunset key\n" + headScript(layout);
    if (!rows.empty())
        figure.script += rowsScript(budget, choice, rows, layout);
    else
        figure.script += "";
    figure.script += glanceScript(budget, choice, rows, layout) + "unset multiplot\n";
    return figure;
}

} // namespace obscura
