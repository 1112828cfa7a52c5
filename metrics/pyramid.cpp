#include "metrics/pyramid.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace obscura {

namespace {

constexpr float edge = 0.05F, near = 0.25F, middle = 0.4F;

// The pixel that stands beyond the border: -1 is 0, -2 is 1, `count` is the last.
int mirrored(int index, int count) {
    const int inside = index < 0 ? -1 - index : index < count ? index : 2 * count - 1 - index;
    return std::clamp(inside, 0, count - 1);
}

} // namespace

Plane reduced(const Plane& level) {
    const int rows = static_cast<int>(level.rows()), columns = static_cast<int>(level.cols());
    Plane result((rows + 1) / 2, (columns + 1) / 2);
    const int width = static_cast<int>(result.cols());
    forEachInParallel(static_cast<int>(result.rows()), [&](int y) {
        const auto row = [&](int offset) { return level.row(mirrored(2 * y + offset, rows)); };
        Row padded = Row::Zero(columns + 5); // two before, at most three behind
        padded.segment(2, columns) =
            edge * (row(-2) + row(2)) + near * (row(-1) + row(1)) + middle * row(0);
        padded[1] = padded[2];
        padded[0] = padded[2 + mirrored(-2, columns)];
        const float *in = padded.data(), last = in[columns + 1], lastButOne = in[columns];
        float* out = &result(y, 0);
        for (int x = 0; x < width; ++x)
            out[x] = edge * (in[2 * x] + in[2 * x + 4]) + near * (in[2 * x + 1] + in[2 * x + 3]) +
                     middle * in[2 * x + 2];
        out[width - 1] += rows % 2 ? near * last + edge * lastButOne : edge * last;
    });
    return result;
}

void expandRow(const Plane& coarser, int width, int y, Row& row) {
    const int rows = static_cast<int>(coarser.rows()), columns = static_cast<int>(coarser.cols());
    assert(y < 2 * rows && columns == (width + 1) / 2);
    const auto nearest = [&](int i) { return coarser.row(std::clamp(i, 0, rows - 1)); };
    Row padded(columns + 2);
    if (y % 2)
        padded.segment(1, columns) = 2 * near * (nearest(y / 2) + nearest(y / 2 + 1));
    else
        padded.segment(1, columns) =
            2 * edge * (nearest(y / 2 - 1) + nearest(y / 2 + 1)) + 2 * middle * nearest(y / 2);
    padded[0] = padded[1];
    padded[columns + 1] = padded[columns];
    row.resize(width);
    const float* in = padded.data() + 1;
    float* out = row.data();
    const int pairs = width / 2;
    for (int x = 0; x < pairs; ++x) {
        out[2 * x] = 2 * edge * (in[x - 1] + in[x + 1]) + 2 * middle * in[x];
        out[2 * x + 1] = 2 * near * (in[x] + in[x + 1]);
    }
    if (width % 2)
        out[width - 1] = 2 * edge * (in[pairs - 1] + in[pairs + 1]) + 2 * middle * in[pairs];
}

} // namespace obscura
