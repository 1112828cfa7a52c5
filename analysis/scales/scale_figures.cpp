#include "analysis/scales/scale_figures.h"

#include "analysis/scales/panels.h"
#include "analysis/scales/scale_table.h"
#include "analysis/scales/scale_words.h"
#include "report/gnuplot.h"
#include "report/marks.h"

#include "inference/counts.h"
#include "inference/psychometric.h"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace obscura {

namespace {

using fmt::format;
using Results = std::vector<const ScaleResult*>;

constexpr std::size_t mostPanels = 12;
constexpr double rowHeight = 0.23; // of a technique, inches
constexpr const char* grey = "#777777";

std::string titleOf(const ScaleGroup& group) {
    ScaleGroup place = group;
    place.question.clear();
    return placeOf(place);
}

std::string pText(double p) {
    if (p < 0.001)
        return "p < .001";
    const std::string digits = format("{:.{}f}", p, p < 0.1 ? 3 : 2);
    return "p = " + (digits.front() == '0' ? digits.substr(1) : digits);
}

// A round step so that the range has some four to seven ticks.
double tickStep(double range) {
    const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (rough <= factor * power)
            return factor * power;
    return 10 * power;
}

// The values and what intervals reach, but no further than a few times as far as the values do.
std::pair<double, double> rangeOf(const Results& results) {
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

std::size_t placeIn(const std::vector<std::string>& list, const std::string& name) {
    return static_cast<std::size_t>(std::find(list.begin(), list.end(), name) - list.begin());
}

std::vector<std::string> techniquesOf(const Results& results) {
    std::vector<std::string> names;
    for (const ScaleResult* result : results)
        for (const ScaleItem& item : result->items)
            if (placeIn(names, item.name) == names.size())
                names.push_back(item.name);
    return names;
}

double nameWidth(const std::vector<std::string>& names) {
    double width = 0.4;
    for (const std::string& name : names)
        width = std::max(width, textWidth(name));
    return std::min(width, 1.6) + 0.22;
}

std::string rowTicks(const ScaleResult& result, const std::vector<std::size_t>& order) {
    std::vector<std::string> ticks;
    for (std::size_t row = 0; row < order.size(); ++row)
        ticks.push_back(format("{} {}", gnuplotText(result.items[order[row]].name), row));
    return format("set yrange [-0.6:{}]\nset ytics nomirror scale 0 ({})\n",
                  static_cast<double>(order.size()) - 0.4, fmt::join(ticks, ", "));
}

// Right of the plot, from row to row: how sure the step is.
std::string stepMarks(const ScaleResult& result, const std::vector<std::size_t>& order) {
    std::string script;
    for (std::size_t row = 0; row + 1 < order.size(); ++row)
        for (const ScaleStep& step : result.steps) {
            if (step.from != order[row] || step.to != order[row + 1] || !step.holm)
                continue;
            const bool differs = *step.holm < 0.05;
            const char* colour = differs ? "#000000" : grey;
            script += format("set arrow from graph 1.025, first {} to graph 1.025, first {} nohead "
                             "linewidth {} linecolor rgb '{}'\n",
                             static_cast<double>(row) + 0.12, static_cast<double>(row) + 0.88,
                             differs ? 2 : 1, colour);
            script +=
                format("set label {} at graph 1.045, first {} font ',7' textcolor rgb '{}'\n",
                       differs ? gnuplotBold(pText(*step.holm)) : gnuplotText(pText(*step.holm)),
                       static_cast<double>(row) + 0.5, colour);
        }
    return script;
}

Panel dotPanel(const ScaleResult& result, std::size_t index, std::pair<double, double> range,
               const std::vector<std::string>& techniques, bool hasOrigin, std::string& blocks) {
    const std::vector<std::size_t> order = orderOf(result);
    Panel panel{titleOf(result.group), {}, rowHeight * static_cast<double>(order.size()) + 0.06};
    panel.script = rowTicks(result, order) + stepMarks(result, order);
    if (hasOrigin)
        panel.script += format("set arrow from first 0, graph 0 to first 0, graph 1 nohead "
                               "linewidth 1 dashtype 2 linecolor rgb '{}' back\n",
                               grey);
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

StudyFigure scaleFigure(const ScaleKind& kind, const Results& results, const std::string& name,
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

// Light to dark blue.
std::string ramp(std::size_t i, std::size_t count) {
    const double t = count < 2 ? 1 : static_cast<double>(i) / static_cast<double>(count - 1);
    const auto mix = [&](int light, int dark) {
        return static_cast<int>(std::lround(light + t * (dark - light)));
    };
    return format("#{:02X}{:02X}{:02X}", mix(0xE3, 0x08), mix(0xEE, 0x40), mix(0xF9, 0x81));
}

Panel distributionPanel(const ScaleResult& result, const std::vector<double>& values,
                        std::string& blocks, std::size_t index) {
    const std::vector<std::size_t> order = orderOf(result);
    Panel panel{titleOf(result.group), {}, rowHeight * static_cast<double>(order.size()) + 0.06};
    panel.script = rowTicks(result, order);
    std::vector<std::string> plots;
    std::vector<std::string> lines(values.size());
    for (std::size_t row = 0; row < order.size(); ++row) {
        const ScaleItem& item = result.items[order[row]];
        double total = 0, left = 0;
        for (const auto& [value, count] : item.counts)
            total += count;
        for (const auto& [value, count] : item.counts) {
            const auto place = static_cast<std::size_t>(
                std::find(values.begin(), values.end(), value) - values.begin());
            const double share = 100 * count / total;
            lines[place] +=
                format("{} {} {} {} {} {}\n", left + share / 2, row, left, left + share,
                       static_cast<double>(row) - 0.36, static_cast<double>(row) + 0.36);
            if (share > 6)
                panel.script += format(
                    "set label '{}' at first {}, first {} center font ',7' textcolor rgb '{}' "
                    "front\n",
                    count, left + share / 2, row, 2 * place >= values.size() ? "white" : "black");
            left += share;
        }
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (lines[i].empty())
            continue;
        const std::string name = format("panel{}value{}", index, i);
        blocks += plot::block(name, lines[i]);
        plots.push_back(format("${} using 1:2:3:4:5:6 with boxxyerror fillstyle solid 1 border rgb "
                               "'white' linecolor rgb '{}' notitle",
                               name, ramp(i, values.size())));
    }
    panel.script += "plot " + plot::list(plots) + "\n";
    return panel;
}

// What the shades mean, in a row above all panels.
std::string shadeKey(const std::vector<double>& values) {
    std::string script;
    double x = 0.1;
    script += format("set label 'rating:' at screen {:.4f}, screen 1 offset 0, -0.9\n", x / 7.2);
    x += 0.55;
    for (std::size_t i = 0; i < values.size(); ++i) {
        script +=
            format("set label '■' at screen {0:.4f}, screen 1 offset 0, -0.9 textcolor rgb "
                   "'{1}' font ',11'\nset label '{2:g}' at screen {3:.4f}, screen 1 offset 0, "
                   "-0.9\n",
                   x / 7.2, ramp(i, values.size()), values[i], (x + 0.17) / 7.2);
        x += 0.3 + textWidth(format("{:g}", values[i]));
    }
    return script;
}

StudyFigure distributionFigure(const Results& results, const std::string& name,
                               const std::string& stamp) {
    std::set<double> given;
    for (const ScaleResult* result : results)
        for (const ScaleItem& item : result->items)
            for (const auto& [value, count] : item.counts)
                given.insert(value);
    const std::vector<double> values(given.begin(), given.end());
    std::string blocks;
    std::vector<Panel> panels;
    StudyFigure figure;
    figure.numbers.columns = {{"Where"}, {"Technique"}};
    for (const double value : values)
        figure.numbers.columns.push_back({format("{:g}", value), true});
    for (std::size_t i = 0; i < results.size(); ++i) {
        panels.push_back(distributionPanel(*results[i], values, blocks, i));
        for (const ScaleItem& item : results[i]->items) {
            std::vector<std::string> row = {titleOf(results[i]->group), item.name};
            for (const double value : values) {
                const auto count =
                    std::find_if(item.counts.begin(), item.counts.end(),
                                 [&](const auto& one) { return one.first == value; });
                row.push_back(format("{}", count == item.counts.end() ? 0 : count->second));
            }
            figure.numbers.rows.push_back(std::move(row));
        }
    }
    panels.front().script = shadeKey(values) + panels.front().script;
    PanelLayout layout;
    layout.nameWidth = nameWidth(techniquesOf(results));
    layout.header = 0.26;
    const PanelFigure made = panelFigure(
        blocks,
        "set xrange [0:100]\nset xtics nomirror out 25\nset xlabel '% of ratings' offset 0, 0.3\n"
        "unset key\nset grid xtics noytics\n",
        panels, layout, stamp);
    figure.drawing = {name, "How often each rating was given", made.script, made.width,
                      made.height};
    figure.caption = format("\"{}\": how often each rating was given, lighter for lower ones. "
                            "Numbers within the bars are ratings.",
                            results.front()->group.question);
    return figure;
}

double seenLevel(const Ladder& ladder, Eigen::Index i) {
    return ladder.isFalling ? -ladder.data.level(i) : ladder.data.level(i);
}

// Of all labels beside each other, inches.
double labelWidth(const Ladder& ladder) {
    double width = 0;
    for (const std::string& label : ladder.labels)
        width += textWidth(label) + 0.1;
    return ladder.isOrder ? width : 0;
}

Panel curvePanel(const ScaleResult& result, std::size_t index, std::string& blocks) {
    const auto& [ladder, model, parameters] = *result.curve;
    Panel panel{titleOf(result.group), {}, 1.9};
    double least = 1e300, most = -1e300;
    for (Eigen::Index i = 0; i < ladder.data.level.size(); ++i) {
        least = std::min(least, seenLevel(ladder, i));
        most = std::max(most, seenLevel(ladder, i));
    }
    const double margin = 0.06 * (most - least);
    const double left = least - margin, right = most + margin;
    std::string points, curve;
    for (Eigen::Index i = 0; i < ladder.data.level.size(); ++i) {
        const double trials = ladder.data.trials(i), successes = ladder.data.successes(i);
        const Interval interval =
            wilson(static_cast<std::int64_t>(successes), static_cast<std::int64_t>(trials));
        points +=
            format("{} {} {} {} {}\n", seenLevel(ladder, i), successes / trials, interval.low,
                   interval.high, 0.5 + 0.7 * std::sqrt(trials / ladder.data.trials.maxCoeff()));
    }
    for (int i = 0; i <= 120; ++i) {
        const double x = left + (right - left) * i / 120;
        curve += format("{} {}\n", x, probability(model, parameters, ladder.isFalling ? -x : x));
    }
    const ScaleItem& threshold = result.items.front();
    const double half = probability(model, parameters, parameters.threshold);
    const double low = std::max(left, threshold.interval.low.value_or(left)),
                 high = std::min(right, threshold.interval.high.value_or(right));
    const std::string name = format("panel{}", index);
    blocks +=
        plot::block(name + "points", points) + plot::block(name + "curve", curve) +
        plot::block(name + "threshold", format("{} {} {} {}\n", threshold.value, half, low, high));
    panel.script = format("set xrange [{}:{}]\n", left, right);
    if (ladder.isOrder) {
        std::vector<std::string> ticks;
        for (Eigen::Index i = 0; i < ladder.data.level.size(); ++i)
            ticks.push_back(format("{} {}", gnuplotText(ladder.labels[static_cast<std::size_t>(i)]),
                                   seenLevel(ladder, i)));
        panel.script +=
            format("set xtics nomirror out{} ({})\n",
                   labelWidth(ladder) > 2.5 ? " rotate by -35" : "", fmt::join(ticks, ", "));
    } else {
        panel.script += format("set xtics nomirror out {}\n", tickStep(right - left));
    }
    const bool isRight = threshold.value > (left + right) / 2; // so that the label has room
    panel.script += format(
        "set arrow from first {0}, graph 0 to first {0}, first {1} nohead linewidth 1 dashtype 2 "
        "linecolor rgb '#D55E00'\n"
        "set label {2} at first {0}, graph 0 {3} offset {4}, 0.7 font ',7' textcolor rgb "
        "'#B33A00'\n",
        threshold.value, half,
        gnuplotText(format("{:.0f} %: {}{:.3g} ({:.3g} to {:.3g})", 100 * half,
                           ladder.isOrder ? "step " : "", threshold.value, low, high)),
        isRight ? "right" : "left", isRight ? -0.7 : 0.7);
    panel.script +=
        format("plot {} with lines linewidth 1 dashtype 3 linecolor rgb '{}' notitle, \\\n"
               "  ${}curve with lines linewidth 2 linecolor rgb '#0072B2' notitle, \\\n"
               "  ${}threshold using 1:2:3:4 with xerrorbars linewidth 3 pointtype 7 pointsize 0.1 "
               "linecolor rgb '#D55E00' notitle, \\\n"
               "  ${}points using 1:2:3:4 with yerrorbars linewidth 1 pointtype 7 pointsize 0.1 "
               "linecolor rgb '#000000' notitle, \\\n"
               "  ${}points using 1:2:5 with points pointtype 7 pointsize variable linecolor rgb "
               "'#000000' notitle\n",
               model.guess, grey, name, name, name, name);
    return panel;
}

StudyFigure curveFigure(const ScaleKind& kind, const Results& results, const std::string& name,
                        const std::string& stamp) {
    std::string blocks;
    std::vector<Panel> panels;
    StudyFigure figure;
    figure.numbers.columns = {{"Where"},     {"Step"},     {"Level", true},
                              {"Yes", true}, {"Of", true}, {"Share", true}};
    for (std::size_t i = 0; i < results.size(); ++i) {
        panels.push_back(curvePanel(*results[i], i, blocks));
        const Ladder& ladder = results[i]->curve->ladder;
        for (Eigen::Index k = 0; k < ladder.data.level.size(); ++k)
            figure.numbers.rows.push_back(
                {titleOf(results[i]->group), ladder.labels[static_cast<std::size_t>(k)],
                 format("{:.4g}", seenLevel(ladder, k)), format("{}", ladder.data.successes(k)),
                 format("{}", ladder.data.trials(k)),
                 format("{:.3f}", ladder.data.successes(k) / ladder.data.trials(k))});
    }
    const Ladder& first = results.front()->curve->ladder;
    const std::string begin =
        format("set bars 0\nset yrange [0:1.02]\nset ytics nomirror out 0.25\nset ylabel {} offset "
               "1, 0\nset xlabel {} offset 0, 0.3\nunset key\n",
               gnuplotText("share of " + first.success),
               gnuplotText(first.isOrder ? "step of the ladder" : first.axis));
    PanelLayout layout;
    layout.nameWidth = 0.62;
    layout.rightWidth = 0.15;
    layout.below = 0.5;
    for (const ScaleResult* result : results)
        if (labelWidth(result->curve->ladder) > 2.5)
            layout.below = 0.9;
    const PanelFigure made = panelFigure(blocks, begin, panels, layout, stamp);
    figure.drawing = {name, std::string(kind.heading), made.script, made.width, made.height};
    figure.caption = format(
        "{} ({}): share of {} with Wilson's 95 % intervals, larger for more answers; the fitted "
        "curve; in orange its threshold with the 95 % interval ({}). Dotted: what guessing gives.",
        kind.heading, kind.source, first.success, results.front()->intervals);
    return figure;
}

} // namespace

std::vector<StudyFigure> scaleFigures(const Findings& findings) {
    struct Group {
        const ScaleKind* kind;
        std::string question;
        Results results;
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
            figures.push_back(curveFigure(*group.kind, group.results, nameOf(base), stamp));
        else
            figures.push_back(scaleFigure(*group.kind, group.results, nameOf(base), stamp));
        const bool hasCounts =
            std::any_of(group.results.begin(), group.results.end(),
                        [](const ScaleResult* one) { return !one->items.front().counts.empty(); });
        if (hasCounts)
            figures.push_back(
                distributionFigure(group.results, nameOf("ratings-" + group.question), stamp));
    }
    return figures;
}

} // namespace obscura
