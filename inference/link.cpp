#include "inference/link.h"

#include <boost/math/constants/constants.hpp>
#include <boost/math/distributions/normal.hpp>

#include <cmath>

namespace obscura {

namespace {

constexpr double inverseRoot2Pi = boost::math::constants::one_div_root_two_pi<double>();
constexpr double rootHalf = boost::math::constants::one_div_root_two<double>();

Distribution logistic(double x) {
    const double small = std::exp(-std::abs(x)), near = 1 / (1 + small), far = small / (1 + small);
    Distribution at{};
    at.below = x < 0 ? far : near;
    at.above = x < 0 ? near : far;
    at.density = near * far;
    at.slope = at.density * (at.above - at.below);
    at.curvature = at.density * (1 - 6 * at.density);
    return at;
}

Distribution normal(double x) {
    Distribution at{};
    at.below = std::erfc(-x * rootHalf) / 2;
    at.above = std::erfc(x * rootHalf) / 2;
    at.density = inverseRoot2Pi * std::exp(-x * x / 2);
    at.slope = -x * at.density;
    at.curvature = (x * x - 1) * at.density;
    return at;
}

// Mills' ratio (1 - Phi(x)) / phi(x). Beyond 20 the first terms of the asymptotic series give it to
// 1e-13 (Abramowitz and Stegun 26.2.12), where erfc would soon underflow.
double mills(double x) {
    if (x < 20)
        return std::erfc(x * rootHalf) / (2 * inverseRoot2Pi * std::exp(-x * x / 2));
    const double r = 1 / (x * x);
    return (1 - r * (1 - 3 * r * (1 - 5 * r * (1 - 7 * r * (1 - 9 * r))))) / x;
}

double logNormalAbove(double x) {
    if (x < 5)
        return x < -5 ? std::log1p(-std::erfc(-x * rootHalf) / 2)
                      : std::log(std::erfc(x * rootHalf) / 2);
    return std::log(mills(x) * inverseRoot2Pi) - x * x / 2;
}

Evidence logisticEvidence(double x, double successes, double trials) {
    const Distribution at = logistic(x);
    const LogTails tails = logTails(Link::logit, x);
    const double failures = trials - successes;
    return {.value = successes * tails.below + failures * tails.above,
            .slope = successes * at.above - failures * at.below,
            .curvature = -trials * at.density,
            .information = trials * at.density,
            .informationSlope = trials * at.slope};
}

// With the hazards a = phi / Phi(x), b = phi / (1 - Phi(x)): a' = -a (x + a), b' = b (b - x), and
// the expected information of one trial is phi^2 / (Phi (1 - Phi)) = a b.
Evidence normalEvidence(double x, double successes, double trials) {
    const LogTails tails = logTails(Link::probit, x);
    const double a = x > 38 ? 0 : 1 / mills(-x), b = x < -38 ? 0 : 1 / mills(x);
    const double failures = trials - successes;
    Evidence of{};
    of.value = successes * tails.below + failures * tails.above;
    of.slope = successes * a - failures * b;
    of.curvature = -successes * a * (x + a) - failures * b * (b - x);
    of.information = trials * a * b;
    of.informationSlope = of.information * (b - a - 2 * x);
    return of;
}

} // namespace

Distribution distribution(Link link, double x) {
    return link == Link::logit ? logistic(x) : normal(x);
}

LogTails logTails(Link link, double x) {
    if (link == Link::probit)
        return {logNormalAbove(-x), logNormalAbove(x)};
    const double near = -std::log1p(std::exp(-std::abs(x))), far = near - std::abs(x);
    return x < 0 ? LogTails{far, near} : LogTails{near, far};
}

double quantile(Link link, double probability) {
    if (link == Link::logit)
        return std::log(probability) - std::log1p(-probability);
    return boost::math::quantile(boost::math::normal{}, probability);
}

Evidence evidence(Link link, double predictor, double successes, double trials) {
    return link == Link::logit ? logisticEvidence(predictor, successes, trials)
                               : normalEvidence(predictor, successes, trials);
}

} // namespace obscura
