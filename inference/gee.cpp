#include "inference/gee.h"

#include "base/error.h"

#include "inference/person_rows.h"
#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class Equations {
  public:
    Equations(const BinomialData& data, std::span<const int> person, Link link)
        : data_(data), link_(link), order_(orderByPerson(person, data.design.rows())),
          residuals_(data.design.rows()), design_(data.design) {}

    // Rows in units of their standard deviation: Pearson residuals, and the derivative of the mean.
    void standardise(const VectorXd& coefficients) {
        VectorXd predictor = data_.design * coefficients;
        if (data_.offset.size() > 0)
            predictor += data_.offset;
        for (Index i = 0; i < predictor.size(); ++i) {
            const Distribution at = distribution(link_, predictor[i]);
            // Bounded, so that a fitted share of 0 or 1 cannot divide by zero.
            const double deviation = std::sqrt(std::max(at.below * at.above, 1e-30));
            const double residual = data_.successes[i] > 0 ? at.above : -at.below;
            residuals_[i] = residual / deviation;
            design_.row(i) = data_.design.row(i) * (at.density / deviation);
        }
    }

    double scale() const {
        return residuals_.squaredNorm() / static_cast<double>(residuals_.size());
    }

    // Mean product of the residuals of two answers of one person, over all such pairs, kept within
    // what keeps the correlation matrix positive definite.
    double correlation(double scale) const {
        double products = 0, pairs = 0, largest = 1;
        for (std::size_t i = 0; i + 1 < order_.first.size(); ++i) {
            const double size = static_cast<double>(order_.first[i + 1] - order_.first[i]);
            double sum = 0, squares = 0;
            for (Index j = order_.first[i]; j < order_.first[i + 1]; ++j) {
                const double residual = residuals_[row(j)];
                sum += residual;
                squares += residual * residual;
            }
            products += (sum * sum - squares) / 2;
            pairs += size * (size - 1) / 2;
            largest = std::max(largest, size);
        }
        if (pairs == 0 || scale <= 0)
            return 0;
        return std::clamp(products / pairs / scale, -0.999 / std::max(largest - 1, 1.0), 0.999);
    }

    void add(double alpha, VectorXd& score, MatrixXd& information, MatrixXd& spread) const {
        const Index n = design_.cols();
        score.setZero(n);
        information.setZero(n, n);
        spread.setZero(n, n);
        for (std::size_t i = 0; i + 1 < order_.first.size(); ++i) {
            const Part own = partOf(i, alpha);
            score += own.score;
            information += own.information;
            spread += own.score * own.score.transpose();
        }
    }

    // Mancl and DeRouen's sandwich, of D'V^-1 (I - H)^-1 r of each person: the inverse of all
    // information times that is the inverse of the other people's information times D'V^-1 r.
    std::optional<MatrixXd> corrected(double alpha, const MatrixXd& information) const {
        MatrixXd covariance = MatrixXd::Zero(information.rows(), information.cols());
        for (std::size_t i = 0; i + 1 < order_.first.size(); ++i) {
            const Part own = partOf(i, alpha);
            const Eigen::LDLT<MatrixXd> others(information - own.information);
            if (!(others.vectorD().minCoeff() > 1e-10 * information.diagonal().maxCoeff()))
                return std::nullopt;
            const VectorXd change = others.solve(own.score);
            covariance += change * change.transpose();
        }
        return covariance;
    }

  private:
    struct Part {
        VectorXd score;
        MatrixXd information;
    };

    // What person i adds. The inverse of the correlation matrix of m answers is
    // (I - alpha J / (1 + (m - 1) alpha)) / (1 - alpha), J all ones, so sums over a person suffice.
    Part partOf(std::size_t i, double alpha) const {
        const Index n = design_.cols();
        const Index size = order_.first[i + 1] - order_.first[i];
        Part own{VectorXd::Zero(n), MatrixXd::Zero(n, n)};
        VectorXd total = VectorXd::Zero(n);
        double residualSum = 0;
        for (Index j = order_.first[i]; j < order_.first[i + 1]; ++j) {
            const auto x = design_.row(row(j)).transpose();
            own.score += residuals_[row(j)] * x;
            total += x;
            residualSum += residuals_[row(j)];
            own.information += x * x.transpose();
        }
        const double shared = alpha / (1 + (static_cast<double>(size) - 1) * alpha);
        own.score = (own.score - shared * residualSum * total) / (1 - alpha);
        own.information = (own.information - shared * total * total.transpose()) / (1 - alpha);
        return own;
    }

    Index row(Index position) const { return order_.rows[static_cast<std::size_t>(position)]; }

    const BinomialData& data_;
    Link link_;
    PersonOrder order_;
    VectorXd residuals_;
    MatrixXd design_;
};

void requireChoices(const BinomialData& data, std::span<const int> person) {
    if ((data.trials.array() != 1).any() ||
        ((data.successes.array() != 0) && (data.successes.array() != 1)).any())
        throw Error("estimating equations expect one choice in each row, found a tally; give every "
                    "choice a row");
    if (std::adjacent_find(person.begin(), person.end(), std::not_equal_to<>()) == person.end())
        throw Error("estimating equations compare people, found one person only");
}

} // namespace

GeeFit fitGee(const BinomialData& data, std::span<const int> person, Link link) {
    check(data);
    Equations equations(data, person, link);
    requireChoices(data, person);
    const GlmFit start = fitGlm(data, {.link = link});
    GeeFit fit{.coefficients = start.coefficients,
               .covariance = start.covariance,
               .separated = start.separated};
    if (fit.separated)
        return fit;
    VectorXd score;
    MatrixXd information, spread;
    for (int i = 0; i < 200 && !fit.converged; ++i) {
        equations.standardise(fit.coefficients);
        fit.scale = equations.scale();
        fit.correlation = equations.correlation(fit.scale);
        equations.add(fit.correlation, score, information, spread);
        const VectorXd step = information.ldlt().solve(score);
        if (!step.allFinite())
            break;
        // Where every share is 0 or 1 a step is 0 too, and the residuals are huge.
        fit.converged = (data.design * step).cwiseAbs().maxCoeff() < 1e-10 && fit.scale < 1e6;
        if (!fit.converged)
            fit.coefficients += step;
    }
    if (fit.converged) {
        const MatrixXd inverse = symmetricInverse(information);
        fit.covariance = inverse * spread * inverse;
    } else {
        fit.coefficients = start.coefficients;
        fit.covariance = clusterCovariance(data, start, link, person);
        fit.correlation = 0;
        fit.scale = 1;
        equations.standardise(fit.coefficients);
        equations.add(0, score, information, spread);
    }
    fit.corrected = equations.corrected(fit.correlation, information);
    return fit;
}

} // namespace obscura
