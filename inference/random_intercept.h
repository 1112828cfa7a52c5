#pragma once

#include "inference/optimise.h"
#include <Eigen/Core>

#include <vector>

namespace obscura {

// Beyond this standard deviation a person's answers are certain, for any link: the best one is
// infinite.
inline constexpr double largestSd = 100;

// One person's rows as a function of a shift v of all their linear predictors; sums over the rows
// of log-likelihood, its first two derivatives by v, the information by which quadrature is scaled
// (observed or expected) and that information's derivative.
struct ShiftedRows {
    double value = 0, slope = 0, curvature = 0, information = 0, informationSlope = 0;
};

// How the gradient by the parameters is put together from parts of one person's rows: the mean of
// the slopes over the nodes, by `shares`, plus parts at the mode.
struct GradientParts {
    const Eigen::ArrayXd& shifts; // nodes
    const Eigen::ArrayXd& shares; // posterior weights of the nodes, of sum 1
    double mode;                  // shift of the mode
    double ofSlope;               // weight of d slope(mode) / d parameters
    double ofInformation;         // weight of d information(mode) / d parameters
};

// A model whose rows depend on a person's shift. The log-likelihood of a person must be concave in
// the shift, as it is for logit and probit.
class ShiftedModel {
  public:
    virtual ~ShiftedModel() = default;
    virtual int persons() const = 0;
    // New parameters; false if they are outside the domain.
    virtual bool setParameters(const Eigen::VectorXd& parameters) = 0;
    virtual ShiftedRows at(int person, double shift) const = 0;
    virtual void atNodes(int person, const Eigen::ArrayXd& shifts, Eigen::ArrayXd& values,
                         Eigen::ArrayXd& slopes) = 0;
    // Follows atNodes() of the same person and shifts.
    virtual void addGradient(int person, const GradientParts& parts, Eigen::VectorXd& gradient) = 0;
};

// Log-likelihood of a model with a normal random intercept of standard deviation `sd` for each
// person, integrated by adaptive Gauss-Hermite quadrature about each person's mode (Pinheiro and
// Bates, J. Comput. Graph. Stat. 4 (1995) 12); one point is Laplace's approximation. The gradient
// is exactly that of the approximation: it includes how modes and scales move with the parameters.
// The likelihood of -sd is that of sd, so `sd` needs no bound.
class RandomIntercept {
  public:
    RandomIntercept(ShiftedModel& model, int points);

    // The last element of `parameters` is sd; the others are the model's.
    double operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& gradient);

    // Each person's most likely intercept at the last parameters, in predictor units.
    Eigen::VectorXd modes(double sd) const;

  private:
    double person(int index, double sd, Eigen::VectorXd& gradient);

    ShiftedModel& model_;
    Quadrature rule_;
    std::vector<double> modes_; // of the standardised intercept; the next search starts here
    Eigen::ArrayXd logWeights_, standard_, shifts_, values_, slopes_, shares_, pulls_;
};

} // namespace obscura
