#include "inference/psychometric.h"

#include "base/error.h"
#include "base/percentile.h"
#include "base/random.h"

#include "inference/glm.h"
#include "inference/psychometric_likelihood.h"
#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace obscura {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

void check(const PsychometricData& data, const PsychometricModel& model) {
    check(BinomialData{.design = data.level, .successes = data.successes, .trials = data.trials});
    if (!(model.guess >= 0 && model.guess < 1))
        throw Error(fmt::format("expected a guessing rate in [0, 1), found {}", model.guess));
    if (model.lapse && !(*model.lapse >= 0 && *model.lapse <= largestLapse))
        throw Error(
            fmt::format("expected a lapse rate in [0, {}], found {}", largestLapse, *model.lapse));
    if (model.curve == Sigmoid::weibull && data.level.minCoeff() < 0)
        throw Error(
            fmt::format("a Weibull curve is of levels from 0 on, found {}", data.level.minCoeff()));
}

// One row for each level with trials, ascending.
PsychometricData merged(const PsychometricData& data) {
    std::map<double, std::pair<double, double>> byLevel;
    for (Index i = 0; i < data.level.size(); ++i)
        if (data.trials[i] > 0) {
            auto& [successes, trials] = byLevel[data.level[i]];
            successes += data.successes[i];
            trials += data.trials[i];
        }
    if (byLevel.size() < 2)
        throw Error(fmt::format("a psychometric function needs two levels or more, found {}",
                                byLevel.size()));
    const auto rows = static_cast<Index>(byLevel.size());
    PsychometricData result{VectorXd(rows), VectorXd(rows), VectorXd(rows)};
    Index row = 0;
    for (const auto& [level, counts] : byLevel) {
        result.level[row] = level;
        result.successes[row] = counts.first;
        result.trials[row++] = counts.second;
    }
    return result;
}

double saturated(const PsychometricData& data) {
    double sum = 0;
    for (Index i = 0; i < data.level.size(); ++i) {
        const double n = data.trials[i], k = data.successes[i];
        sum += (k > 0 ? k * std::log(k / n) : 0) + (k < n ? (n - k) * std::log1p(-k / n) : 0);
    }
    return sum;
}

PsychometricFit fitMerged(const PsychometricData& data, const PsychometricModel& model) {
    const PsychometricLikelihood likelihood(data, model);
    const Maximum best = likelihood.best();
    PsychometricFit fit;
    fit.parameters = likelihood.parameters(best.at);
    fit.deviance = std::max(0.0, 2 * (saturated(data) - best.value));
    fit.df = static_cast<int>(data.level.size() - likelihood.size());
    fit.converged = best.reached;
    fit.logLikelihood = best.value;
    if (fit.converged) {
        const double stretch = model.curve == Sigmoid::weibull ? fit.parameters.threshold : 1;
        fit.thresholdError = stretch * std::sqrt(best.covariance(0, 0));
        fit.slopeError = fit.parameters.slope * std::sqrt(best.covariance(1, 1));
    }
    return fit;
}

// From the estimate outwards until the likelihood has fallen by `fall`, then halving the bracket.
std::optional<double> profileEnd(const PsychometricLikelihood& likelihood, const VectorXd& top,
                                 Index coordinate, double fall, double step) {
    VectorXd gradient, start = top;
    const double threshold = likelihood(top, gradient) - fall;
    const auto falls = [&](double value) {
        const Maximum there = likelihood.bestWith(coordinate, value, start);
        start = there.at;
        return there.value < threshold;
    };
    double inside = top[coordinate], outside = inside + step;
    for (int i = 0; !falls(outside); ++i, step *= 2) {
        if (i == 12)
            return std::nullopt;
        inside = outside;
        outside += step;
    }
    while (std::abs(outside - inside) > 1e-8 * (1 + std::abs(inside))) {
        const double middle = (inside + outside) / 2;
        (falls(middle) ? outside : inside) = middle;
    }
    return (inside + outside) / 2;
}

OpenInterval percentiles(const std::vector<double>& values, double confidence) {
    if (values.empty())
        return {};
    return {percentile(values, (1 - confidence) / 2), percentile(values, (1 + confidence) / 2)};
}

} // namespace

double probability(const PsychometricModel& model, const Psychometric& parameters, double level) {
    const double z = parameters.slope *
                     (location(model.curve, level) - location(model.curve, parameters.threshold));
    return model.guess + (1 - model.guess - parameters.lapse) * curvePoint(model.curve, z).below;
}

std::optional<double> levelOf(const PsychometricModel& model, const Psychometric& parameters,
                              double p) {
    const double share = (p - model.guess) / (1 - model.guess - parameters.lapse);
    if (!(share > 0 && share < 1))
        return std::nullopt;
    if (model.curve == Sigmoid::weibull)
        return parameters.threshold * std::pow(-std::log1p(-share), 1 / parameters.slope);
    const Link link = model.curve == Sigmoid::logistic ? Link::logit : Link::probit;
    return parameters.threshold + quantile(link, share) / parameters.slope;
}

PsychometricFit fitPsychometric(const PsychometricData& data, const PsychometricModel& model) {
    check(data, model);
    const PsychometricData levels = merged(data);
    PsychometricFit fit = fitMerged(levels, model);
    fit.logLikelihood += logBinomialCoefficients(
        {.design = data.level, .successes = data.successes, .trials = data.trials});
    return fit;
}

OpenInterval profileInterval(const PsychometricData& data, const PsychometricModel& model,
                             const PsychometricFit& fit, PsychometricParameter parameter,
                             double confidence) {
    check(data, model);
    const PsychometricData levels = merged(data);
    const PsychometricLikelihood likelihood(levels, model);
    const VectorXd top = likelihood.coordinates(fit.parameters);
    const double fall = boost::math::quantile(boost::math::chi_squared(1), confidence) / 2;
    const bool slope = parameter == PsychometricParameter::slope;
    const double step = slope ? 0.25 : likelihood.spread() / 20;
    const Index coordinate = slope ? 1 : 0;
    OpenInterval ends{profileEnd(likelihood, top, coordinate, fall, -step),
                      profileEnd(likelihood, top, coordinate, fall, step)};
    if (slope || model.curve == Sigmoid::weibull)
        for (auto* end : {&ends.low, &ends.high})
            if (*end)
                *end = std::exp(**end);
    return ends;
}

PsychometricBootstrap bootstrapPsychometric(const PsychometricData& data,
                                            const PsychometricModel& model,
                                            const PsychometricFit& fit, int resamples,
                                            std::uint64_t seed, double confidence) {
    check(data, model);
    PsychometricData drawn = merged(data);
    std::vector<double> shares, thresholds, slopes, lapses;
    for (Index i = 0; i < drawn.level.size(); ++i)
        shares.push_back(probability(model, fit.parameters, drawn.level[i]));
    Random random(seed, "psychometric bootstrap");
    int worse = 0;
    for (int sample = 0; sample < resamples; ++sample) {
        for (Index i = 0; i < drawn.level.size(); ++i) {
            drawn.successes[i] = 0;
            for (int trial = 0; trial < drawn.trials[i]; ++trial)
                drawn.successes[i] += random.uniform() < shares[static_cast<std::size_t>(i)];
        }
        const PsychometricFit again = fitMerged(drawn, model);
        if (!again.converged)
            continue;
        thresholds.push_back(again.parameters.threshold);
        slopes.push_back(again.parameters.slope);
        lapses.push_back(again.parameters.lapse);
        worse += again.deviance >= fit.deviance;
    }
    PsychometricBootstrap result{.threshold = percentiles(thresholds, confidence),
                                 .slope = percentiles(slopes, confidence),
                                 .lapse = percentiles(lapses, confidence)};
    result.usable = static_cast<int>(thresholds.size());
    result.devianceP = (1.0 + worse) / (1.0 + result.usable);
    return result;
}

} // namespace obscura
