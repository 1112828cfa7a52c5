#include "bench/figures.h"

#include "bench/axis.h"
#include "bench/growth.h"
#include "bench/marks.h"
#include "bench/scatter.h"
#include "bench/sweep_tables.h"
#include "protocols/files.h"
#include "report/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace obscura {

namespace {

using fmt::format;

constexpr const char* style = R"(set encoding utf8
set border 3 linecolor rgb '#555555'
set grid linetype 1 linewidth 0.5 linecolor rgb '#DDDDDD'
set key Left reverse samplen 1 spacing 1.1
)";

constexpr const char* scatterFrame = R"(set bars 0
set lmargin at screen 0.085
set rmargin at screen 0.64
set tmargin at screen 0.97
set bmargin at screen 0.12
set xlabel 'milliseconds (what is free stands at the left edge)'
set ylabel 'RMSE of visibility, matched'
)";

std::string ticks(const char* axis, const Axis& range) {
    std::string list;
    for (const Tick& tick : range.ticks)
        list += format("{}'{}' {}{}", list.empty() ? "" : ", ", tick.label, tick.value,
                       tick.label.empty() ? " 1" : "");
    return format("{2} logscale {0}\nset {0}range [{3}:{4}]\nset {0}tics nomirror out ({1})\n",
                  axis, list, range.logarithmic ? "set" : "unset", range.low, range.high);
}

std::string block(const std::string& name, const std::string& lines) {
    return format("${} << END\n{}END\n", name, lines);
}

std::string pointStyle(std::size_t technique) {
    const Mark mark = markOf(technique);
    return format("pointtype {} pointsize 0.7 linecolor rgb '{}'", mark.gnuplot, mark.colour);
}

// What one plot command draws, each on a line of its own.
std::string plotList(const std::vector<std::string>& elements) {
    return format("{}", fmt::join(elements, ", \\\n  "));
}

// From above the first point of the front to the right border.
std::string staircase(const std::vector<ParetoPoint>& points, const std::vector<std::size_t>& front,
                      double top, double right) {
    std::string lines;
    for (const std::size_t i : front) {
        if (lines.empty())
            lines = format("{} {}\n", points[i].milliseconds, top);
        lines += format("{} {}\n", points[i].milliseconds, points[i].error);
    }
    return lines + format("{} {}\n", right, points[front.back()].error);
}

// Techniques, then the front's configurations, in the margin at the right.
std::string scatterKey(const std::vector<std::string>& techniques,
                       const std::vector<std::size_t>& present,
                       const std::vector<ParetoPoint>& points,
                       const std::vector<std::size_t>& front) {
    constexpr double left = 0.665, top = 0.965, line = 0.036;
    const std::size_t rows = (present.size() + 1) / 2; // in two columns
    std::string script;
    for (std::size_t i = 0; i < present.size(); ++i)
        script +=
            format("set label {} at screen {:.4f}, {:.4f} point {} offset char 1, 0 font ',7'\n",
                   gnuplotText(techniques[present[i]]), left + (i < rows ? 0 : 0.165),
                   top - line * static_cast<double>(i % rows), pointStyle(present[i]));
    for (std::size_t k = 0; k < front.size(); ++k)
        script += format("set label {} at screen {:.4f}, {:.4f} font ',6.5'\n",
                         gnuplotText(format("{}  {}", k + 1, points[front[k]].name)), left - 0.008,
                         top - line * static_cast<double>(rows + k) - 0.02);
    return script;
}

std::string frontNumbers(const std::vector<ParetoPoint>& points,
                         const std::vector<std::size_t>& front, const Axis& across,
                         const Axis& up) {
    constexpr double width = 493, height = 461; // of the plot, in twelfths of a number's height
    std::vector<Spot> spots;
    spots.reserve(front.size());
    for (const std::size_t i : front)
        spots.push_back(
            {width * across.at(points[i].milliseconds), height * (1 - up.at(points[i].error))});
    const auto places = numberPlaces(spots, 0, height);
    std::string script;
    const auto at = [&](double x, double y) {
        return format("graph {:.4f}, {:.4f}", x / width, 1 - y / height);
    };
    for (std::size_t k = 0; k < front.size(); ++k) {
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

// One technique's points: a line through them, their percentiles and their marks.
std::string technique(std::size_t index) {
    const std::string colour = format("linecolor rgb '{}'", markOf(index).colour);
    return plotList({format("$t{} using 1:2 with lines linewidth 0.5 {} notitle", index, colour),
                     format("$t{} using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth "
                            "0.7 {} notitle",
                            index, colour),
                     format("$t{} using 1:2 with points {} notitle", index, pointStyle(index))});
}

// Nothing where nothing has both a time and an error.
std::optional<Figure> scatter(const SweepGroup& group, const std::vector<std::string>& techniques,
                              std::size_t number) {
    double least = std::numeric_limits<double>::infinity();
    for (const SweepRow& row : group.points)
        if (row.total.low > 0)
            least = std::min(least, row.total.low);
    // What is free has no logarithm: it stands at the left edge.
    const auto shown = [&](double value) { return value == 0 ? least / 2 : value; };
    std::vector<ParetoPoint> points;
    std::vector<double> milliseconds, errors;
    std::map<std::size_t, std::string> lines; // by technique
    for (const SweepRow& row : group.points) {
        const ParetoPoint point{shown(row.total.median), errorMeasures().front().of(row),
                                row.configuration};
        if (std::isnan(point.milliseconds) || std::isnan(point.error))
            continue;
        const double low = shown(row.total.low), high = shown(row.total.high);
        points.push_back(point);
        milliseconds.insert(milliseconds.end(), {low, point.milliseconds, high});
        errors.push_back(point.error);
        lines[indexOf(techniques, row.technique)] +=
            format("{} {} {} {}\n", point.milliseconds, point.error, low, high);
    }
    if (points.empty() || std::isinf(least))
        return std::nullopt;
    const std::vector<std::size_t> front = paretoFront(points);
    const Axis across = logarithmicAxis(milliseconds), up = linearAxis(errors);
    std::vector<std::string> elements{
        "$front using 1:2 with steps linewidth 1.5 linecolor rgb '#333333' notitle"};
    std::vector<std::size_t> present;
    std::string data = block("front", staircase(points, front, up.high, across.high));
    for (const auto& [index, text] : lines) {
        present.push_back(index);
        data += block(format("t{}", index), text);
        elements.push_back(technique(index));
    }
    return Figure{
        format("scatter-{}-{}-{}x{}", number, plainName(group.scene), group.width, group.height),
        titleOf(group) + ": milliseconds against matched RMSE",
        style + ticks("x", across) + ticks("y", up) + scatterFrame +
            scatterKey(techniques, present, points, front) +
            frontNumbers(points, front, across, up) + data + "plot " + plotList(elements) + "\n",
        7.2, 4.4};
}

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
            data += block(format("g{}", i), lines);
            elements.push_back(format("$g{} using 1:2 with linespoints linewidth 1 {} title {}", i,
                                      pointStyle(techniqueOf.at(growth[i].configuration)),
                                      gnuplotText(growth[i].configuration)));
        }
        panels += ticks("x", valueAxis(values)) + ticks("y", logarithmicAxis(milliseconds)) +
                  format("set xlabel {}\n", gnuplotText(axisTitle(axes[a]))) + "plot " +
                  plotList(elements) + "\nunset key\n";
    }
    return {"growth", "How milliseconds grow",
            style + data +
                format("set ylabel 'milliseconds' offset 1\n"
                       "set key at screen 0.685, screen 0.97 left top font ',7'\n"
                       "set multiplot layout {},2 margins 0.08,0.66,{},0.97 spacing 0.1,{}\n",
                       rows, 0.19 / static_cast<double>(rows), 0.25 / static_cast<double>(rows)) +
                panels + "unset multiplot\n",
            7.2, 2.3 * static_cast<double>(rows)};
}

struct VariantStyle {
    int point;
    const char* colour;
};
constexpr std::array<VariantStyle, 4> variantStyles = {
    {{7, "#000000"}, {9, "#0072B2"}, {5, "#E69F00"}, {13, "#D55E00"}}};

// Samples, then for each variant milliseconds and per cent of plain.
std::string ablationLines(const AblationTable::Column& column) {
    std::string lines;
    for (std::size_t s = 0; s < ablationSamples.size(); ++s) {
        lines += format("{}", ablationSamples[s]);
        for (const double milliseconds : column.milliseconds[s])
            lines += format(" {} {}", milliseconds, 100 * milliseconds / column.milliseconds[s][0]);
        lines += "\n";
    }
    return lines;
}

// The variants' lines of one panel: milliseconds, or per cent of plain.
std::string variants(const std::string& block, bool percent, bool published) {
    std::vector<std::string> elements;
    for (std::size_t v = percent ? 1 : 0; v < ablationVariants.size(); ++v)
        elements.push_back(format(
            "${} using 1:{} with linespoints pointtype {} pointsize 0.7 {}linecolor rgb '{}' "
            "title '{}'",
            block, 2 + 2 * v + (percent ? 1 : 0), variantStyles[v].point,
            published ? "dashtype 2 " : "", published ? "#999999" : variantStyles[v].colour,
            percent && !published ? "" : ablationVariants[v]));
    return plotList(elements);
}

// A column for each resolution: above milliseconds, below per cent of plain, the paper's at 1080p
// in grey.
Figure ablationFigure(const AblationTable& table, std::size_t number) {
    const std::size_t columns = table.columns.size();
    std::string data = block("paper", ablationLines(publishedAblation().columns.front())), above,
                below;
    for (std::size_t c = 0; c < columns; ++c) {
        const std::string name = format("c{}", c);
        data += block(name, ablationLines(table.columns[c]));
        above += format("set title '{}'\nplot {}\n", table.columns[c].title,
                        variants(name, false, false)) +
                 "unset key\nunset ylabel\n";
        below += format("plot {}, \\\n  {}\n", variants(name, true, false),
                        variants("paper", true, true)) +
                 "unset key\nunset ylabel\n";
    }
    return {format("ablation-{}-{}", number, plainName(table.scene)),
            format("What the extensions of VAO++ save, {}", table.scene),
            style + data +
                format("set logscale x\nset xrange [1.8:36]\nset xtics (2, 4, 8, 16, 32) nomirror "
                       "out\nset ytics nomirror out\nset yrange [0:*]\n"
                       "set ylabel 'milliseconds' offset 1\n"
                       "set key at screen 0.79, screen 0.95 left top\n"
                       "set multiplot layout 2,{} margins 0.09,0.77,0.1,0.94 spacing 0.06,0.1\n",
                       columns) +
                above +
                "unset title\nset xlabel 'samples'\nset ylabel 'per cent of plain' offset 1\n"
                "set key at screen 0.79, screen 0.48 left top title 'on a GTX 970, 1080p' left\n" +
                below + "unset multiplot\n",
            7.2, 4.4};
}

// Font sizes are points; both terminals count 96ths of an inch.
std::string svgTerminal(const Figure& figure) {
    return format("set terminal svg enhanced size {:.0f},{:.0f} dynamic font 'sans-serif,8' "
                  "fontscale 1.333 background rgb 'white'\n",
                  96 * figure.width, 96 * figure.height);
}

std::string pdfTerminal(const Figure& figure) {
    return format("set terminal pdfcairo enhanced size {},{} font 'sans-serif,8' fontscale 0.75\n",
                  figure.width, figure.height);
}

} // namespace

std::vector<Figure> sweepFigures(const Sweep& sweep) {
    const std::vector<SweepGroup> groups = groupsOf(sweep.rows);
    const std::vector<std::string> techniques = techniquesOf(sweep.rows);
    std::vector<Figure> figures;
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (auto figure = scatter(groups[i], techniques, i + 1))
            figures.push_back(std::move(*figure));
    std::size_t number = 0;
    for (const AblationTable& table : ablationTables(groups))
        figures.push_back(ablationFigure(table, ++number));
    if (!growthOf(sweep.growth).empty())
        figures.push_back(growthFigure(sweep));
    return figures;
}

void writeFigures(const std::filesystem::path& folder, const std::vector<Figure>& figures) {
    for (const Figure& figure : figures) {
        const std::string howTo =
            format("# gnuplot -e \"{}; set output '{}.pdf'\" {}.gnuplot\n",
                   pdfTerminal(figure).substr(0, pdfTerminal(figure).size() - 1), figure.name,
                   figure.name);
        writeFile(folder / (figure.name + ".gnuplot"), howTo + figure.script);
        writeFile(folder / (figure.name + ".svg"),
                  gnuplotSvg(svgTerminal(figure) + figure.script, figure.title));
        writeFile(folder / (figure.name + ".pdf"), gnuplotPdf(pdfTerminal(figure) + figure.script));
    }
}

} // namespace obscura
