#include "analysis/scales/trial_findings.h"

#include <fmt/format.h>

namespace obscura {

namespace {

// What a protocol declares and nothing here is done with.
void noteUnused(const TrialAnswers& study, std::vector<std::string>& notes) {
    const Declared& declared = study.answers.declared;
    const ExclusionRules& rules = declared.exclusions;
    if (!declared.claims.empty())
        notes.push_back(fmt::format("The protocol declares {} claims. They are tested of rows of "
                                    "pairs, which this study has none of: not tested.",
                                    declared.claims.size()));
    if (!study.isChoice && (rules.catches > 0 || rules.onePosition < 1))
        notes.push_back("Exclusions by catch trials or one position need a choice between a and b "
                        "in every trial: not applied.");
}

} // namespace

Findings trialFindings(std::span<const std::filesystem::path> data, const AnswerRules& rules,
                       const std::optional<Manifest>& stimuli) {
    const Manifest* manifest = stimuli ? &*stimuli : nullptr;
    TrialAnswers study = collectTrials(data, rules);
    ScaleData found = scaleData(study, manifest);
    Findings findings;
    findings.stimuli = stimuli;
    findings.title = stimuli ? stimuli->title : study.answers.counted.front().row.studyId.text();
    findings.conduct = conductOf(study.answers);
    findings.conduct->shown.clear(); // these trials have no a and b
    findings.conduct->secondChosen = 0;
    findings.exclusions = study.answers.excluded.reasons;
    findings.scales = {scalesOf(found), std::move(found.notes)};
    noteUnused(study, findings.scales.notes);
    if (!study.excluded.empty()) {
        study.trials.insert(study.trials.end(), study.excluded.begin(), study.excluded.end());
        findings.scales.whole = scalesOf(scaleData(study, manifest));
    }
    return findings;
}

} // namespace obscura
