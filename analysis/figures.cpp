#include "analysis/figures.h"

#include "analysis/people_figures.h"
#include "report/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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

std::string stampScript(const Findings& findings, double width, double height) {
    if (stampOf(findings).empty())
        return {};
    const bool isFlat = height < 0.3 * width;
    return fmt::format("set label {} at screen 0.5, screen 0.5 center rotate by {} back "
                       "font 'sans-serif,{:.0f}' textcolor rgb '#F3DACD'\n",
                       gnuplotBold(sourceOf(findings) + " DATA"), isFlat ? 0 : 15,
                       std::min(4.5 * width, 20 * height));
}

} // namespace obscura
