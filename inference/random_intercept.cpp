#include "inference/random_intercept.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

// The zero of sd slope(sd u) - u, which falls in u: Newton's method within a bracket. From u with a
// positive value the zero lies between u and sd slope(sd u), and the other way round.
double modeOf(const ShiftedModel& model, int person, double sd, double u, ShiftedRows& rows) {
    double low = -std::numeric_limits<double>::max(), high = std::numeric_limits<double>::max();
    for (int i = 0; i < 200; ++i) {
        rows = model.at(person, sd * u);
        const double target = sd * rows.slope, excess = target - u;
        low = std::max(low, excess > 0 ? u : target);
        high = std::min(high, excess > 0 ? target : u);
        const double step = excess / (1 - sd * sd * rows.curvature);
        const double next = u + step;
        u = next > low && next < high ? next : (low + high) / 2;
        // The error of a Newton step is some square of it: the next u is right to 1e-14.
        if (std::abs(step) < 1e-8)
            break;
    }
    rows = model.at(person, sd * u);
    return u;
}

} // namespace

RandomIntercept::RandomIntercept(ShiftedModel& model, int points)
    : model_(model), rule_(gaussHermite(points)),
      modes_(static_cast<std::size_t>(model.persons()), 0.0),
      logWeights_(rule_.weights.log() + rule_.nodes.square() / 2) {}

double RandomIntercept::operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& gradient) {
    gradient.setZero(parameters.size());
    if (!model_.setParameters(parameters.head(parameters.size() - 1)))
        return -std::numeric_limits<double>::infinity();
    const double sd = parameters[parameters.size() - 1];
    double sum = 0;
    for (int i = 0; i < model_.persons(); ++i)
        sum += person(i, sd, gradient);
    return sum;
}

// With h(u) = S(sd u) - u^2 / 2, S the log-likelihood of the rows, u' its mode and
// s = (1 + sd^2 information(u'))^(-1/2): L = log s + log sum of weight exp(h(u) + z^2 / 2) over the
// nodes u = u' + s z. The derivatives of u' and s by the parameters follow from h'(u') = 0.
double RandomIntercept::person(int index, double sd, Eigen::VectorXd& gradient) {
    double& u = modes_[static_cast<std::size_t>(index)];
    ShiftedRows rows;
    u = modeOf(model_, index, sd, u, rows);
    const double scale = 1 / std::sqrt(1 + sd * sd * rows.information);
    standard_ = u + scale * rule_.nodes;
    shifts_ = sd * standard_;
    model_.atNodes(index, shifts_, values_, slopes_);

    shares_ = values_ - standard_.square() / 2 + logWeights_;
    const double largest = shares_.maxCoeff();
    shares_ = (shares_ - largest).exp();
    const double total = shares_.sum();
    shares_ /= total;

    pulls_ = shares_ * (sd * slopes_ - standard_); // share times h' at the nodes
    const double byMode = pulls_.sum();
    const double byScale = (pulls_ * rule_.nodes).sum() + 1 / scale;
    const double steepness = 1 - sd * sd * rows.curvature; // -h''(u')
    const double ofInformation = -byScale * scale * scale * scale * sd * sd / 2;
    const double ofMode = byMode + ofInformation * sd * rows.informationSlope;
    model_.addGradient(index,
                       {.shifts = shifts_,
                        .shares = shares_,
                        .mode = sd * u,
                        .ofSlope = ofMode * sd / steepness,
                        .ofInformation = ofInformation},
                       gradient);
    const double modeBySd = (rows.slope + sd * rows.curvature * u) / steepness;
    const double scaleBySd =
        -scale * scale * scale * (sd * rows.information + sd * sd * rows.informationSlope * u / 2);
    gradient[gradient.size() - 1] +=
        (shares_ * standard_ * slopes_).sum() + ofMode * modeBySd + byScale * scaleBySd;
    return largest + std::log(total) + std::log(scale);
}

Eigen::VectorXd RandomIntercept::modes(double sd) const {
    return sd * Eigen::VectorXd::Map(modes_.data(), static_cast<Eigen::Index>(modes_.size()));
}

} // namespace obscura
