#include "analysis/figure_list.h"

#include "analysis/people_figures.h"

#include <iterator>
#include <utility>

namespace obscura {

namespace {

using FiguresOf = std::vector<StudyFigure> (*)(const Findings&);
constexpr FiguresOf kinds[] = {sharesFigures, positionFigures, powerFigures,
                               flowFigures,   timesFigures,    timingFigures};

} // namespace

std::vector<StudyFigure> figuresOf(const Findings& findings) {
    std::vector<StudyFigure> figures;
    for (const FiguresOf& kind : kinds) {
        std::vector<StudyFigure> some = kind(findings);
        std::move(some.begin(), some.end(), std::back_inserter(figures));
    }
    return figures;
}

} // namespace obscura
