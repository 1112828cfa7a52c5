#include "analysis/scales/trial_findings.h"

#include "analysis/scales/answer_groups.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <utility>

namespace obscura {

namespace {

// Choices between a and b as rows of pairs have them, and how many of each condition were left
// open or "not sure".
struct Choices {
    std::vector<Answer> decided;
    std::map<std::string, std::int64_t> open;
};

Choices choicesOf(const TrialAnswers& study) {
    Choices choices;
    for (const AnsweredTrial& trial : study.trials) {
        if (trial.roles.size() != 2 || trial.techniqueOf("a").empty() ||
            trial.techniqueOf("b").empty())
            continue;
        for (const Given& given : trial.given) {
            const DesignFacts::Asked* asked = askedOf(trial, given);
            if (given.kind.text() != "choice" || (asked && !asked->images))
                continue;
            Answer answer = trial.trial;
            answer.row.techniqueA = Symbol(trial.techniqueOf("a"));
            answer.row.techniqueB = Symbol(trial.techniqueOf("b"));
            answer.row.aFirst = trial.roles[0] == "a";
            answer.row.choseB = given.role.text() == "b";
            if (given.role.text() == "a" || given.role.text() == "b")
                choices.decided.push_back(std::move(answer));
            else
                ++choices.open[answer.row.conditionId];
        }
    }
    return choices;
}

// Tests of claims are sign tests, or of people's shares: who does not choose has no vote (Dixon and
// Mood, J. Am. Stat. Assoc. 41 (1946) 557).
std::vector<ClaimResult> claimsOf(const TrialAnswers& study) {
    const Declared& declared = study.answers.declared;
    const Choices choices = choicesOf(study);
    if (declared.claims.empty() || choices.decided.empty())
        return {};
    std::vector<Tally> tallies = tallyVotes(choices.decided, nullptr, declared.order);
    assignFamilies(tallies, declared.claims);
    std::vector<ClaimResult> results = testClaims(declared.claims, tallies, &choices.decided);
    for (ClaimResult& result : results) {
        std::int64_t open = 0;
        for (const std::string& condition : result.claim.conditions)
            if (const auto found = choices.open.find(condition); found != choices.open.end())
                open += found->second;
        if (open > 0)
            result.notes.push_back(
                fmt::format("{} answers were \"not sure\" or left open: no votes", open));
    }
    return results;
}

// What a protocol declares and nothing here is done with.
void noteUnused(const TrialAnswers& study, bool areTested, std::vector<std::string>& notes) {
    const Declared& declared = study.answers.declared;
    const ExclusionRules& rules = declared.exclusions;
    if (!declared.claims.empty() && !areTested)
        notes.push_back(fmt::format("The protocol declares {} claims. They are tested of choices "
                                    "between a and b, which this study has none of: not tested.",
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
    findings.claims = claimsOf(study);
    noteUnused(study, !findings.claims.empty(), findings.scales.notes);
    if (!study.excluded.empty()) {
        study.trials.insert(study.trials.end(), study.excluded.begin(), study.excluded.end());
        findings.scales.whole = scalesOf(scaleData(study, manifest));
    }
    return findings;
}

} // namespace obscura
