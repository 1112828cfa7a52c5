#pragma once

#include "analysis/scales/scale_result.h"

#include <span>
#include <string_view>
#include <vector>

namespace obscura {

// A kind of scale: what it is called, who devised it, what it is made of, and how. The terminal,
// scales.csv and the report loop over them.
struct ScaleKind {
    std::string_view id, heading, source, needs;
    std::vector<ScaleResult> (*run)(const ScaleData&); // none where it does not apply
    // Of several that answer the same question, the one that sentences and figures speak of.
    bool isLeading = true;
};
std::span<const ScaleKind> scaleKinds();

struct Scaled {
    const ScaleKind* kind;
    ScaleResult result;
};
// Every kind that applies.
std::vector<Scaled> scalesOf(const ScaleData& data);

// The scales of a study, and what has none.
struct ScaleFindings {
    std::vector<Scaled> all;
    std::vector<std::string> notes;
    std::vector<Scaled> whole = {}; // with the excluded answers; none where nothing is excluded
};

// Those of rows of pairs, as scaleData() takes them.
ScaleFindings scaleFindings(const std::vector<Tally>& tallies, const std::vector<Answer>* answers,
                            const Manifest* stimuli);

// Their functions.
std::vector<ScaleResult> thurstoneScales(const ScaleData& data);
std::vector<ScaleResult> bradleyTerryScales(const ScaleData& data);
std::vector<ScaleResult> davidsonScales(const ScaleData& data);
std::vector<ScaleResult> thresholdScales(const ScaleData& data);
std::vector<ScaleResult> tripletScales(const ScaleData& data);
std::vector<ScaleResult> meanRatings(const ScaleData& data);
std::vector<ScaleResult> meanComparisons(const ScaleData& data);
std::vector<ScaleResult> cumulativeLinkScales(const ScaleData& data);
std::vector<ScaleResult> rankingScales(const ScaleData& data);
std::vector<ScaleResult> differenceScales(const ScaleData& data);
std::vector<ScaleResult> psychometricFunctions(const ScaleData& data);

} // namespace obscura
