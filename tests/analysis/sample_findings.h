#pragma once

#include "analysis/findings.h"
#include "tests/analysis/sample_study.h"

namespace obscura::test {

inline Findings thesis() {
    return {"Thesis",
            readCounts(std::filesystem::path(OBSCURA_SOURCE) / "analysis/thesis_table4.csv"),
            std::nullopt, std::nullopt};
}

// Of writeStudy() with writeStimuli().
inline Findings studied(const Folder& folder, bool simulated) {
    const auto data = writeStudy(folder / "study", 28, simulated);
    const Answers answers = collectAnswers(std::vector{data}, {});
    Findings findings;
    findings.stimuli = readManifest(writeStimuli(folder / "stimuli") / "manifest.json");
    findings.title = findings.stimuli->title;
    findings.tallies = tallyVotes(answers.counted, &*findings.stimuli);
    findings.conduct = conductOf(answers);
    return findings;
}

} // namespace obscura::test
