#include "inference/glm.h"

#include "base/error.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace obscura {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// What one evaluation at given coefficients yields.
struct FitPoint {
    double value = 0;     // log-likelihood (plus log prior) without binomial coefficients
    VectorXd gradient;    // of `value`
    VectorXd working;     // weights of the rows: expected information
    MatrixXd information; // of the coefficients, with the prior
};

class Fitter {
  public:
    Fitter(const BinomialData& data, const GlmOptions& options) : data_(data), options_(options) {}

    VectorXd predictor(const VectorXd& coefficients) const {
        VectorXd eta = data_.design * coefficients;
        if (data_.offset.size() > 0)
            eta += data_.offset;
        return eta;
    }

    FitPoint at(const VectorXd& coefficients) const {
        const VectorXd eta = predictor(coefficients);
        VectorXd slopes(eta.size());
        FitPoint point{.gradient = {}, .working = VectorXd(eta.size()), .information = {}};
        for (Index i = 0; i < eta.size(); ++i) {
            const Evidence row =
                evidence(options_.link, eta[i], data_.successes[i], data_.trials[i]);
            point.value += row.value;
            slopes[i] = row.slope;
            point.working[i] = row.information;
        }
        point.gradient = data_.design.transpose() * slopes;
        point.information =
            data_.design.transpose() * (point.working.asDiagonal() * data_.design).eval();
        if (hasPrior()) {
            const VectorXd pull = options_.priorPrecision * coefficients;
            point.value -= coefficients.dot(pull) / 2;
            point.gradient -= pull;
            point.information += options_.priorPrecision;
        }
        return point;
    }

    bool hasPrior() const { return options_.priorPrecision.size() > 0; }

    // A step of the coefficients that moves every one-sided row further to its side, or not at all,
    // and no mixed row, raises the likelihood for ever: it proves that no finite maximum exists.
    bool provesSeparation(const VectorXd& step) const {
        const VectorXd moves = data_.design * step;
        const double largest = moves.cwiseAbs().maxCoeff(), tolerance = 1e-5 * largest;
        if (hasPrior() || largest < 1e-3)
            return false;
        for (Index i = 0; i < moves.size(); ++i) {
            const double failures = data_.trials[i] - data_.successes[i];
            if ((failures > 0 && moves[i] > tolerance) ||
                (data_.successes[i] > 0 && moves[i] < -tolerance))
                return false;
        }
        return true;
    }

  private:
    const BinomialData& data_;
    const GlmOptions& options_;
};

// The largest part of the step that does not lower the likelihood. Expected information makes the
// full step an ascent direction; it is too long only far from the maximum.
double climb(const Fitter& fitter, VectorXd& coefficients, FitPoint& point, const VectorXd& step) {
    const double slack = 1e-12 * (1 + std::abs(point.value));
    for (int halvings = 0; halvings < 20; ++halvings) {
        const VectorXd next = coefficients + std::ldexp(1.0, -halvings) * step;
        FitPoint there = fitter.at(next);
        if (there.value >= point.value - slack) {
            const double gain = there.value - point.value;
            coefficients = next;
            point = std::move(there);
            return gain;
        }
    }
    return 0;
}

void iterate(const Fitter& fitter, const BinomialData& data, GlmFit& fit, FitPoint& point) {
    for (fit.iterations = 1; fit.iterations <= 100; ++fit.iterations) {
        const VectorXd step = point.information.ldlt().solve(point.gradient);
        if (!step.allFinite())
            return;
        const double gain = climb(fitter, fit.coefficients, point, step);
        const double length = (data.design * step).cwiseAbs().maxCoeff();
        if (length < 1e-9) {
            fit.converged = true;
            return;
        }
        if (gain < 1e-9 && fitter.provesSeparation(step)) {
            fit.separated = true;
            return;
        }
    }
}

double saturatedLogLikelihood(const BinomialData& data) {
    double sum = 0;
    for (Index i = 0; i < data.trials.size(); ++i) {
        const double n = data.trials[i], k = data.successes[i];
        sum += (k > 0 ? k * std::log(k / n) : 0) + (k < n ? (n - k) * std::log1p(-k / n) : 0);
    }
    return sum;
}

double dataLogLikelihood(const BinomialData& data, const VectorXd& predictor, Link link) {
    double sum = 0;
    for (Index i = 0; i < predictor.size(); ++i)
        sum += evidence(link, predictor[i], data.successes[i], data.trials[i]).value;
    return sum;
}

MatrixXd usedRows(const BinomialData& data) {
    const VectorXd used = (data.trials.array() > 0).cast<double>();
    return used.asDiagonal() * data.design;
}

} // namespace

void check(const BinomialData& data) {
    const Index rows = data.design.rows();
    if (data.successes.size() != rows || data.trials.size() != rows ||
        (data.offset.size() != 0 && data.offset.size() != rows))
        throw Error(fmt::format("expected as many successes, trials and offsets as the design has "
                                "rows ({}), found {}, {} and {}",
                                rows, data.successes.size(), data.trials.size(),
                                data.offset.size()));
    if (!data.design.allFinite() || !data.offset.allFinite())
        throw Error("the design or the offset of a model has a value that is not finite; leave out "
                    "the rows that lack it");
    for (Index i = 0; i < rows; ++i)
        if (!(data.successes[i] >= 0 && data.successes[i] <= data.trials[i] &&
              std::isfinite(data.trials[i])))
            throw Error(fmt::format("row {} of a model: expected 0 <= successes <= trials, found "
                                    "{} of {}",
                                    i, data.successes[i], data.trials[i]));
    if (rows == 0 || data.trials.sum() <= 0)
        throw Error("a model needs at least one trial, found none");
}

void requireFullRank(const MatrixXd& design) {
    const VectorXd lengths = design.colwise().norm();
    const MatrixXd scaled = design * lengths.cwiseMax(1e-300).cwiseInverse().asDiagonal();
    Eigen::ColPivHouseholderQR<MatrixXd> decomposition(scaled.transpose() * scaled);
    decomposition.setThreshold(1e-11);
    if (decomposition.rank() < design.cols())
        throw Error(fmt::format(
            "column {} of a model's design depends on the others (rank {} of {}): the data cannot "
            "tell these effects apart; leave one out",
            decomposition.colsPermutation().indices()[decomposition.rank()] + 1,
            decomposition.rank(), design.cols()));
}

MatrixXd symmetricInverse(const MatrixXd& matrix) {
    const VectorXd diagonal = matrix.diagonal().cwiseAbs();
    const VectorXd scale = (diagonal.array() > 0).select(diagonal.array().rsqrt(), 1.0);
    const MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
    const MatrixXd inverse = scaled.completeOrthogonalDecomposition().pseudoInverse();
    return scale.asDiagonal() * (inverse + inverse.transpose()) * scale.asDiagonal() / 2;
}

double logBinomialCoefficients(const BinomialData& data) {
    double sum = 0;
    for (Index i = 0; i < data.trials.size(); ++i) {
        const double n = data.trials[i], k = data.successes[i];
        if (n > 1)
            sum += std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
    }
    return sum;
}

GlmFit fitGlm(const BinomialData& data, const GlmOptions& options) {
    check(data);
    const Index columns = data.design.cols();
    if (options.priorPrecision.size() > 0 &&
        (options.priorPrecision.rows() != columns || options.priorPrecision.cols() != columns))
        throw Error(fmt::format("expected a prior precision of {0} x {0}, found {1} x {2}", columns,
                                options.priorPrecision.rows(), options.priorPrecision.cols()));
    const Fitter fitter(data, options);
    if (!fitter.hasPrior())
        requireFullRank(usedRows(data));

    GlmFit fit{.coefficients = VectorXd::Zero(columns), .covariance = {}};
    FitPoint point = fitter.at(fit.coefficients);
    iterate(fitter, data, fit, point);

    fit.covariance = symmetricInverse(point.information);
    const double likelihood =
        dataLogLikelihood(data, fitter.predictor(fit.coefficients), options.link);
    fit.logLikelihood = likelihood + logBinomialCoefficients(data);
    fit.deviance = std::max(0.0, 2 * (saturatedLogLikelihood(data) - likelihood));
    return fit;
}

MatrixXd clusterCovariance(const BinomialData& data, const GlmFit& fit, Link link,
                           std::span<const int> cluster) {
    if (static_cast<Index>(cluster.size()) != data.design.rows())
        throw Error(fmt::format("expected one cluster for each of {} rows, found {}",
                                data.design.rows(), cluster.size()));
    if (cluster.empty() || *std::min_element(cluster.begin(), cluster.end()) < 0)
        throw Error("clusters are numbered from 0");
    VectorXd predictor = data.design * fit.coefficients;
    if (data.offset.size() > 0)
        predictor += data.offset;
    const int clusters = *std::max_element(cluster.begin(), cluster.end()) + 1;
    MatrixXd scores = MatrixXd::Zero(clusters, data.design.cols());
    for (Index i = 0; i < predictor.size(); ++i)
        scores.row(cluster[static_cast<std::size_t>(i)]) +=
            evidence(link, predictor[i], data.successes[i], data.trials[i]).slope *
            data.design.row(i);
    return fit.covariance * (scores.transpose() * scores) * fit.covariance;
}

Test likelihoodRatio(double smaller, double larger, int df) {
    const double statistic = std::max(0.0, 2 * (larger - smaller));
    const boost::math::chi_squared reference(df);
    return {.statistic = statistic,
            .df = df,
            .p = boost::math::cdf(boost::math::complement(reference, statistic))};
}

} // namespace obscura
