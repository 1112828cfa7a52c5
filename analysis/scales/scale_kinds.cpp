#include "analysis/scales/scale_kinds.h"

#include <utility>

namespace obscura {

namespace {

const ScaleKind scaleKindRows[] = {
    {"thurstone", "Scale from pairs", "Thurstone 1927, case V, maximum likelihood",
     "choices between two, three techniques or more", thurstoneScales},
    {"bradley-terry", "Worths from pairs", "Bradley and Terry 1952",
     "choices between two, three techniques or more", bradleyTerryScales, false},
    {"threshold", "Scale from pairs with \"not sure\"", "Glenn and David 1960",
     "choices between two, with \"not sure\"", thresholdScales},
    {"davidson", "Worths from pairs with \"not sure\"", "Davidson 1970",
     "choices between two, with \"not sure\"", davidsonScales, false},
    {"triplets", "Difference from the source, from triplets",
     "Men, Lin, Jenadeleh, Saupe 2021; ISO/IEC 29170-3",
     "which of two differs more from a source, plain, boosted or both", tripletScales},
    {"mean-opinion", "Mean rating", "ITU-T P.910, ITU-R BT.500; intervals by Student's t",
     "ratings of single images", meanRatings},
    {"mean-comparison", "Scale from compared ratings", "Scheffé 1952, by least squares",
     "ratings of the second of two compared with the first", meanComparisons},
    {"cumulative-link", "The same as ordered categories",
     "McCullagh 1980, with a random intercept for each person", "ratings in steps",
     cumulativeLinkScales, false},
    {"plackett-luce", "Worths from ranks", "Luce 1959; Plackett 1975", "rankings", rankingScales},
    {"mlds", "Difference scale from triads", "Maloney and Yang 2003",
     "which of two differences is larger", differenceScales},
    {"psychometric", "Psychometric function", "Wichmann and Hill 2001",
     "right answers, or choices, at three steps of a ladder or more", psychometricFunctions},
};

} // namespace

std::span<const ScaleKind> scaleKinds() { return scaleKindRows; }

std::vector<Scaled> scalesOf(const ScaleData& data) {
    std::vector<Scaled> scales;
    for (const ScaleKind& kind : scaleKindRows)
        for (ScaleResult& result : kind.run(data))
            scales.push_back({&kind, std::move(result)});
    return scales;
}

ScaleFindings scaleFindings(const std::vector<Tally>& tallies, const std::vector<Answer>* answers,
                            const Manifest* stimuli) {
    ScaleData data = scaleData(tallies, answers, stimuli);
    return {scalesOf(data), std::move(data.notes)};
}

} // namespace obscura
