#include "inference/tails.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>

namespace obscura {

namespace {

boost::math::binomial binomialOf(std::int64_t trials, double probability) {
    return {static_cast<double>(trials), probability};
}

} // namespace

double binomialLower(std::int64_t k, std::int64_t trials, double probability) {
    if (k < 0)
        return 0;
    return k >= trials ? 1 : cdf(binomialOf(trials, probability), static_cast<double>(k));
}

double binomialUpper(std::int64_t k, std::int64_t trials, double probability) {
    if (k > trials)
        return 0;
    return k <= 0 ? 1
                  : cdf(complement(binomialOf(trials, probability), static_cast<double>(k - 1)));
}

double binomialMass(std::int64_t k, std::int64_t trials, double probability) {
    return pdf(binomialOf(trials, probability), static_cast<double>(k));
}

double chiSquareP(double statistic, double df) {
    return cdf(complement(boost::math::chi_squared(df), statistic));
}

double studentP(double statistic, double df) {
    return 2 * cdf(complement(boost::math::students_t(df), std::abs(statistic)));
}

double fisherFP(double statistic, double df, double denominatorDf) {
    return cdf(complement(boost::math::fisher_f(df, denominatorDf), statistic));
}

double studentQuantile(double probability, double df) {
    return quantile(boost::math::students_t(df), probability);
}

double normalP(double statistic) { return std::erfc(std::abs(statistic) / std::sqrt(2)); }

double probit(double probability) { return quantile(boost::math::normal{}, probability); }

} // namespace obscura
