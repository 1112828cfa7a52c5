#pragma once

#include "analysis/prices/prices.h"
#include "analysis/table.h"

#include <string>
#include <vector>

namespace obscura {

// As people read them: a line for each technique.
Table priceTable(const std::vector<const PricedScale*>& scales);

// As `obscura-bench choose --people` reads them (ladder.csv): a line for each technique of each
// scene and level whose tournament has `ray_traced`. `jod_people`, `low` and `high` are relative to
// that one; `jod_predicted` is against it, 10 for no difference. What is not known is empty. ""
// without any line.
std::string ladderCsv(const std::vector<PricedScale>& scales);

} // namespace obscura
