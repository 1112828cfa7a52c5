#include "analysis/prices/label_places.h"

#include <algorithm>
#include <array>

namespace obscura {

namespace {

double overlap(const Box& a, const Box& b) {
    const double across = std::min(a.right, b.right) - std::max(a.left, b.left);
    const double up = std::min(a.top, b.top) - std::max(a.bottom, b.bottom);
    return across > 0 && up > 0 ? across * up : 0;
}

double area(const Box& box) { return (box.right - box.left) * (box.top - box.bottom); }

// The best place first; above and below, a name moves into the frame.
std::array<Box, 8> candidates(const Named& point, const Box& frame) {
    const double gap = 0.4 * point.height, beside = 0.8 * point.height;
    const double middle = (point.low + point.high) / 2;
    const auto at = [&](double left, double bottom) {
        return Box{left, bottom, left + point.width, bottom + point.height};
    };
    const double right = point.x + beside, left = point.x - beside - point.width,
                 centre = std::max(frame.left,
                                   std::min(point.x - point.width / 2, frame.right - point.width)),
                 above = point.high + gap, below = point.low - gap - point.height;
    return {at(centre, above),
            at(centre, below),
            at(right, middle - point.height / 2),
            at(left, middle - point.height / 2),
            at(left, point.high - point.height),
            at(left, point.low),
            at(right, point.high - point.height),
            at(right, point.low)};
}

} // namespace

std::vector<Box> labelPlaces(const std::vector<Named>& points, const std::vector<Box>& taken,
                             const Box& frame) {
    std::vector<Box> covered = taken, places;
    for (const Named& point : points) {
        const double half = 0.35 * point.height; // of a mark
        covered.push_back({point.x - half, point.low - half, point.x + half, point.high + half});
    }
    for (const Named& point : points) {
        Box best;
        double least = 1e300;
        for (const Box& place : candidates(point, frame)) {
            double cost = 4 * (area(place) - overlap(place, frame)); // what is cut off
            for (const Box& box : covered)
                cost += overlap(place, box);
            if (cost < least) {
                least = cost;
                best = place;
            }
        }
        covered.push_back(best);
        places.push_back(best);
    }
    return places;
}

} // namespace obscura
