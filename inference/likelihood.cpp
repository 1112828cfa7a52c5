#include "inference/likelihood.h"

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

// Phi(x) / phi(x) for x <= -10: the continued fraction of Mills' ratio (Abramowitz and Stegun
// 26.2.14), of which 30 levels are exact there to the last bit.
double millsRatio(double x) {
    double tail = -x;
    for (int level = 30; level > 0; --level)
        tail = -x + level / tail;
    return 1 / tail;
}

double normalDensity(double x) {
    return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
}

LogProbability logNormal(double x) {
    if (x > -10) {
        const double p = std::erfc(-x / std::numbers::sqrt2) / 2;
        const double value = x > 0 ? std::log1p(-std::erfc(x / std::numbers::sqrt2) / 2)
                                   : std::log(p);
        const double ratio = normalDensity(x) / p;
        return {value, ratio, -ratio * (x + ratio)};
    }
    const double ratio = 1 / millsRatio(x); // phi / Phi
    // x + ratio, without cancellation: the ratio is -x + 1 / (the next level).
    double next = -x;
    for (int level = 30; level > 1; --level)
        next = -x + level / next;
    return {-x * x / 2 - std::log(std::sqrt(2 * std::numbers::pi) * ratio), ratio, -ratio / next};
}

LogProbability logLogistic(double x) {
    const double small = std::exp(-std::abs(x)), above = small / (1 + small);
    const double below = x > 0 ? above : 1 / (1 + small); // F(-x)
    return {std::min(x, 0.0) - std::log1p(small), below, -below * (x > 0 ? 1 / (1 + small) : above)};
}

} // namespace

LogProbability logProbabilityWithDerivatives(Noise noise, double x) {
    return noise == Noise::normal ? logNormal(x) : logLogistic(x);
}

double logProbability(Noise noise, double x) {
    return logProbabilityWithDerivatives(noise, x).value;
}

double probability(Noise noise, double x) {
    if (noise == Noise::normal)
        return std::erfc(-x / std::numbers::sqrt2) / 2;
    return x > 0 ? 1 / (1 + std::exp(-x)) : std::exp(x) / (1 + std::exp(x));
}

double valueOf(const Predictor& predictor, const Eigen::VectorXd& parameters) {
    double value = 0;
    for (const Term& term : predictor)
        value += parameters(term.parameter) * term.factor;
    return value;
}

} // namespace obscura
