#pragma once

#include "bench/paper_figure.h"
#include "bench/sweep_row.h"

#include <vector>

namespace obscura {

// The page's charts for papers: how time and matched RMSE trade in each scene and resolution, and
// how cost grows.
std::vector<Figure> sweepFigures(const Sweep& sweep);

} // namespace obscura
