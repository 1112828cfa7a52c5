#include "analysis/scales/scale_kinds.h"

#include "inference/psychometric.h"
#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

constexpr int resamples = 400;

// In the axis' own direction again.
double seen(const Ladder& ladder, double level) { return ladder.isFalling ? -level : level; }

OpenInterval seen(const Ladder& ladder, const OpenInterval& bounds) {
    if (!ladder.isFalling)
        return bounds;
    OpenInterval turned;
    if (bounds.high)
        turned.low = -*bounds.high;
    if (bounds.low)
        turned.high = -*bounds.low;
    return turned;
}

std::string between(const Ladder& ladder, double level) {
    Eigen::Index below = -1, above = -1;
    for (Eigen::Index i = 0; i < ladder.data.level.size(); ++i) {
        const double at = ladder.data.level(i);
        if (at <= level && (below < 0 || at > ladder.data.level(below)))
            below = i;
        if (at >= level && (above < 0 || at < ladder.data.level(above)))
            above = i;
    }
    if (below < 0 || above < 0)
        return "outside of the steps that were shown";
    const std::string &first = ladder.labels[static_cast<std::size_t>(below)],
                      &second = ladder.labels[static_cast<std::size_t>(above)];
    return first == second ? "at " + first : fmt::format("between {} and {}", first, second);
}

void addDiagnostics(ScaleResult& result, const PsychometricFit& fit,
                    const PsychometricBootstrap& bootstrap) {
    if (fit.df > 0)
        result.diagnostics.push_back(
            {"does the curve fit the shares? (deviance, p by simulation)", std::nullopt,
             Test{fit.deviance, static_cast<double>(fit.df), bootstrap.devianceP}});
}

ScaleResult functionOf(const Ladder& ladder) {
    ScaleResult result = resultOf(ladder, ladder.axis);
    const Eigen::Index levels = ladder.data.level.size();
    PsychometricModel model{Sigmoid::logistic, ladder.guess, 0.0};
    if (levels >= 5) // threshold, slope and lapse, and two to tell whether it fits
        model.lapse = std::nullopt;
    if (levels < 3) {
        result.notes.push_back("fewer than three steps: no curve");
        return result;
    }
    PsychometricFit fit = fitPsychometric(ladder.data, model);
    if (!fit.converged && !model.lapse) { // without any lapse its best value is at the edge
        model.lapse = 0;
        fit = fitPsychometric(ladder.data, model);
    }
    result.curve = ScaleCurve{ladder, model, fit.parameters};
    if (!fit.converged) {
        result.notes.push_back("the answers do not bound the curve: it is flat, or a step");
        result.curve.reset();
        return result;
    }
    const PsychometricBootstrap bootstrap =
        bootstrapPsychometric(ladder.data, model, fit, resamples, 1);
    const OpenInterval threshold = profileInterval(ladder.data, model, fit,
                                                   PsychometricParameter::threshold),
                       slope =
                           profileInterval(ladder.data, model, fit, PsychometricParameter::slope);
    result.items = {{"threshold", seen(ladder, fit.parameters.threshold), fit.thresholdError,
                     seen(ladder, threshold)},
                    {"slope", fit.parameters.slope, fit.slopeError, slope}};
    if (!model.lapse)
        result.items.push_back({"lapse", fit.parameters.lapse, std::nullopt, bootstrap.lapse});
    result.intervals = fmt::format("profile likelihood{}, which takes all answers for independent",
                                   model.lapse ? "" : "; of the lapse by parametric bootstrap");
    addDiagnostics(result, fit, bootstrap);
    const double half = probability(model, fit.parameters, fit.parameters.threshold);
    result.notes.insert(result.notes.begin(), // where sentences look for it
                        fmt::format("{:.0f} % {} lie {}", 100 * half, ladder.success,
                                    between(ladder, fit.parameters.threshold)));
    if (ladder.isOrder)
        result.notes.push_back(
            "steps count 1, 2, 3 ... in the protocol's order: the threshold is a "
            "place between them, the slope a fall or rise for each");
    if (ladder.isAdaptive)
        result.notes.push_back("a staircase chose the steps by the answers, which biases the slope "
                               "upwards; the threshold is little touched");
    return result;
}

} // namespace

std::vector<ScaleResult> psychometricFunctions(const ScaleData& data) {
    std::vector<ScaleResult> results;
    for (const Ladder& ladder : data.ladders)
        results.push_back(functionOf(ladder));
    return results;
}

} // namespace obscura
