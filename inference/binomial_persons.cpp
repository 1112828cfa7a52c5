#include "inference/binomial_persons.h"

#include <algorithm>
#include <cmath>

namespace obscura {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

BinomialPersons::BinomialPersons(const PersonRows& rows, Link link)
    : rows_(rows), link_(link), design_(rows.data.design), nodeSlopes_(0, 0) {}

bool BinomialPersons::setParameters(const VectorXd& coefficients) {
    predictor_ = design_ * coefficients;
    if (rows_.data.offset.size() > 0)
        predictor_ += rows_.data.offset;
    return predictor_.allFinite();
}

ShiftedRows BinomialPersons::at(int person, double shift) const {
    ShiftedRows sums;
    for (Index i = first(person); i < first(person + 1); ++i) {
        const Evidence row = rowAt(i, shift);
        sums.value += row.value;
        sums.slope += row.slope;
        sums.curvature += row.curvature;
        sums.information += row.information;
        sums.informationSlope += row.informationSlope;
    }
    return sums;
}

void BinomialPersons::atNodes(int person, const ArrayXd& shifts, ArrayXd& values, ArrayXd& slopes) {
    const Index nodes = shifts.size();
    values.setZero(nodes);
    slopes.setZero(nodes);
    resizeNodeSlopes(nodes, first(person + 1) - first(person));
    for (Index i = first(person); i < first(person + 1); ++i) {
        for (Index k = 0; k < nodes; ++k) {
            const Evidence row = rowAt(i, shifts[k]);
            values[k] += row.value;
            nodeSlopes_(k, i - first(person)) = row.slope;
        }
        slopes += nodeSlopes_.col(i - first(person));
    }
}

void BinomialPersons::addGradient(int person, const GradientParts& parts, VectorXd& gradient) {
    for (Index i = first(person); i < first(person + 1); ++i) {
        const Evidence row = atMode(i, parts.mode);
        const double slope = (nodeSlopes_.col(i - first(person)) * parts.shares).sum() +
                             parts.ofSlope * row.curvature +
                             parts.ofInformation * row.informationSlope;
        gradient.head(design_.cols()) += slope * design_.row(i).transpose();
    }
}

void BinomialPersons::resizeNodeSlopes(Index nodes, Index rows) {
    if (nodeSlopes_.rows() < nodes || nodeSlopes_.cols() < rows)
        nodeSlopes_.resize(nodes, rows);
}

namespace {

// For the logit exp(predictor + shift) = exp(predictor) exp(shift): one exponential for each row
// and one for each node of a person, none for their pairs; and the logarithms of up to eight rows
// of one trial are that of a product.
class LogisticPersons : public BinomialPersons {
  public:
    explicit LogisticPersons(const PersonRows& rows) : BinomialPersons(rows, Link::logit) {}

    bool setParameters(const VectorXd& coefficients) override {
        if (!BinomialPersons::setParameters(coefficients))
            return false;
        predictor_ = predictor_.cwiseMax(-limit).cwiseMin(limit);
        odds_ = predictor_.array().exp();
        return true;
    }

    ShiftedRows at(int person, double shift) const override {
        const double factor = std::exp(std::clamp(shift, -limit, limit));
        ShiftedRows sums; // the value is not needed at the mode
        for (Index i = first(person); i < first(person + 1); ++i) {
            const double p = 1 - 1 / (1 + odds_[i] * factor);
            const double information = trials(i) * p * (1 - p);
            sums.slope += successes(i) - trials(i) * p;
            sums.information += information;
            sums.informationSlope += information * (1 - 2 * p);
        }
        sums.curvature = -sums.information;
        return sums;
    }

    void atNodes(int person, const ArrayXd& shifts, ArrayXd& values, ArrayXd& slopes) override {
        const Index nodes = shifts.size();
        bounded_ = shifts.max(-limit).min(limit);
        factors_ = bounded_.exp();
        values.setZero(nodes);
        slopes.setZero(nodes);
        resizeNodeSlopes(nodes, first(person + 1) - first(person));
        product_.setOnes(nodes);
        double chosen = 0, chosenPredictor = 0, largest = 1;
        const double largestFactor = factors_.maxCoeff();
        for (Index i = first(person); i < first(person + 1); ++i) {
            chosen += successes(i);
            chosenPredictor += successes(i) * predictor_[i];
            sum_ = 1 + odds_[i] * factors_;
            auto slope = nodeSlopes_.col(i - first(person));
            slope = trials(i) * sum_.inverse() - (trials(i) - successes(i));
            slopes += slope;
            if (trials(i) == 1) {
                const double bound = 1 + odds_[i] * largestFactor;
                if (largest * bound > 1e300) {
                    values -= product_.log();
                    product_.setOnes();
                    largest = 1;
                }
                product_ *= sum_;
                largest *= bound;
            } else {
                values -= trials(i) * sum_.log();
            }
        }
        values += chosenPredictor + chosen * bounded_ - product_.log();
    }

  protected:
    Evidence atMode(Index row, double shift) const override {
        const double p = 1 - 1 / (1 + odds_[row] * std::exp(std::clamp(shift, -limit, limit)));
        Evidence of{};
        of.information = trials(row) * p * (1 - p);
        of.curvature = -of.information;
        of.informationSlope = of.information * (1 - 2 * p);
        return of;
    }

  private:
    static constexpr double limit = 340; // so that a product of two exponentials is finite
    ArrayXd odds_, bounded_, factors_, sum_, product_;
};

} // namespace

std::unique_ptr<BinomialPersons> binomialModel(const PersonRows& rows, Link link) {
    if (link == Link::logit)
        return std::make_unique<LogisticPersons>(rows);
    return std::make_unique<BinomialPersons>(rows, link);
}

} // namespace obscura
