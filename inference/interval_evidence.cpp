#include "inference/interval_evidence.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

// Of one end of the interval: density, slope and curvature of F over the interval's probability.
struct End {
    double first = 0, second = 0, third = 0;
};

End over(const Distribution& at, double probability) {
    return {at.density / probability, at.slope / probability, at.curvature / probability};
}

} // namespace

// With P = F(upper) - F(lower) and p the derivatives of P over P: those of log P are the cumulants
// of the p: p2 - p1 p1, p3 - 3 p1 p2 + 2 p1^3, and so on. Mixed derivatives of P are zero.
IntervalEvidence intervalEvidence(Link link, bool hasLower, double lower, bool hasUpper,
                                  double upper) {
    // Beyond these the probability underflows, and the derivatives with it.
    const double limit = link == Link::logit ? 700 : 37;
    const Distribution below = distribution(link, std::clamp(lower, -limit, limit));
    const Distribution above = distribution(link, std::clamp(upper, -limit, limit));
    double probability = 1;
    if (hasLower && hasUpper)
        probability = lower > 0 ? below.above - above.above : above.below - below.below;
    else if (hasUpper)
        probability = above.below;
    else if (hasLower)
        probability = below.above;
    probability = std::max(probability, 1e-305);

    const End a = hasUpper ? over(above, probability) : End{};
    End b = hasLower ? over(below, probability) : End{};
    b = {-b.first, -b.second, -b.third};
    IntervalEvidence of;
    of.value = std::log(probability);
    of.u = a.first;
    of.l = b.first;
    of.uu = a.second - a.first * a.first;
    of.ul = -a.first * b.first;
    of.ll = b.second - b.first * b.first;
    of.uuu = a.third - 3 * a.first * a.second + 2 * a.first * a.first * a.first;
    of.uul = -a.second * b.first + 2 * a.first * a.first * b.first;
    of.ull = -a.first * b.second + 2 * a.first * b.first * b.first;
    of.lll = b.third - 3 * b.first * b.second + 2 * b.first * b.first * b.first;
    return of;
}

} // namespace obscura
