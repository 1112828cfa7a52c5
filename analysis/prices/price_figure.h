#pragma once

#include "analysis/figures.h"
#include "analysis/prices/prediction.h"

#include <optional>
#include <vector>

namespace obscura {

// Milliseconds against JOD of people and predicted ones: one chart of all scenes and levels where
// there are several, and a panel for each. Then predicted differences against those of people. None
// without stimuli that tell prices, or predictions.
std::vector<StudyFigure> priceFigures(const Findings& findings);

// The last of these; absent for fewer than three points.
std::optional<StudyFigure> predictionFigure(const Findings& findings, const Prediction& prediction);

} // namespace obscura
