#pragma once

#include "analysis/figures.h"
#include "analysis/table.h"

#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// What the report's page is made of.

// For pageHead(): light and dark, from wide screens to narrow ones, and paper.
extern const std::string_view reportStyle;

// In a box of its own that scrolls, and that the keyboard reaches, where the page is too narrow;
// `label` names it. The first cell heads its row; where it repeats the one above, it stands once
// for both. Rows for which `marked` holds are shaded.
std::string tableHtml(const Table& table, const std::string& label,
                      const std::vector<bool>& marked = {});

// With its id "figure-NAME", and a link to the table "numbers-NAME".
std::string figureHtml(const StudyFigure& figure, int number);

} // namespace obscura
