#pragma once

#include "analysis/prices/prices.h"

#include "inference/correlation.h"

#include <string>
#include <vector>

namespace obscura {

// Predicted differences from the reference beside those of people's choices: how far to believe the
// metric. Each technique of each scene and level but the reference is a point.
struct PredictedPoint {
    std::string place; // "atrium, sky"
    std::string name;
    double predicted = 0, people = 0; // JOD less those of the reference
    OpenInterval interval;            // of people's, 95 %
};
struct Prediction {
    std::vector<PredictedPoint> points;
    std::optional<Correlation> line, ranks; // Pearson's, Spearman's
    std::size_t places = 0;                 // scenes and levels
};
Prediction predictionOf(const std::vector<PricedScale>& scales);

// What the best metrics of this kind reach on rendering artefacts: CGVQM, arXiv 2506.11546.
constexpr double bestCorrelation = 0.78;

} // namespace obscura
