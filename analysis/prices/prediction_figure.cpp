#include "analysis/prices/price_figure.h"
#include "analysis/prices/price_words.h"
#include "analysis/scales/scale_panels.h"
#include "analysis/scales/scale_words.h"
#include "report/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using fmt::format;

constexpr std::size_t mostPlaces = 12; // that have a mark of their own in the key

std::vector<std::string> placesOf(const Prediction& prediction) {
    std::vector<std::string> places;
    for (const PredictedPoint& point : prediction.points)
        if (places.empty() || places.back() != point.place)
            places.push_back(point.place);
    return places;
}

// "r = 0.83 (0.50 to 0.95)"
std::string correlationText(const char* symbol, const Correlation& one) {
    return format("{} = {}{}", symbol, spelt(one.value, 2),
                  one.interval ? format(" ({} to {})", spelt(one.interval->low, 2),
                                        spelt(one.interval->high, 2))
                               : "");
}

// Square, one scale for both axes, for both are JOD.
Figure draw(const Findings& findings, const Prediction& prediction, double inches, bool isNarrow) {
    const std::vector<std::string> places = placesOf(prediction);
    const std::size_t shown = places.size() <= mostPlaces ? places.size() : 0;
    double nameInches = 0;
    for (std::size_t i = 0; i < shown; ++i)
        nameInches = std::max(nameInches, 1.22 * textWidth(places[i]));
    const double left = 0.64, top = 0.1, below = 0.56, line = 0.19;
    const double key = isNarrow ? 0.15 : std::max(nameInches, 2.4) + 0.5;
    const double side = std::min(inches - left - key, 3.6);
    const double under = isNarrow ? line * static_cast<double>(shown + 5) : 0;
    const double height = top + side + below + under;
    double lowest = -0.5, highest = 0.5;
    for (const PredictedPoint& point : prediction.points) {
        lowest = std::min({lowest, point.predicted, point.people});
        highest = std::max({highest, point.predicted, point.people});
    }
    const double margin = 0.08 * (highest - lowest);
    lowest -= margin;
    highest += margin;
    std::string blocks;
    std::vector<std::string> plots;
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::string lines;
        for (const PredictedPoint& point : prediction.points)
            if (point.place == places[i])
                lines += format("{} {} {} {}\n", point.predicted, point.people,
                                std::max(lowest, point.interval.low.value_or(point.people)),
                                std::min(highest, point.interval.high.value_or(point.people)));
        blocks += plot::block(format("place{}", i), lines);
        plots.push_back(format("$place{} using 1:2:3:4 with yerrorbars linewidth 1.2 {} notitle", i,
                               plot::pointStyle(shown > 0 ? i : 0)));
    }
    // The key, from its upper left corner on.
    const double x = isNarrow ? 0.2 : left + side + 0.3;
    double y = isNarrow ? top + side + below + 0.12 : top + 0.1;
    std::string labels;
    const auto write = [&](const std::string& text, const std::string& mark) {
        labels +=
            format("set label {} at screen {:.5f}, screen {:.5f} offset char {}, 0 {}\n",
                   gnuplotText(text), x / inches, 1 - y / height, mark.empty() ? 0 : 1.2, mark);
        y += line;
    };
    for (std::size_t i = 0; i < shown; ++i)
        write(places[i], "point " + plot::pointStyle(i));
    y += 0.08;
    if (prediction.line && prediction.ranks) {
        write(correlationText("Pearson's r", *prediction.line), "");
        write(correlationText("Spearman's ρ", *prediction.ranks), "");
        write(format("n = {} techniques", prediction.points.size()), "");
        write(format("the best such metrics: about {:g}", bestCorrelation), "");
    }
    Figure figure{"predicted", "Predicted differences against those of people", {}, inches, height};
    figure.script =
        plot::style + blocks +
        format("set minussign\nset bars 0\nunset key\nset lmargin at screen {:.5f}\n"
               "set rmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n"
               "set bmargin at screen {:.5f}\nset xrange [{}:{}]\nset yrange [{}:{}]\n"
               "set xtics nomirror out {}\nset ytics nomirror out {}\n"
               "set xlabel 'predicted JOD, less the reference' offset 0, 0.1\n"
               "set ylabel 'JOD of people, less the reference' offset 0.3, 0\n"
               "set arrow from {} , {} to {}, {} nohead back linewidth 1 dashtype 2 linecolor rgb "
               "'#777777'\n",
               left / inches, (left + side) / inches, 1 - top / height, (below + under) / height,
               lowest, highest, lowest, highest, tickStep(highest - lowest),
               tickStep(highest - lowest), lowest, lowest, highest, highest) +
        stampScript(findings, inches, height) + labels + "plot " + plot::list(plots) + "\n";
    return figure;
}

Table numbersOf(const Prediction& prediction) {
    Table table{{{"Where"},
                 {"Technique"},
                 {"Predicted JOD", true},
                 {"JOD of people", true},
                 {"95 %", true}},
                {}};
    for (const PredictedPoint& point : prediction.points)
        table.rows.push_back({point.place, point.name, spelt(point.predicted, 2),
                              spelt(point.people, 2), spelt(point.interval, 2)});
    return table;
}

} // namespace

std::optional<StudyFigure> predictionFigure(const Findings& findings,
                                            const Prediction& prediction) {
    if (!prediction.line)
        return std::nullopt;
    StudyFigure figure;
    figure.drawing = draw(findings, prediction, wideFigure, false);
    figure.narrow = draw(findings, prediction, narrowFigure, true);
    figure.caption =
        "Each technique of each scene and level but the reference, with the 95 % interval of "
        "people's JOD. On the dashed line people see what ColorVideoVDP predicts. " +
        predictionSentence(prediction);
    figure.numbers = numbersOf(prediction);
    return figure;
}

} // namespace obscura
