#pragma once

#include "bench/sweep/row.h"
#include "report/paper_figure.h"

#include <vector>

namespace obscura {

// The page's charts for papers: how time and the error trade in each scene and resolution, matched
// RMSE and predicted JOD, and
// how cost grows.
std::vector<Figure> sweepFigures(const Sweep& sweep);

} // namespace obscura
