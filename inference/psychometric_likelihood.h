#pragma once

#include "inference/optimise.h"
#include "inference/psychometric_model.h"

namespace obscura {

// Largest lapse rate that is fitted: beyond it the person did not do the task (Wichmann and Hill
// take 0.06, psignifit and others 0.1).
inline constexpr double largestLapse = 0.1;

// The coordinate in which a curve is shifted and stretched: the level, or its logarithm (weibull).
double location(Sigmoid curve, double level);

// The likelihood in coordinates without bounds: location (of the weibull: log threshold), log
// slope, and, where the lapse is fitted, t with lapse = largestLapse (1 - cos t) / 2.
class PsychometricLikelihood {
  public:
    PsychometricLikelihood(const PsychometricData& data, const PsychometricModel& model);

    Eigen::Index size() const { return model_.lapse ? 2 : 3; }
    // Without binomial coefficients, with gradient.
    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const;
    Psychometric parameters(const Eigen::VectorXd& x) const;
    Eigen::VectorXd coordinates(const Psychometric& parameters) const;
    // The best of several climbs; with `fixed` >= 0 that coordinate stays at `value`, and the climb
    // starts at `start`.
    Maximum best() const;
    Maximum bestWith(Eigen::Index fixed, double value, const Eigen::VectorXd& start) const;

    double spread() const { return spread_; } // of the levels' locations

  private:
    Eigen::MatrixXd scales() const;

    const PsychometricData& data_;
    PsychometricModel model_;
    Eigen::VectorXd locations_;
    double highest_ = 0, spread_ = 1;
};

// Distribution function of a standardised level; 1 - F without cancellation; density.
struct CurvePoint {
    double below, above, density;
};
CurvePoint curvePoint(Sigmoid curve, double z);

} // namespace obscura
