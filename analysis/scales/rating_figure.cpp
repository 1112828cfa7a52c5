#include "analysis/scales/rating_figure.h"

#include "report/paper_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace obscura {

namespace {

using fmt::format;

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
    Panel panel{panelTitle(result.group), {}, heightOf(order)};
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

} // namespace

StudyFigure ratingFigure(const ScaleResults& results, const std::string& name,
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
            std::vector<std::string> row = {panelTitle(results[i]->group), item.name};
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

} // namespace obscura
