#include "bench/sweep/figures.h"

#include "base/files.h"
#include "bench/sweep/growth.h"
#include "bench/sweep/summary.h"
#include "report/gnuplot.h"
#include "report/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace obscura {

namespace {

using fmt::format;

// One panel per axis, two beside each other; the names once, at the right.
Figure growthFigure(const Sweep& sweep) {
    const std::vector<Growth> growth = growthOf(sweep.growth);
    const auto techniqueOf = techniquesByConfiguration(sweep);
    const std::vector<std::string> axes = axesOf(growth);
    const std::size_t rows = (axes.size() + 1) / 2;
    std::string data, panels;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        std::vector<double> values, milliseconds;
        std::vector<std::string> elements;
        for (std::size_t i = 0; i < growth.size(); ++i) {
            if (growth[i].axis != axes[a])
                continue;
            std::string lines;
            for (const GrowthRow& row : growth[i].rows) {
                values.push_back(row.value);
                milliseconds.push_back(row.milliseconds);
                lines += format("{} {}\n", row.value, row.milliseconds);
            }
            data += plot::block(format("g{}", i), lines);
            elements.push_back(format("$g{} using 1:2 with linespoints linewidth 1 {} title {}", i,
                                      plot::pointStyle(techniqueOf.at(growth[i].configuration)),
                                      gnuplotText(growth[i].configuration)));
        }
        panels += plot::ticks("x", valueAxis(values)) +
                  plot::ticks("y", logarithmicAxis(milliseconds)) +
                  format("set xlabel {}\n", gnuplotText(axisTitle(axes[a]))) + "plot " +
                  plot::list(elements) + "\nunset key\n";
    }
    return {"growth", "How milliseconds grow",
            plot::style + data +
                format("set ylabel 'milliseconds' offset 1\n"
                       "set key at screen 0.685, screen 0.97 left top font ',7'\n"
                       "set multiplot layout {},2 margins 0.08,0.66,{},0.97 spacing 0.1,{}\n",
                       rows, 0.19 / static_cast<double>(rows), 0.25 / static_cast<double>(rows)) +
                panels + "unset multiplot\n",
            7.2, 2.3 * static_cast<double>(rows)};
}

} // namespace

std::vector<Figure> sweepFigures(const Sweep& sweep) {
    const std::vector<SweepGroup> groups = groupsOf(sweep.rows);
    const std::vector<std::string> techniques = techniquesOf(sweep.rows);
    std::vector<Figure> figures;
    for (const ErrorMeasure& measure : errorMeasures())
        for (std::size_t i = 0; i < groups.size() && !measure.figure.empty(); ++i)
            if (const std::string script =
                    scatterScript(scatterOf(groups[i], measure, techniques), techniques);
                !script.empty())
                figures.push_back(
                    {format("{}-{}-{}-{}x{}", measure.figure, i + 1, plainName(groups[i].scene),
                            groups[i].width, groups[i].height),
                     titleOf(groups[i]) + ": milliseconds against " + measure.name, script, 7.2,
                     4.4});
    if (!growthOf(sweep.growth).empty())
        figures.push_back(growthFigure(sweep));
    return figures;
}

} // namespace obscura
