#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace obscura {

// Rows from top to bottom.
using Plane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Row = Eigen::Array<float, 1, Eigen::Dynamic>;

// Burt and Adelson's pyramids ("The Laplacian Pyramid as a Compact Image Code", 1983; a = 0.4) as
// ColorVideoVDP has them.

// Half as many pixels each way, rounded up. Borders are mirrored, the edge pixel repeated, except
// that the right one follows, as in the authors' program, the parity of the number of rows: where
// that is not the columns' own, it is a little too dark or too bright.
Plane reduced(const Plane& level);

// Row `y`, of `width` pixels, of a level as the next coarser one has it.
void expandRow(const Plane& coarser, int width, int y, Row& row);

} // namespace obscura
