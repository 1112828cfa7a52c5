#include "analysis/scales/psychometric_figure.h"

#include "analysis/scales/scale_words.h"
#include "report/gnuplot.h"
#include "report/paper_figure.h"

#include "inference/counts.h"
#include "inference/psychometric.h"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using fmt::format;

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

// Choices between two that the metric itself predicts: 1 JOD is 75 of 100.
bool hasPrediction(const Ladder& ladder) { return ladder.isPredicted && ladder.guess == 0; }

Panel curvePanel(const ScaleResult& result, std::size_t index, std::string& blocks) {
    const auto& [ladder, model, parameters] = *result.curve;
    Panel panel{panelTitle(result.group), {}, 1.9};
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
        const Interval interval = wilson(std::llround(successes), std::llround(trials));
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
    // A threshold beyond the picture is drawn outside of it, with its bar, where nobody sees it.
    const bool isSeen = threshold.value >= left && threshold.value <= right;
    const std::string name = format("panel{}", index);
    blocks += plot::block(name + "points", points) + plot::block(name + "curve", curve) +
              plot::block(name + "threshold",
                          isSeen ? format("{} {} {} {}\n", threshold.value, half, low, high)
                                 : format("{0} {1} {0} {0}\n", left - 9 * (right - left), half));
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
    if (isSeen)
        panel.script += format(
            "set arrow from first {0}, graph 0 to first {0}, first {1} nohead linewidth 1 dashtype "
            "2 "
            "linecolor rgb '#D55E00'\n"
            "set label {2} at first {0}, graph 0 {3} offset {4}, 0.7 font ',7' textcolor rgb "
            "'#B33A00'\n",
            threshold.value, half,
            gnuplotText(format("{:.0f} %: {}{:.3g} ({})", 100 * half, ladder.isOrder ? "step " : "",
                               threshold.value, spelt(threshold.interval, 3))),
            isRight ? "right" : "left", isRight ? -0.7 : 0.7);
    panel.script +=
        format("plot {} with lines linewidth 1 dashtype 3 linecolor rgb '{}' notitle, \\\n"
               "  ${}curve with lines linewidth 2 linecolor rgb '#0072B2' notitle, \\\n"
               "  ${}threshold using 1:2:3:4 with xerrorbars linewidth 3 pointtype 7 pointsize 0.1 "
               "linecolor rgb '#D55E00' notitle, \\\n"
               "  ${}points using 1:2:3:4 with yerrorbars linewidth 1 pointtype 7 pointsize 0.1 "
               "linecolor rgb '#000000' notitle, \\\n"
               "  ${}points using 1:2:5 with points pointtype 7 pointsize variable linecolor rgb "
               "'#000000' notitle",
               model.guess, scaleGrey, name, name, name, name);
    if (hasPrediction(ladder))
        panel.script += format(", \\\n  norm({} * x) with lines linewidth 1 dashtype 4 linecolor "
                               "rgb '#B35900' notitle",
                               jodUnit);
    panel.script += "\n";
    return panel;
}

} // namespace

StudyFigure psychometricFigure(const ScaleKind& kind, const ScaleResults& results,
                               const std::string& name, const std::string& stamp) {
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
                {panelTitle(results[i]->group), ladder.labels[static_cast<std::size_t>(k)],
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
    figure.drawing = {name,
                      first.isOrder ? std::string(kind.heading)
                                    : format("{} of the {}", kind.heading, first.axis),
                      made.script, made.width, made.height};
    figure.caption = format(
        "{} ({}): share of {} with Wilson's 95 % intervals, larger for more answers; the fitted "
        "curve; in orange its threshold with the 95 % interval ({}). Dotted: what guessing "
        "gives.{}",
        kind.heading, kind.source, first.success, results.front()->intervals,
        hasPrediction(first) ? " Thin and brown: how often people would choose b if 1 predicted "
                               "JOD were 1 of theirs."
                             : "");
    return figure;
}

} // namespace obscura
