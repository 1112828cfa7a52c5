#pragma once

#include "inference/psychometric_model.h"

#include <cstdint>
#include <optional>

namespace obscura {

struct PsychometricFit {
    Psychometric parameters;
    std::optional<double> thresholdError, slopeError; // by the curvature of the log-likelihood
    double logLikelihood = 0;                         // with the binomial coefficients
    double deviance = 0; // against a share of its own for each level: goodness of fit
    int df = 0;          // levels minus fitted parameters; the deviance's, approximately
    // False: the data do not bound the curve (a step, or flat); the parameters say little.
    bool converged = false;
};

// Probability of success at a level.
double probability(const PsychometricModel& model, const Psychometric& parameters, double level);

// The level at which the probability is p; absent where the curve never has it.
std::optional<double> levelOf(const PsychometricModel& model, const Psychometric& parameters,
                              double p);

// Maximum likelihood from several starts. Levels given more than once are one. Equals R's
// optim() of the same likelihood, and glm(binomial(link)) for guess = lapse = 0: threshold
// -intercept / coefficient, slope the coefficient. Error when sizes disagree, numbers are out of
// range, or there are fewer than two levels.
PsychometricFit fitPsychometric(const PsychometricData& data, const PsychometricModel& model);

// Ends of an interval; an end that the data do not bound is absent.
struct OpenInterval {
    std::optional<double> low, high;
};

enum class PsychometricParameter { threshold, slope };

// The values of one parameter that a likelihood-ratio test at 1 - confidence does not reject, the
// others refitted at each (Venables and Ripley, MASS 7.2).
OpenInterval profileInterval(const PsychometricData& data, const PsychometricModel& model,
                             const PsychometricFit& fit, PsychometricParameter parameter,
                             double confidence = 0.95);

struct PsychometricBootstrap {
    OpenInterval threshold, slope, lapse; // percentile intervals
    // Share of simulated deviances at least as large as the one seen, (1 + count) / (1 + usable):
    // goodness of fit that does not rely on large numbers.
    double devianceP = 1;
    int usable = 0; // resamples whose fit converged; only these count
};

// Parametric bootstrap (Wichmann and Hill, Percept. Psychophys. 63 (2001) 1314): `resamples` sets
// of answers drawn from the fitted curve and refitted. The same seed gives the same numbers. Only
// sensible for a fit that converged.
PsychometricBootstrap bootstrapPsychometric(const PsychometricData& data,
                                            const PsychometricModel& model,
                                            const PsychometricFit& fit, int resamples,
                                            std::uint64_t seed, double confidence = 0.95);

} // namespace obscura
