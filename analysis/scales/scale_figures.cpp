#include "analysis/scales/scale_figures.h"

#include "analysis/scales/psychometric_figure.h"
#include "analysis/scales/rating_figure.h"
#include "analysis/scales/scale_panels.h"
#include "analysis/scales/scale_table.h"
#include "report/gnuplot.h"
#include "report/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace obscura {

namespace {

using fmt::format;

constexpr std::size_t mostPanels = 12;

std::size_t placeIn(const std::vector<std::string>& list, const std::string& name) {
    return static_cast<std::size_t>(std::find(list.begin(), list.end(), name) - list.begin());
}

std::string pLabel(double p) {
    if (p < 0.001)
        return "p < .001";
    const std::string digits = format("{:.{}f}", p, p < 0.1 ? 3 : 2);
    return "p = " + (digits.front() == '0' ? digits.substr(1) : digits);
}

// The values and what intervals reach, but no further than a few times as far as the values do.
std::pair<double, double> rangeOf(const ScaleResults& results) {
    double least = 1e300, most = -1e300;
    for (const ScaleResult* result : results)
        for (const ScaleItem& item : result->items) {
            least = std::min(least, item.value);
            most = std::max(most, item.value);
        }
    const double reach = 2 * std::max(most - least, 0.5);
    const double lowest = least - reach, highest = most + reach;
    for (const ScaleResult* result : results)
        for (const ScaleItem& item : result->items) {
            least = std::min(least, std::max(lowest, item.interval.low.value_or(item.value)));
            most = std::max(most, std::min(highest, item.interval.high.value_or(item.value)));
        }
    const double margin = 0.04 * std::max(most - least, 0.1);
    return {least - margin, most + margin};
}

// Right of the plot, from row to row: how sure the step is.
std::string stepMarks(const ScaleResult& result, const std::vector<std::size_t>& order) {
    std::string script;
    for (std::size_t row = 0; row + 1 < order.size(); ++row)
        for (const ScaleStep& step : result.steps) {
            if (step.from != order[row] || step.to != order[row + 1] || !step.holm)
                continue;
            const bool differs = *step.holm < 0.05;
            const char* colour = differs ? "#000000" : scaleGrey;
            script += format("set arrow from graph 1.025, first {} to graph 1.025, first {} nohead "
                             "linewidth {} linecolor rgb '{}'\n",
                             static_cast<double>(row) + 0.12, static_cast<double>(row) + 0.88,
                             differs ? 2 : 1, colour);
            script +=
                format("set label {} at graph 1.045, first {} font ',7' textcolor rgb '{}'\n",
                       differs ? gnuplotBold(pLabel(*step.holm)) : gnuplotText(pLabel(*step.holm)),
                       static_cast<double>(row) + 0.5, colour);
        }
    return script;
}

Panel dotPanel(const ScaleResult& result, std::size_t index, std::pair<double, double> range,
               const std::vector<std::string>& techniques, bool hasOrigin, std::string& blocks) {
    const std::vector<std::size_t> order = orderOf(result);
    Panel panel{panelTitle(result.group), {}, heightOf(order)};
    panel.script = rowTicks(result, order) + stepMarks(result, order);
    if (hasOrigin)
        panel.script += format("set arrow from first 0, graph 0 to first 0, graph 1 nohead "
                               "linewidth 1 dashtype 2 linecolor rgb '{}' back\n",
                               scaleGrey);
    std::vector<std::string> plots;
    for (std::size_t row = 0; row < order.size(); ++row) {
        const ScaleItem& item = result.items[order[row]];
        const std::string name = format("panel{}row{}", index, row);
        const bool isKnown = item.interval.low || item.interval.high;
        blocks += plot::block(
            name,
            format("{} {} {} {}\n", item.value, row,
                   isKnown ? std::max(range.first, item.interval.low.value_or(-1e300)) : item.value,
                   isKnown ? std::min(range.second, item.interval.high.value_or(1e300))
                           : item.value));
        const std::size_t technique = placeIn(techniques, item.name);
        if (isKnown)
            plots.push_back(format("${} using 1:2:3:4 with xerrorbars linewidth 2 {} notitle", name,
                                   plot::pointStyle(technique)));
        else // the origin, or nothing is known of its interval
            plots.push_back(
                format("${} using 1:2 with points pointtype 6 pointsize 0.8 linewidth 2 "
                       "linecolor rgb '{}' notitle",
                       name, markOf(technique).colour));
    }
    panel.script += "plot " + plot::list(plots) + "\n";
    return panel;
}

StudyFigure scaleFigure(const ScaleKind& kind, const ScaleResults& results, const std::string& name,
                        const std::string& stamp) {
    const auto range = rangeOf(results);
    const std::vector<std::string> techniques = techniquesOf(results);
    const bool isRating = results.front()->unit == "rating";
    std::string blocks;
    std::vector<Panel> panels;
    for (std::size_t i = 0; i < results.size(); ++i)
        panels.push_back(dotPanel(*results[i], i, range, techniques, !isRating, blocks));
    const std::string axis = isRating ? "mean rating" : results.front()->unit;
    const std::string begin = format(
        "set bars 0\nset xrange [{}:{}]\nset xtics nomirror out {}\nset xlabel {} offset 0, 0.3\n"
        "unset key\nset grid xtics noytics\n",
        range.first, range.second, tickStep(range.second - range.first), gnuplotText(axis));
    PanelLayout layout;
    layout.nameWidth = nameWidth(techniques);
    layout.rightWidth = 0.68;
    const PanelFigure made = panelFigure(blocks, begin, panels, layout, stamp);
    StudyFigure figure;
    figure.drawing = {name, std::string(kind.heading), made.script, made.width, made.height};
    figure.caption = format(
        "{}{} ({}), with 95 % intervals ({}). {}At the right, whether neighbours differ: p "
        "corrected "
        "by Holm within a panel, bold below .05.",
        kind.heading,
        results.front()->group.question.empty() ? ""
                                                : ": \"" + results.front()->group.question + "\"",
        kind.source, results.front()->intervals,
        isRating ? "" : "The ring is the scale's origin, the dashed line its value. ");
    std::vector<Scaled> all;
    for (const ScaleResult* result : results)
        all.push_back({&kind, *result});
    figure.numbers = scaleTable(all);
    return figure;
}

} // namespace

std::vector<StudyFigure> scaleFigures(const Findings& findings) {
    struct Group {
        const ScaleKind* kind;
        std::string question;
        ScaleResults results;
    };
    std::vector<Group> groups;
    for (const Scaled& one : findings.scales.all) {
        const ScaleKind* kind = one.kind;
        const ScaleResult& result = one.result;
        if (!kind->isLeading || result.items.empty())
            continue;
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& known) {
            return known.kind == kind && known.question == result.group.question &&
                   known.results.front()->unit == result.unit;
        });
        if (group == groups.end())
            group = groups.insert(group, {kind, result.group.question, {}});
        if (group->results.size() < mostPanels)
            group->results.push_back(&result);
    }
    const std::string source = sourceOf(findings);
    const std::string stamp =
        source == "participants" || source == "published counts" ? "" : source + " DATA";
    std::vector<StudyFigure> figures;
    std::map<std::string, int> named;
    const auto nameOf = [&](const std::string& base) {
        const int times = ++named[base];
        return times == 1 ? base : format("{}-{}", base, times);
    };
    for (const Group& group : groups) {
        const std::string base = format("scale-{}{}{}", group.kind->id,
                                        group.question.empty() ? "" : "-", group.question);
        if (group.results.front()->curve)
            figures.push_back(psychometricFigure(*group.kind, group.results, nameOf(base), stamp));
        else
            figures.push_back(scaleFigure(*group.kind, group.results, nameOf(base), stamp));
        const bool hasCounts =
            std::any_of(group.results.begin(), group.results.end(),
                        [](const ScaleResult* one) { return !one->items.front().counts.empty(); });
        if (hasCounts)
            figures.push_back(
                ratingFigure(group.results, nameOf("ratings-" + group.question), stamp));
    }
    return figures;
}

} // namespace obscura
