#include "analysis/prices/price_chart.h"

#include "analysis/prices/label_places.h"
#include "analysis/prices/price_axes.h"
#include "analysis/scales/scale_panels.h"
#include "report/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

using fmt::format;

constexpr double letter = 0.07, line = 0.15; // inches, of small type on the page
constexpr double beside = 0.085;             // inches from people's mark to the predicted one

constexpr double left = 0.64, right = 0.16, below = 0.54, title = 0.26; // of a panel

constexpr const char* peopleColour = "#0B5394";
constexpr const char* predictedColour = "#B35900";
constexpr const char* plateauColour = "#E9F1E6";

double widthOf(const std::string& text) { return textWidth(text) / textWidth("x") * letter; }

std::string nameOf(const PricedScale& scale, std::size_t i) {
    const Priced& one =
        scale.techniques[i]; // without a time, the axis says that it is the reference
    return one.name + (i == scale.reference && one.milliseconds ? " (reference)" : "");
}

// What is written over the plateau, and whether it stands left of its line.
struct Heading {
    std::string text;
    double x = 0;
    bool isLeft = false;
};

std::optional<Heading> headingOf(const PricedScale& scale, const PriceAxes& axes) {
    const auto& place = scale.enough ? scale.enough : scale.untold;
    if (!place && !scale.seesAll())
        return std::nullopt;
    if (!place)
        return Heading{"people saw what the dearest bought", 0.02, false};
    const Priced& one = scale.techniques[place->technique];
    Heading heading{scale.enough
                        ? place->seen.empty()
                              ? "beyond " + one.name + ": nothing that people saw"
                              : format("beyond {}: less than {:g} JOD", one.name, noticeableJod)
                        : "beyond " + one.name + ": nothing shown",
                    axes.x(one)};
    heading.isLeft =
        heading.x + 0.08 + widthOf(heading.text) > axes.width() && heading.x > axes.width() / 2;
    return heading;
}

std::string plateauScript(const PricedScale& scale, const PriceAxes& axes) {
    std::string script;
    const auto lineAt = [&](const Plateau& place, const char* style) {
        script += format("set arrow from first {0}, graph 0 to first {0}, graph 1 nohead back "
                         "linewidth 1 {1} linecolor rgb '#3B6E2E'\n",
                         axes.milliseconds(axes.x(scale.techniques[place.technique])), style);
    };
    if (scale.enough) {
        script += format("set object rectangle from first {}, graph 0 to graph 1, graph 1 behind "
                         "fillcolor rgb '{}' fillstyle solid noborder\n",
                         axes.milliseconds(axes.x(scale.techniques[scale.enough->technique])),
                         plateauColour);
        lineAt(*scale.enough, "");
    }
    if (scale.untold && (!scale.enough || scale.untold->technique < scale.enough->technique))
        lineAt(*scale.untold, "dashtype 3");
    if (const auto heading = headingOf(scale, axes))
        script += format("set label {} at graph {:.5f}, graph {:.5f} {} font ',7' "
                         "textcolor rgb '#2E5723' front\n",
                         gnuplotText(heading->text),
                         (heading->x + (heading->isLeft ? -0.06 : 0.06)) / axes.width(),
                         1 - 0.1 / axes.height(), heading->isLeft ? "right" : "left");
    return script;
}

std::string names(const PricedScale& scale, const PriceAxes& axes) {
    std::vector<Named> points;
    std::vector<Box> taken;
    for (std::size_t i = 0; i < scale.techniques.size(); ++i) {
        const Priced& one = scale.techniques[i];
        const double x = axes.x(one);
        points.push_back({x, axes.y(axes.seen(one.interval.low.value_or(one.people))),
                          axes.y(axes.seen(one.interval.high.value_or(one.people))),
                          widthOf(nameOf(scale, i)), line});
        if (one.predicted && i != scale.reference) {
            const double y = axes.y(axes.seen(*one.predicted));
            taken.push_back({x + beside - 0.06, y - 0.07, x + beside + 0.06, y + 0.07});
        }
    }
    if (const auto heading = headingOf(scale, axes)) {
        const double width = widthOf(heading->text) + 0.06;
        taken.push_back({heading->isLeft ? heading->x - width : heading->x,
                         axes.height() - line - 0.03,
                         heading->isLeft ? heading->x : heading->x + width, axes.height()});
    }
    for (const auto& place : {scale.enough, scale.untold})
        if (place) {
            const double x = axes.x(scale.techniques[place->technique]);
            taken.push_back({x - 0.01, 0, x + 0.01, axes.height()});
        }
    for (const double jod : {0.0, -noticeableJod})
        taken.push_back({0, axes.y(jod) - 0.01, axes.width(), axes.y(jod) + 0.01});
    for (std::size_t k = 0; k < scale.front.size(); ++k) { // the staircase
        const Priced& here = scale.techniques[scale.front[k]];
        const double x = axes.x(here), y = axes.y(here.people);
        if (k + 1 == scale.front.size()) {
            taken.push_back({x, y - 0.01, axes.width(), y + 0.01});
            break;
        }
        const Priced& next = scale.techniques[scale.front[k + 1]];
        taken.push_back({x, y - 0.01, axes.x(next), y + 0.01});
        taken.push_back({axes.x(next) - 0.01, y, axes.x(next) + 0.01, axes.y(next.people)});
    }
    std::string script;
    const auto boxes =
        labelPlaces(points, taken, {0.02, 0.02, axes.width() + right, axes.height()});
    for (std::size_t i = 0; i < boxes.size(); ++i)
        script += format("set label {} at graph {:.5f}, graph {:.5f} center font ',7' front\n",
                         gnuplotText(nameOf(scale, i)),
                         (boxes[i].left + boxes[i].right) / 2 / axes.width(),
                         (boxes[i].bottom + boxes[i].top) / 2 / axes.height());
    return script;
}

// The chart within its margins; `number` keeps its data apart from those of other panels.
std::string chartScript(const PricedScale& scale, const PriceAxes& axes, std::size_t number) {
    std::string people, predicted, front;
    for (std::size_t i = 0; i < scale.techniques.size(); ++i) {
        const Priced& one = scale.techniques[i];
        const double x = axes.x(one);
        people += format("{} {} {} {}\n", axes.milliseconds(x), one.people,
                         axes.seen(one.interval.low.value_or(one.people)),
                         axes.seen(one.interval.high.value_or(one.people)));
        if (one.predicted && i != scale.reference)
            predicted += format("{} {}\n", axes.milliseconds(x + beside), *one.predicted);
    }
    for (const std::size_t i : scale.front)
        front += format("{} {}\n", axes.milliseconds(axes.x(scale.techniques[i])),
                        scale.techniques[i].people);
    if (!scale.front.empty())
        front += format("{} {}\n", axes.milliseconds(axes.width()),
                        scale.techniques[scale.front.back()].people);
    const std::string name = format("chart{}", number);
    std::string script = plot::block(name + "people", people) + plot::block(name + "front", front) +
                         axes.script() + plateauScript(scale, axes) + names(scale, axes);
    // Two colours, for gnuplot's SVG draws the second of two alike as it drew the first.
    for (const auto& [jod, style] :
         {std::pair(0.0, "linecolor rgb '#777777'"),
          std::pair(-noticeableJod, "dashtype 2 linecolor rgb '#666666'")})
        script += format("set arrow from graph 0, first {0} to graph 1, first {0} nohead back "
                         "linewidth 1 {1}\n",
                         jod, style);
    std::vector<std::string> plots = {
        format("${}front using 1:2 with steps linewidth 1 linecolor rgb '{}' notitle", name,
               peopleColour),
        format("${}people using 1:2:3:4 with yerrorbars linewidth 2 pointtype 7 pointsize 0.75 "
               "linecolor rgb '{}' notitle",
               name, peopleColour)};
    if (!predicted.empty()) {
        script += plot::block(name + "predicted", predicted);
        plots.push_back(format("${}predicted using 1:2 with points pointtype 12 pointsize 0.95 "
                               "linewidth 1.5 linecolor rgb '{}' notitle",
                               name, predictedColour));
    }
    return script + "plot " + plot::list(plots) + "\n";
}

// Entries of the key side by side, as far as there is room; inches from the left and the top.
struct KeyLine {
    std::string text, mark;
    double x = 0, y = 0;
};
constexpr double entryHeight = 0.19;

std::vector<KeyLine> keyOf(const std::vector<const PricedScale*>& scales, double width) {
    const auto any = [&](const auto& holds) {
        return std::any_of(scales.begin(), scales.end(), holds);
    };
    const auto mark = [](int type, double size, const char* colour) {
        return format("point pointtype {} pointsize {} linewidth 1.5 linecolor rgb '{}'", type,
                      size, colour);
    };
    std::vector<KeyLine> entries = {{"people, 95 % interval", mark(7, 0.75, peopleColour)}};
    if (any([](const PricedScale* one) {
            return std::any_of(one->techniques.begin(), one->techniques.end(),
                               [](const Priced& priced) { return priced.predicted.has_value(); });
        }))
        entries.push_back({"predicted (ColorVideoVDP)", mark(12, 0.95, predictedColour)});
    if (any([](const PricedScale* one) { return one->enough.has_value(); }))
        entries.push_back({format("nothing dearer is better by {:g} JOD", noticeableJod),
                           mark(5, 1.4, "#BFD4B6")});
    if (any([](const PricedScale* one) {
            return one->untold && (!one->enough || one->untold->technique < one->enough->technique);
        }))
        entries.push_back({"┊ nothing dearer is shown to be better", "textcolor rgb '#2E5723'"});
    double x = 0.1, y = 0.13;
    for (KeyLine& entry : entries) {
        const double across = widthOf(entry.text) * 8 / 7 + 0.42;
        if (x > 0.1 && x + across > width) {
            x = 0.1;
            y += entryHeight;
        }
        entry.x = x + 0.08;
        entry.y = y;
        x += across;
    }
    return entries;
}

std::string keyScript(const std::vector<KeyLine>& key, double width, double height) {
    std::string script;
    for (const KeyLine& entry : key)
        script +=
            format("set label {} at screen {:.5f}, screen {:.5f} offset char 1.2, 0 {}\n",
                   gnuplotText(entry.text), entry.x / width, 1 - entry.y / height, entry.mark);
    return script;
}

} // namespace

Figure priceChart(const Findings& findings, const std::vector<const PricedScale*>& scales,
                  const std::string& name, const std::string& heading, const PriceLayout& layout) {
    const double column = layout.width / static_cast<double>(layout.columns);
    const double plotWidth = column - left - right;
    const std::size_t rows = (scales.size() + layout.columns - 1) / layout.columns;
    const bool hasTitles = scales.size() > 1 || !scales.front()->group.isPooled();
    const double above = hasTitles ? title : 0.06;
    const std::vector<KeyLine> key = keyOf(scales, layout.width);
    const double head = key.back().y + entryHeight;
    const double height = head + static_cast<double>(rows) * (above + layout.plotHeight + below);
    const PriceAxes axes(scales, plotWidth, layout.plotHeight, 0.24);
    Figure figure{name, heading, {}, layout.width, height};
    figure.script =
        plot::style + format("set minussign\nset bars 0\nunset key\nset grid noxtics ytics\n"
                             "set xlabel 'milliseconds' offset 0, 0.1\nset multiplot\n");
    // Below all else: a picture of its own.
    if (const std::string stamp = stampScript(findings, layout.width, height); !stamp.empty())
        figure.script += stamp + "unset border\nunset tics\nset xlabel ' '\nplot [0:1] [0:1] NaN "
                                 "notitle\nset border 3\nset xlabel 'milliseconds'\n";
    for (std::size_t i = 0; i < scales.size(); ++i) {
        const double x = column * static_cast<double>(i % layout.columns);
        const double top =
            height - head -
            static_cast<double>(i / layout.columns) * (above + layout.plotHeight + below) - above;
        figure.script +=
            format("unset label\nunset arrow\nunset object\nset lmargin at screen {:.5f}\n"
                   "set rmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n"
                   "set bmargin at screen {:.5f}\n",
                   (x + left) / layout.width, (x + left + plotWidth) / layout.width, top / height,
                   (top - layout.plotHeight) / height);
        figure.script +=
            format("set label {} at screen {:.5f}, screen {:.5f} center rotate by 90\n",
                   gnuplotText(scales[i]->isTraced ? "JOD (0: like ray-traced)"
                                                   : "JOD (0: like the dearest)"),
                   (x + 0.12) / layout.width, (top - layout.plotHeight / 2) / height);
        if (hasTitles)
            figure.script += format("set label {} at screen {:.5f}, screen {:.5f}\n",
                                    gnuplotBold(panelTitle(scales[i]->group)),
                                    (x + 0.1) / layout.width, (top + 0.13) / height);
        if (i == 0)
            figure.script += keyScript(key, layout.width, height);
        figure.script += chartScript(*scales[i], axes, i);
    }
    figure.script += "unset multiplot\n";
    return figure;
}

} // namespace obscura
