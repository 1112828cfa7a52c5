#pragma once

#include "bench/sweep/row.h"
#include "report/paper_figure.h"

#include <vector>

namespace obscura {

// The page's charts for papers: how time and matched RMSE trade in each scene and resolution, and
// how cost grows.
std::vector<Figure> sweepFigures(const Sweep& sweep);

} // namespace obscura
