#pragma once

#include "analysis/figures.h"
#include "analysis/prices/prices.h"

#include <string>
#include <vector>

namespace obscura {

struct PriceLayout {
    double width = wideFigure; // inches
    std::size_t columns = 1;
    double plotHeight = 2.6;
};

// A panel for each of `scales` (one or more), on axes that all share: milliseconds against JOD.
Figure priceChart(const Findings& findings, const std::vector<const PricedScale*>& scales,
                  const std::string& name, const std::string& heading, const PriceLayout& layout);

} // namespace obscura
