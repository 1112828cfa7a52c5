#include "analysis/scales/scale_panels.h"

#include "analysis/scales/scale_words.h"
#include "report/gnuplot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace obscura {

using fmt::format;

std::string panelTitle(const ScaleGroup& group) {
    ScaleGroup place = group;
    place.question.clear();
    return placeOf(place);
}

double tickStep(double range) {
    const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (rough <= factor * power)
            return factor * power;
    return 10 * power;
}

std::vector<std::string> techniquesOf(const ScaleResults& results) {
    std::vector<std::string> names;
    for (const ScaleResult* result : results)
        for (const ScaleItem& item : result->items)
            if (std::find(names.begin(), names.end(), item.name) == names.end())
                names.push_back(item.name);
    return names;
}

double nameWidth(const std::vector<std::string>& names) {
    double width = 0.4;
    for (const std::string& name : names)
        width = std::max(width, textWidth(name));
    return std::min(width, 1.6) + 0.22;
}

double heightOf(const std::vector<std::size_t>& order) {
    return 0.23 * static_cast<double>(order.size()) + 0.06;
}

std::string rowTicks(const ScaleResult& result, const std::vector<std::size_t>& order) {
    std::vector<std::string> ticks;
    for (std::size_t row = 0; row < order.size(); ++row)
        ticks.push_back(format("{} {}", gnuplotText(result.items[order[row]].name), row));
    return format("set yrange [-0.6:{}]\nset ytics nomirror scale 0 ({})\n",
                  static_cast<double>(order.size()) - 0.4, fmt::join(ticks, ", "));
}

} // namespace obscura
