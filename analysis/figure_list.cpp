#include "analysis/figure_list.h"

#include "analysis/people_figures.h"
#include "analysis/prices/price_figure.h"
#include "analysis/scales/scale_figures.h"

#include <iterator>
#include <utility>

namespace obscura {

namespace {

using FiguresOf = std::vector<StudyFigure> (*)(const Findings&);
std::vector<StudyFigure> usableScales(const Findings& findings) {
    return isUnusable(findings) ? std::vector<StudyFigure>() : scaleFigures(findings);
}

std::vector<StudyFigure> usablePrices(const Findings& findings) {
    return isUnusable(findings) ? std::vector<StudyFigure>() : priceFigures(findings);
}

constexpr FiguresOf figureKinds[] = {usablePrices, sharesFigures, usableScales, positionFigures,
                                     powerFigures, flowFigures,   timesFigures, timingFigures};

} // namespace

std::vector<StudyFigure> figuresOf(const Findings& findings) {
    std::vector<StudyFigure> figures;
    for (const FiguresOf& kind : figureKinds) {
        std::vector<StudyFigure> some = kind(findings);
        std::move(some.begin(), some.end(), std::back_inserter(figures));
    }
    return figures;
}

} // namespace obscura
