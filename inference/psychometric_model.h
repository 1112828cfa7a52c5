#pragma once

#include <Eigen/Core>

#include <optional>

namespace obscura {

// Psychometric functions: P(level) = guess + (1 - guess - lapse) F(level), F rising from 0 to 1
// (Wichmann and Hill, Percept. Psychophys. 63 (2001) 1293). Levels of falling preference are to be
// negated, or the other answer counted.
enum class Sigmoid {
    logistic, // 1 / (1 + exp(-slope (level - threshold)))
    normal,   // Phi(slope (level - threshold))
    weibull,  // 1 - exp(-(level / threshold)^slope); levels >= 0, F(threshold) = 63.2 %
};

struct PsychometricModel {
    Sigmoid curve = Sigmoid::logistic;
    double guess = 0;                // [0, 1): 0 for preferences, 1/n for n alternatives
    std::optional<double> lapse = 0; // [0, 0.1]; absent: fitted within [0, 0.1]
};

struct PsychometricData {
    Eigen::VectorXd level;
    Eigen::VectorXd successes, trials; // 0 <= successes <= trials, whole numbers
};

struct Psychometric {
    double threshold = 0; // level of F = 1/2 (weibull: 63.2 %), in units of the levels
    double slope = 1;     // > 0; per unit of level, weibull without unit
    double lapse = 0;
};

} // namespace obscura
