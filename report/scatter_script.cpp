#include "report/gnuplot.h"
#include "report/marks.h"
#include "report/paper_figure.h"
#include "report/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace obscura {

namespace {

using fmt::format;

constexpr const char* frame = R"(set bars 0
set lmargin at screen 0.085
set rmargin at screen 0.64
set tmargin at screen 0.97
set bmargin at screen 0.12
)";

std::string timeTitle(const Scatter& scatter) {
    return format("milliseconds (what is free stands at the left edge{})",
                  scatter.uncertainty > 0
                      ? format("; dotted: the front, times ±{:.1f} %", 100 * scatter.uncertainty)
                      : "");
}

// From above the first point of the front to the right border; what takes more time than `free`
// moved by `factor`.
std::string staircase(const Scatter& scatter, double top, double right, double free,
                      double factor) {
    std::string lines;
    for (const std::size_t i : scatter.front) {
        const ScatterPoint& point = scatter.points[i];
        const double time = point.milliseconds * (point.milliseconds > free ? factor : 1);
        if (time > right)
            break;
        if (lines.empty())
            lines = format("{} {}\n", time, top);
        lines += format("{} {}\n", time, point.error);
    }
    return lines + format("{} {}\n", right, scatter.points[scatter.front.back()].error);
}

// Series in two columns, then the front's points, in the margin at the right, and how uncertain
// times are.
std::string key(const Scatter& scatter, const std::vector<std::string>& seriesNames,
                const std::map<std::size_t, std::string>& series) {
    constexpr double left = 0.665, top = 0.965, line = 0.036;
    const std::size_t rows = (series.size() + 1) / 2;
    std::string script;
    std::size_t i = 0;
    for (const auto& [index, data] : series) {
        script +=
            format("set label {} at screen {:.4f}, {:.4f} point {} offset char 1, 0 font ',7'\n",
                   gnuplotText(seriesNames[index]), left + (i < rows ? 0 : 0.165),
                   top - line * static_cast<double>(i % rows), plot::pointStyle(index));
        ++i;
    }
    for (std::size_t k = 0; k < scatter.front.size(); ++k)
        script +=
            format("set label {} at screen {:.4f}, {:.4f} font ',6.5'\n",
                   gnuplotText(format("{}  {}", k + 1, scatter.points[scatter.front[k]].name)),
                   left - 0.008, top - line * static_cast<double>(rows + k) - 0.02);
    return script;
}

std::string frontNumbers(const Scatter& scatter, const Axis& across, const Axis& up) {
    constexpr double width = 493, height = 461; // of the plot, in twelfths of a number's height
    std::vector<Spot> spots;
    for (const std::size_t i : scatter.front)
        spots.push_back({width * across.at(scatter.points[i].milliseconds),
                         height * (1 - up.at(scatter.points[i].error))});
    const auto places = numberPlaces(spots, 0, height);
    std::string script;
    const auto at = [&](double x, double y) {
        return format("graph {:.4f}, {:.4f}", x / width, 1 - y / height);
    };
    for (std::size_t k = 0; k < spots.size(); ++k) {
        if (!places[k])
            continue;
        script += format("set label '{}' at {} center font ',6.5' front\n", k + 1,
                         at(places[k]->x, places[k]->y - 4));
        if (places[k]->far)
            script +=
                format("set arrow from {} to {} nohead linewidth 0.5 linecolor rgb '#999999'\n",
                       at(spots[k].x, spots[k].y), at(places[k]->x + 3, places[k]->y - 10));
    }
    return script;
}

// A line through a series' points, their percentiles and their marks.
std::string seriesPlot(std::size_t index) {
    const std::string colour = format("linecolor rgb '{}'", markOf(index).colour);
    return plot::list(
        {format("$t{} using 1:2 with lines linewidth 0.5 {} notitle", index, colour),
         format("$t{} using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 {} "
                "notitle",
                index, colour),
         format("$t{} using 1:2 with points {} notitle", index, plot::pointStyle(index))});
}

// What takes no time has no logarithm and stands at the left edge, at half of the least time above
// 0. Where nothing took any time, `low` is infinity.
double freeTime(const Scatter& scatter) {
    double least = std::numeric_limits<double>::infinity();
    for (const ScatterPoint& point : scatter.points)
        if (point.low > 0)
            least = std::min(least, point.low);
    return least / 2;
}

Scatter withoutZeros(Scatter scatter, double free) {
    for (ScatterPoint& point : scatter.points)
        for (double* time : {&point.milliseconds, &point.low, &point.high})
            if (*time == 0)
                *time = free;
    return scatter;
}

} // namespace

std::string scatterScript(const Scatter& measured, const std::vector<std::string>& seriesNames) {
    const double free = freeTime(measured);
    const Scatter scatter = withoutZeros(measured, free);
    std::vector<double> milliseconds, errors;
    std::map<std::size_t, std::string> series;
    for (const ScatterPoint& point : scatter.points) {
        if (std::isnan(point.milliseconds) || std::isnan(point.error))
            continue;
        milliseconds.insert(milliseconds.end(), {point.low, point.milliseconds, point.high});
        errors.push_back(point.error);
        series[point.series] +=
            format("{} {} {} {}\n", point.milliseconds, point.error, point.low, point.high);
    }
    if (series.empty() || std::isinf(free))
        return {};
    const Axis across = logarithmicAxis(milliseconds), up = linearAxis(errors);
    std::vector<std::string> elements{
        "$front using 1:2 with steps linewidth 1.5 linecolor rgb '#333333' notitle"};
    std::string data = plot::block("front", staircase(scatter, up.high, across.high, free, 1));
    if (scatter.uncertainty > 0) {
        data += plot::block("unsure", staircase(scatter, up.high, across.high, free,
                                                std::pow(1 + scatter.uncertainty, 2)));
        elements.push_back("$unsure using 1:2 with steps linewidth 0.8 dashtype 3 linecolor rgb "
                           "'#666666' notitle");
    }
    for (const auto& [index, lines] : series) {
        data += plot::block(format("t{}", index), lines);
        elements.push_back(seriesPlot(index));
    }
    return plot::style + plot::ticks("x", across) + plot::ticks("y", up) + frame +
           format("set xlabel {}\nset ylabel {}\n", gnuplotText(timeTitle(scatter)),
                  gnuplotText(scatter.error)) +
           key(scatter, seriesNames, series) + frontNumbers(scatter, across, up) + data + "plot " +
           plot::list(elements) + "\n";
}

} // namespace obscura
