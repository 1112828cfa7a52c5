#include "analysis/prices/price_figure.h"

#include "analysis/prices/price_chart.h"
#include "analysis/prices/price_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

using fmt::format;

constexpr std::size_t mostCharts = 12;

std::string captionOf(const PricedScale& scale, const Manifest& stimuli) {
    std::string text = format(
        "People's JOD ({}; intervals: {}) less those of {}: 0 is like it, and at −1, 75 of 100 "
        "would "
        "choose it. Open marks: JOD as ColorVideoVDP predicts them. The line: techniques that "
        "people like better than all cheaper ones. Dashed: {:g} JOD below the reference, where 63 "
        "of 100 would choose it. Shaded, where there is such a place: from there on no interval of "
        "how much better a dearer technique is reaches {:g} JOD. Dotted: from there on nothing "
        "dearer is shown to be better.",
        scale.kind->source, scale.intervals,
        scale.isTraced ? "the ray-traced image" : "the dearest technique", noticeableJod,
        noticeableJod);
    if (stimuli.timing)
        text += format(" Milliseconds: {} ({}, {}).", stimuli.timing->method,
                       stimuli.timing->renderer, stimuli.timing->processor);
    if (stimuli.display)
        text += format(" Predicted on a display of {}.", inWords(*stimuli.display));
    for (const std::string& note : scale.notes)
        text += format(" To know: {}.", note);
    return text;
}

StudyFigure figureOf(const Findings& findings, const std::vector<const PricedScale*>& scales,
                     const std::string& name, const std::string& heading) {
    const bool isOne = scales.size() == 1;
    StudyFigure figure;
    figure.drawing = priceChart(findings, scales, name, heading,
                                {wideFigure, isOne ? 1u : 2u, isOne ? 3.3 : 2.5});
    figure.narrow = priceChart(findings, scales, name, heading, {narrowFigure, 1, 2.5});
    figure.caption = captionOf(*scales.front(), *findings.stimuli);
    figure.numbers = priceTable(scales);
    return figure;
}

} // namespace

std::vector<StudyFigure> priceFigures(const Findings& findings) {
    if (!findings.stimuli)
        return {};
    const std::vector<PricedScale> scales = pricedScales(findings.scales, *findings.stimuli);
    std::vector<StudyFigure> figures;
    std::vector<const PricedScale*> single, pooled;
    for (const PricedScale& scale : scales)
        if (scale.hasPrices())
            (scale.group.isPooled() ? pooled : single).push_back(&scale);
    if (single.size() > mostCharts)
        single.resize(mostCharts);
    if (!pooled.empty())
        figures.push_back(figureOf(findings, {pooled.front()}, "prices",
                                   "What milliseconds buy, over all scenes and levels"));
    if (!single.empty())
        figures.push_back(figureOf(findings, single, pooled.empty() ? "prices" : "prices-each",
                                   "What milliseconds buy, by scene and level"));
    if (!pooled.empty() && !single.empty())
        figures.back().caption = "As in the figure before, of each scene and level for itself, on "
                                 "axes that all share. Open marks: predicted JOD.";
    if (auto prediction = predictionFigure(findings, predictionOf(scales)))
        figures.push_back(std::move(*prediction));
    return figures;
}

} // namespace obscura
