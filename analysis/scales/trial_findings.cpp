#include "analysis/scales/trial_findings.h"

namespace obscura {

Findings trialFindings(std::span<const std::filesystem::path> data, const AnswerRules& rules,
                       const std::optional<Manifest>& stimuli) {
    const TrialAnswers study = collectTrials(data, rules);
    const ScaleData found = scaleData(study, stimuli ? &*stimuli : nullptr);
    Findings findings;
    findings.stimuli = stimuli;
    findings.title = stimuli ? stimuli->title : study.answers.counted.front().row.studyId.text();
    findings.conduct = conductOf(study.answers);
    findings.conduct->shown.clear(); // these trials have no a and b
    findings.conduct->secondChosen = 0;
    findings.scales = {scalesOf(found), found.notes};
    return findings;
}

} // namespace obscura
