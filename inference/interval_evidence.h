#pragma once

#include "inference/link.h"

namespace obscura {

// log(F(upper) - F(lower)), the log-likelihood of a category between two thresholds, with its
// derivatives by both up to the third; u for upper, l for lower. An open end (the lowest or highest
// category) has no derivatives. Finite for every lower < upper.
struct IntervalEvidence {
    double value = 0;
    double u = 0, l = 0;
    double uu = 0, ul = 0, ll = 0;
    double uuu = 0, uul = 0, ull = 0, lll = 0;

    // A shift v of the predictor lowers both ends: derivatives by v.
    double byShift() const { return -(u + l); }
    double byShift2() const { return uu + 2 * ul + ll; }
    double byShift3() const { return -(uuu + 3 * uul + 3 * ull + lll); }
};
IntervalEvidence intervalEvidence(Link link, bool hasLower, double lower, bool hasUpper,
                                  double upper);

} // namespace obscura
