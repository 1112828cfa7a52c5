#include "inference/ordinal_rows.h"

#include <limits>

namespace obscura {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

bool OrdinalRows::setParameters(const VectorXd& parameters) {
    parameters_ = parameters;
    for (Index i = 1; i < thresholds_; ++i)
        if (!(parameters[i] > parameters[i - 1]))
            return false;
    predictor_ = data_.design * parameters.tail(data_.design.cols());
    return predictor_.allFinite();
}

ShiftedRows OrdinalRows::at(int person, double shift) const {
    ShiftedRows sums;
    for (Index i = first(person); i < first(person + 1); ++i) {
        const IntervalEvidence of = evidenceOf(row(i), shift);
        sums.value += of.value;
        sums.slope += of.byShift();
        sums.curvature += of.byShift2();
        sums.informationSlope -= of.byShift3();
    }
    sums.information = -sums.curvature;
    return sums;
}

void OrdinalRows::atNodes(int person, const ArrayXd& shifts, ArrayXd& values, ArrayXd& slopes) {
    values.setZero(shifts.size());
    slopes.setZero(shifts.size());
    for (Index i = first(person); i < first(person + 1); ++i)
        for (Index k = 0; k < shifts.size(); ++k) {
            const IntervalEvidence of = evidenceOf(row(i), shifts[k]);
            values[k] += of.value;
            slopes[k] += of.byShift();
        }
}

void OrdinalRows::addGradient(int person, const GradientParts& parts, VectorXd& gradient) {
    for (Index i = first(person); i < first(person + 1); ++i) {
        const IntervalEvidence mode = evidenceOf(row(i), parts.mode);
        // d/du and d/dl of the slope by the shift, -(u + l), and of -(uu + 2 ul + ll).
        double upper = -parts.ofSlope * (mode.uu + mode.ul) -
                       parts.ofInformation * (mode.uuu + 2 * mode.uul + mode.ull);
        double lower = -parts.ofSlope * (mode.ul + mode.ll) -
                       parts.ofInformation * (mode.uul + 2 * mode.ull + mode.lll);
        for (Index k = 0; k < parts.shifts.size(); ++k) {
            const IntervalEvidence of = evidenceOf(row(i), parts.shifts[k]);
            upper += parts.shares[k] * of.u;
            lower += parts.shares[k] * of.l;
        }
        addRow(row(i), upper, lower, gradient);
    }
}

double OrdinalRows::withoutPeople(const VectorXd& parameters, VectorXd& gradient) {
    gradient.setZero(parameters.size());
    if (!setParameters(parameters))
        return -std::numeric_limits<double>::infinity();
    double sum = 0;
    for (Index i = 0; i < predictor_.size(); ++i) {
        const IntervalEvidence of = evidenceOf(i, 0);
        sum += of.value;
        addRow(i, of.u, of.l, gradient);
    }
    return sum;
}

IntervalEvidence OrdinalRows::evidenceOf(Index row, double shift) const {
    const Index k = category(row);
    const bool hasLower = k > 0, hasUpper = k < thresholds_;
    const double predictor = predictor_[row] + shift;
    return intervalEvidence(link_, hasLower, hasLower ? parameters_[k - 1] - predictor : 0,
                            hasUpper, hasUpper ? parameters_[k] - predictor : 0);
}

void OrdinalRows::addRow(Index row, double upper, double lower, VectorXd& gradient) const {
    const Index k = category(row), columns = data_.design.cols();
    if (k < thresholds_)
        gradient[k] += upper;
    if (k > 0)
        gradient[k - 1] += lower;
    if (columns > 0) // thresholds alone have no design to point into
        gradient.segment(thresholds_, columns) -=
            (upper + lower) * data_.design.row(row).transpose();
}

} // namespace obscura
