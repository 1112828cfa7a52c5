#include "analysis/figures.h"

#include "report/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

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
