#pragma once

namespace obscura {

// From the linear predictor to a probability: logit is the logistic distribution function, probit
// the normal one (Thurstone's).
enum class Link { logit, probit };

// The link's distribution: F, density f and its first two derivatives at x. `below` and `above` are
// F(x) and 1 - F(x), each without cancellation; all are finite for every finite x.
struct Distribution {
    double below, above;
    double density, slope, curvature; // f, f', f''
};
Distribution distribution(Link link, double x);

// Logarithms of F(x) and of 1 - F(x), finite for every finite x, however far in the tail.
struct LogTails {
    double below, above;
};
LogTails logTails(Link link, double x);

// The x at which F(x) = probability, in (0, 1).
double quantile(Link link, double probability);

// A binomial observation seen from its linear predictor: the log-likelihood (without the binomial
// coefficient), its first and second derivative, the expected information and its derivative.
struct Evidence {
    double value, slope, curvature;
    double information, informationSlope;
};
Evidence evidence(Link link, double predictor, double successes, double trials);

} // namespace obscura
