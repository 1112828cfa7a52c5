#include "inference/mixed.h"

#include "inference/binomial_persons.h"
#include "inference/random_intercept.h"

#include <cmath>
#include <limits>

namespace obscura {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

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
            if (std::abs(x[columns]) > 2 * largestSd)
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

    const auto model = binomialModel(rows, options.link);
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
