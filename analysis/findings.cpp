#include "analysis/findings.h"

#include "base/parallel.h"

#include "inference/counts.h"
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <utility>

namespace obscura {

namespace {

// Why the votes of a condition cannot be believed, as far as the order shows it.
void markFaults(std::vector<Tally>& tallies, const Conduct& conduct) {
    const Interval second = clopperPearson(conduct.secondChosen, conduct.trials);
    const double share = static_cast<double>(conduct.secondChosen) / conduct.trials;
    for (Tally& tally : tallies) {
        const auto shown = conduct.shown.find(tally.condition);
        if (shown == conduct.shown.end())
            continue;
        const auto [bFirst, bSecond, chosenFirst, chosenSecond] = shown->second;
        if (second.low > 0.75 || second.high < 0.25)
            tally.fault = fmt::format("position decides: the {} picture was chosen in {:.0f} % of "
                                      "all votes",
                                      second.low > 0.75 ? "second" : "first",
                                      100 * std::max(share, 1 - share));
        else if (bFirst == 0 || bSecond == 0)
            tally.fault = fmt::format("b was always the {} picture, so that a preference for a "
                                      "position cannot be told from one for a picture",
                                      bFirst == 0 ? "second" : "first");
    }
}

std::vector<Tally> judgeable(std::vector<Tally> tallies, const std::vector<Answer>& answers,
                             const Conduct& conduct, const std::vector<Claim>& claims) {
    assignFamilies(tallies, claims);
    markFaults(tallies, conduct);
    if (conduct.mostVotes > 1)
        judgeByPeople(tallies, answers);
    return tallies;
}

// Independent steps; of their errors the first is thrown.
void atOnce(const std::vector<std::function<void()>>& steps) {
    std::vector<std::exception_ptr> errors(steps.size());
    forEachInParallel(steps.size(), [&](std::size_t i) {
        try {
            steps[i]();
        } catch (...) {
            errors[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& error : errors)
        if (error)
            std::rethrow_exception(error);
}

} // namespace

Findings findingsOf(const Answers& answers, std::optional<Manifest> stimuli,
                    const std::vector<Claim>& claims) {
    const auto& declared = answers.declared.claims.empty() ? claims : answers.declared.claims;
    Findings findings;
    findings.stimuli = std::move(stimuli);
    const Manifest* manifest = findings.stimuli ? &*findings.stimuli : nullptr;
    const auto& order = answers.declared.order;
    findings.title = manifest ? manifest->title : answers.counted.front().row.studyId;
    findings.conduct = conductOf(answers);
    findings.tallies = judgeable(tallyVotes(answers.counted, manifest, order), answers.counted,
                                 *findings.conduct, declared);
    atOnce({
        [&] { findings.tests = testsOf(studyData(findings.tallies, &answers.counted)); },
        [&] { findings.people = peopleOf(answers.counted, findings.tallies); },
        [&] { findings.claims = testClaims(declared, findings.tallies, &answers.counted); },
        [&] { findings.scales = scaleFindings(findings.tallies, &answers.counted, manifest); },
    });
    findings.exclusions = answers.excluded.reasons;
    if (answers.excluded.rows.empty())
        return findings;
    Answers all = answers;
    all.counted.insert(all.counted.end(), answers.excluded.rows.begin(),
                       answers.excluded.rows.end());
    std::vector<Tally> tallies =
        judgeable(tallyVotes(all.counted, manifest, order), all.counted, conductOf(all), declared);
    findings.scales.whole = scaleFindings(tallies, &all.counted, manifest).all;
    findings.whole = {tallies, testClaims(declared, tallies, &all.counted)};
    return findings;
}

Findings findingsOf(std::string title, std::vector<Tally> counts,
                    const std::vector<Claim>& claims) {
    assignFamilies(counts, claims);
    Findings findings{std::move(title), std::move(counts), std::nullopt, std::nullopt};
    findings.tests = testsOf(studyData(findings.tallies, nullptr));
    findings.scales = scaleFindings(findings.tallies, nullptr, nullptr);
    findings.claims = testClaims(claims, findings.tallies, nullptr);
    return findings;
}

std::string sourceOf(const Findings& findings) {
    if (!findings.conduct)
        return "published counts";
    if (findings.conduct->simulated == 0)
        return "participants";
    return findings.conduct->simulated == findings.conduct->trials ? "SIMULATED"
                                                                   : "partly SIMULATED";
}

std::string stampOf(const Findings& findings) {
    if (!findings.conduct || findings.conduct->simulated == 0)
        return {};
    return fmt::format("SIMULATED DATA: {} of {} votes were cast by a program. They say nothing "
                       "about people.",
                       findings.conduct->simulated, findings.conduct->trials);
}

} // namespace obscura
