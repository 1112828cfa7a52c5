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
    return findingsOf(answers, readManifest(writeStimuli(folder / "stimuli") / "manifest.json"));
}

} // namespace obscura::test
