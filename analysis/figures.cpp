#include "analysis/figures.h"

#include "report/gnuplot.h"

#include <fmt/format.h>

#include <iterator>

namespace obscura {

namespace {

using FiguresOf = std::vector<StudyFigure> (*)(const Findings&);
constexpr FiguresOf kinds[] = {sharesFigures, powerFigures, flowFigures, timingFigures};

} // namespace

std::vector<StudyFigure> figuresOf(const Findings& findings) {
    std::vector<StudyFigure> figures;
    for (const FiguresOf& kind : kinds) {
        std::vector<StudyFigure> some = kind(findings);
        std::move(some.begin(), some.end(), std::back_inserter(figures));
    }
    return figures;
}

std::string stampScript(const Findings& findings, double width) {
    if (stampOf(findings).empty())
        return {};
    return fmt::format("set label {} at screen 0.5, screen 0.5 center rotate by 15 back "
                       "font 'sans-serif,{:.0f}' textcolor rgb '#F3DACD'\n",
                       gnuplotBold(sourceOf(findings) + " DATA"), 4.5 * width);
}

} // namespace obscura
