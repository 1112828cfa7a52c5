#pragma once

#include <vector>

namespace obscura {

// Where names stand beside their points, so that nothing is printed over. All lengths are of one
// unit; y points up.
struct Box {
    double left = 0, bottom = 0, right = 0, top = 0;
};
struct Named {
    double x = 0, low = 0, high = 0; // a mark, or a bar of that height
    double width = 0, height = 0;    // of the name
};

// The names' boxes, in the order of the points: at the right or left, above or below, wherever they
// cover least of the bars, of `taken`, and of the names before them; within the frame.
std::vector<Box> labelPlaces(const std::vector<Named>& points, const std::vector<Box>& taken,
                             const Box& frame);

} // namespace obscura
