#include "inference/psychometric_likelihood.h"

#include "inference/link.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

CurvePoint curvePoint(Sigmoid curve, double z) {
    if (curve != Sigmoid::weibull) {
        const Distribution at = distribution(
            curve == Sigmoid::logistic ? Link::logit : Link::probit, std::clamp(z, -1e6, 1e6));
        return {at.below, at.above, at.density};
    }
    const double rate = std::exp(std::clamp(z, -700.0, 6.5)); // exp(-exp(6.5)) = 1e-289
    return {-std::expm1(-rate), std::exp(-rate), rate * std::exp(-rate)};
}

PsychometricLikelihood::PsychometricLikelihood(const PsychometricData& data,
                                               const PsychometricModel& model)
    : data_(data), model_(model), locations_(data.level.size()) {
    for (Index i = 0; i < locations_.size(); ++i)
        locations_[i] = location(model.curve, data.level[i]);
    // A level of 0 of the weibull says nothing of where the curve rises.
    double lowest = std::numeric_limits<double>::max();
    for (Index i = 0; i < locations_.size(); ++i)
        if (model.curve != Sigmoid::weibull || data.level[i] > 0)
            lowest = std::min(lowest, locations_[i]);
    highest_ = locations_.maxCoeff();
    spread_ = std::max(highest_ - lowest, 1e-6);
}

double location(Sigmoid curve, double level) {
    return curve == Sigmoid::weibull ? std::log(std::max(level, 1e-300)) : level;
}

double PsychometricLikelihood::operator()(const VectorXd& x, VectorXd& gradient) const {
    gradient.setZero(size());
    const Psychometric at = parameters(x);
    const double slope = std::exp(x[1]), height = 1 - model_.guess - at.lapse;
    // Steeper, flatter or further off than this the levels cannot tell; the climb must not leave
    // for infinity.
    const double reach = 20 * spread_;
    if (!x.allFinite() || slope * spread_ > 1e4 || slope * spread_ < 1e-4 ||
        x[0] > highest_ + reach || x[0] < highest_ - spread_ - reach)
        return -std::numeric_limits<double>::infinity();
    double sum = 0, byLapse = 0;
    for (Index i = 0; i < locations_.size(); ++i) {
        const double z = slope * (locations_[i] - x[0]);
        const CurvePoint point = curvePoint(model_.curve, z);
        const double p = std::max(model_.guess + height * point.below, 1e-300);
        const double q = std::max(at.lapse + height * point.above, 1e-300);
        const double k = data_.successes[i], misses = data_.trials[i] - k;
        sum += k * std::log(p) + misses * std::log(q);
        const double byP = k / p - misses / q, byZ = byP * height * point.density;
        gradient[0] -= byZ * slope;
        gradient[1] += byZ * z;
        byLapse -= byP * point.below;
    }
    if (!model_.lapse)
        gradient[2] = byLapse * largestLapse * std::sin(x[2]) / 2;
    return sum;
}

Psychometric PsychometricLikelihood::parameters(const VectorXd& x) const {
    return {.threshold = model_.curve == Sigmoid::weibull ? std::exp(x[0]) : x[0],
            .slope = std::exp(x[1]),
            .lapse = model_.lapse ? *model_.lapse : largestLapse * (1 - std::cos(x[2])) / 2};
}

VectorXd PsychometricLikelihood::coordinates(const Psychometric& parameters) const {
    VectorXd x(size());
    x[0] = location(model_.curve, parameters.threshold);
    x[1] = std::log(parameters.slope);
    if (!model_.lapse)
        x[2] = std::acos(std::clamp(1 - 2 * parameters.lapse / largestLapse, -1.0, 1.0));
    return x;
}

MatrixXd PsychometricLikelihood::scales() const {
    const double trials = std::max(data_.trials.sum(), 1.0);
    VectorXd variances = VectorXd::Constant(size(), 10 / trials);
    variances[0] *= spread_ * spread_;
    return variances.asDiagonal();
}

// Where the middle of the levels is steep the likelihood has several hills; nine starts find the
// highest.
Maximum PsychometricLikelihood::best() const {
    const double low = highest_ - spread_;
    Maximum best;
    for (const double place : {0.25, 0.5, 0.75})
        for (const double steepness : {1.5, 5.0, 16.0}) {
            VectorXd start = VectorXd::Constant(size(), 0.9);
            start[0] = low + place * spread_;
            start[1] = std::log(steepness / spread_);
            const Maximum found = maximise(*this, start, scales());
            const bool first = best.at.size() == 0;
            // A reached maximum is preferred to a climb that ended as high.
            if (first || found.value > best.value + 1e-9 ||
                (found.reached && !best.reached && found.value > best.value - 1e-9))
                best = found;
        }
    return best;
}

Maximum PsychometricLikelihood::bestWith(Index fixed, double value, const VectorXd& start) const {
    const auto whole = [&](const VectorXd& others) {
        VectorXd x(size());
        x << others.head(fixed), value, others.tail(size() - 1 - fixed);
        return x;
    };
    const auto without = [&](const VectorXd& x) {
        VectorXd others(size() - 1);
        others << x.head(fixed), x.tail(size() - 1 - fixed);
        return others;
    };
    // At a bound of the lapse rate its slope in t is zero, and a climb that starts there stays.
    VectorXd inner = start;
    if (!model_.lapse)
        inner[2] = std::clamp(inner[2], 0.5, 2.6);
    const VectorXd variances = scales().diagonal();
    Maximum best = maximise(
        [&](const VectorXd& others, VectorXd& gradient) {
            VectorXd full(size());
            const double height = (*this)(whole(others), full);
            gradient = without(full);
            return height;
        },
        without(inner), without(variances).asDiagonal());
    best.at = whole(best.at);
    return best;
}

} // namespace obscura
