#include "inference/mixed.h"

#include "inference/person_rows.h"
#include "inference/random_intercept.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace obscura {

namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Beyond this a person's answers are certain, for any link: the best sd is infinite.
constexpr double largestSd = 100;

// What both links share: the predictors of all rows, and the gradient of one person's.
class BinomialPersons : public ShiftedModel {
  public:
    BinomialPersons(const PersonRows& rows, Link link)
        : rows_(rows), link_(link), design_(rows.data.design), nodeSlopes_(0, 0) {}

    int persons() const override { return rows_.persons(); }

    bool setParameters(const VectorXd& coefficients) override {
        predictor_ = design_ * coefficients;
        if (rows_.data.offset.size() > 0)
            predictor_ += rows_.data.offset;
        return predictor_.allFinite();
    }

    ShiftedRows at(int person, double shift) const override {
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

    void atNodes(int person, const ArrayXd& shifts, ArrayXd& values, ArrayXd& slopes) override {
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

    void addGradient(int person, const GradientParts& parts, VectorXd& gradient) override {
        for (Index i = first(person); i < first(person + 1); ++i) {
            const Evidence row = atMode(i, parts.mode);
            const double slope = (nodeSlopes_.col(i - first(person)) * parts.shares).sum() +
                                 parts.ofSlope * row.curvature +
                                 parts.ofInformation * row.informationSlope;
            gradient.head(design_.cols()) += slope * design_.row(i).transpose();
        }
    }

  protected:
    Index first(int person) const { return rows_.first[static_cast<std::size_t>(person)]; }
    double successes(Index row) const { return rows_.data.successes[row]; }
    double trials(Index row) const { return rows_.data.trials[row]; }

    // Curvature, information and its derivative of one row; all that the gradient asks of it.
    virtual Evidence atMode(Index row, double shift) const { return rowAt(row, shift); }

    Evidence rowAt(Index row, double shift) const {
        return evidence(link_, predictor_[row] + shift, successes(row), trials(row));
    }

    void resizeNodeSlopes(Index nodes, Index rows) {
        if (nodeSlopes_.rows() < nodes || nodeSlopes_.cols() < rows)
            nodeSlopes_.resize(nodes, rows);
    }

    const PersonRows& rows_;
    Link link_;
    RowMajor design_;
    VectorXd predictor_;
    ArrayXXd nodeSlopes_; // nodes x rows of the last person
};

// For the logit exp(predictor + shift) = exp(predictor) exp(shift): one exponential for each row
// and one for each node of a person, none for their pairs; and the logarithms of up to eight rows
// of one trial are that of a product.
class LogisticPersons : public BinomialPersons {
  public:
    explicit LogisticPersons(const PersonRows& rows) : BinomialPersons(rows, Link::logit) {}

    bool setParameters(const VectorXd& coefficients) override {
        if (!BinomialPersons::setParameters(coefficients))
            return false;
        odds_ = predictor_.array().max(-limit).min(limit).exp();
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
        factors_ = shifts.max(-limit).min(limit).exp();
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
        values += chosenPredictor + chosen * shifts - product_.log();
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
    ArrayXd odds_, factors_, sum_, product_;
};

// Whether the rows can tell how people differ: several people, and one with two trials or more.
bool tellsPersons(const PersonRows& rows) {
    int persons = 0;
    bool repeated = false;
    for (std::size_t i = 0; i + 1 < rows.first.size(); ++i) {
        const Index size = rows.first[i + 1] - rows.first[i];
        const double trials = rows.data.trials.segment(rows.first[i], size).sum();
        persons += trials > 0;
        repeated |= trials > 1;
    }
    return persons > 1 && repeated;
}

std::unique_ptr<BinomialPersons> modelOf(const PersonRows& rows, Link link) {
    if (link == Link::logit)
        return std::make_unique<LogisticPersons>(rows);
    return std::make_unique<BinomialPersons>(rows, link);
}

// Starts at sd = 1, as lme4 does, and at the coefficients of the fit without people, with the
// precision they have there.
Maximum maximiseMixed(RandomIntercept& likelihood, const GlmFit& plain, int persons) {
    const Index columns = plain.coefficients.size();
    VectorXd start(columns + 1);
    start << plain.coefficients, 1;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(columns + 1, columns + 1);
    covariance.topLeftCorner(columns, columns) = plain.covariance;
    covariance(columns, columns) = 1.0 / persons;
    return maximise(
        [&](const VectorXd& x, VectorXd& gradient) {
            if (std::abs(x[columns]) > 10 * largestSd)
                return -std::numeric_limits<double>::infinity();
            return likelihood(x, gradient);
        },
        start, covariance);
}

} // namespace

MixedFit fitMixed(const BinomialData& data, std::span<const int> person,
                  const MixedOptions& options) {
    check(data);
    const PersonRows rows = groupByPerson(data, person);
    const double constant = logBinomialCoefficients(data) - logBinomialCoefficients(rows.data);
    const GlmFit plain = fitGlm(rows.data, {.link = options.link});
    MixedFit fit{.coefficients = plain.coefficients,
                 .covariance = plain.covariance,
                 .logLikelihood = plain.logLikelihood + constant,
                 .persons = VectorXd::Zero(rows.persons()),
                 .converged = plain.converged,
                 .separated = plain.separated,
                 .identified = tellsPersons(rows)};
    if (!fit.identified)
        return fit;

    const auto model = modelOf(rows, options.link);
    RandomIntercept likelihood(*model, options.points);
    const Maximum best = maximiseMixed(likelihood, plain, rows.persons());
    fit.evaluations = best.evaluations;
    const double logLikelihood = best.value + logBinomialCoefficients(data);
    if (logLikelihood <= fit.logLikelihood + 1e-9) {
        fit.boundary = true;
        return fit;
    }
    const Index columns = plain.coefficients.size();
    fit.logLikelihood = logLikelihood;
    fit.coefficients = best.at.head(columns);
    fit.covariance = best.covariance.topLeftCorner(columns, columns);
    fit.sd = std::abs(best.at[columns]);
    fit.persons = likelihood.modes(best.at[columns]);
    fit.separated = plain.separated || fit.sd > largestSd;
    fit.converged = best.reached && !fit.separated;
    if (fit.converged)
        fit.sdError = std::sqrt(best.covariance(columns, columns));
    return fit;
}

} // namespace obscura
