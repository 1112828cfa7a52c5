#include "analysis/findings.h"

#include "analysis/scales/scale_table.h"
#include "analysis/verdict.h"

#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

std::int64_t totalVotes(const Findings& findings) {
    std::int64_t total = 0;
    for (const Tally& tally : findings.tallies)
        total += tally.votes.total();
    return total;
}

bool splitsEvenly(const Votes& votes) {
    return votes.total() == 0 || exactP(votes) >= significance;
}

// The tallies that have votes and for which `wanted` holds, given the verdict.
template <typename Wanted>
std::vector<Tally> select(const Findings& findings, Wanted wanted) {
    const auto verdicts = verdictsOf(findings.tallies);
    std::vector<Tally> selected;
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        if (verdicts[i] && wanted(findings.tallies[i], *verdicts[i]))
            selected.push_back(findings.tallies[i]);
    return selected;
}

std::vector<Tally> tested(const Findings& findings) {
    return select(findings, [](const Tally&, const Verdict&) { return true; });
}

// The interval that belongs to the exact test.
Interval intervalOf(const Tally& tally) {
    return clopperPearson(tally.votes.b, tally.votes.total());
}

// So many votes that hardly any preference is left to find: the interval lies around one half.
bool isEven(const Tally& tally, const Verdict& verdict) {
    const Interval interval = intervalOf(tally);
    return !verdict.differs && interval.low >= 0.45 && interval.high <= 0.55;
}

std::vector<Tally> undecided(const Findings& findings) {
    return select(findings, [](const Tally& tally, const Verdict& verdict) {
        return !verdict.differs && !isEven(tally, verdict);
    });
}

std::string place(const Tally& tally) { return fmt::format("{}, {}", tally.scene, tally.level); }

template <typename Phrase>
std::string listOf(const std::vector<Tally>& tallies, Phrase phrase) {
    std::string text;
    for (const Tally& tally : tallies)
        text += (text.empty() ? "" : "; ") + phrase(tally);
    return text;
}

// "25 of 36 chose Blizzard24 over None (sponza, high)", from the side of the majority.
std::string preference(const Tally& tally) {
    const auto [a, b] = tally.votes;
    return fmt::format("{} of {} chose {} over {} ({})", std::max(a, b), a + b,
                       b > a ? tally.techniqueB : tally.techniqueA,
                       b > a ? tally.techniqueA : tally.techniqueB, place(tally));
}

std::string extent(const Findings& findings) {
    const std::int64_t votes = totalVotes(findings);
    const std::size_t conditions = findings.tallies.size();
    if (findings.tallies.empty() && findings.conduct)
        return fmt::format("{} {} answered {} trials.", findings.conduct->participants,
                           findings.conduct->simulated == findings.conduct->trials
                               ? "simulated participants"
                               : "participants",
                           findings.conduct->trials);
    if (!findings.conduct)
        return fmt::format("The published counts hold {} votes on {} conditions.", votes,
                           conditions);
    return fmt::format("{} {} gave {} votes on {} conditions.", findings.conduct->participants,
                       findings.conduct->simulated == votes ? "simulated participants"
                                                            : "participants",
                       votes, conditions);
}

std::string differences(const Findings& findings) {
    const auto found =
        select(findings, [](const Tally&, const Verdict& verdict) { return verdict.differs; });
    const std::string list = found.empty() ? "" : ": " + listOf(found, preference);
    return fmt::format("{} of {} conditions {} from an even split at .05 (exact binomial test, "
                       "corrected by Holm within each hypothesis){}.",
                       found.size(), tested(findings).size(),
                       found.size() == 1 ? "differs" : "differ", list);
}

// What only looks like a difference, because there are several tests.
std::string uncorrected(const Findings& findings) {
    const auto lost = select(findings, [](const Tally& tally, const Verdict& verdict) {
        return !verdict.differs && !splitsEvenly(tally.votes);
    });
    if (lost.empty())
        return {};
    return fmt::format("Without the correction one would add: {}. With {} tests at .05, guessing "
                       "alone gives up to {:.2g} such differences on average, so one small p among "
                       "them is weak evidence.",
                       listOf(lost, preference), tested(findings).size(),
                       static_cast<double>(tested(findings).size()) * significance);
}

// The approximation rejects more often than it says; a reader who compares must know where.
std::string disagreement(const Findings& findings) {
    const auto split = select(findings, [](const Tally& tally, const Verdict&) {
        return splitsEvenly(tally.votes) && chiSquareP(chiSquare(tally.votes)) < significance;
    });
    if (split.empty())
        return {};
    return fmt::format("By chi-square alone, an approximation that is too lenient here, one "
                       "would add: {}.",
                       listOf(split, preference));
}

std::string evenSplits(const Findings& findings) {
    const auto even = select(findings, isEven);
    if (even.empty())
        return {};
    return fmt::format("No noticeable preference: {}.", listOf(even, [](const Tally& tally) {
                           const auto [low, high] = intervalOf(tally);
                           return fmt::format("with {} votes, the share of {} over {} ({}) lies "
                                              "from {:.1f} to {:.1f} % (95 % interval)",
                                              tally.votes.total(), tally.techniqueB,
                                              tally.techniqueA, place(tally), 100 * low,
                                              100 * high);
                       }));
}

std::string notEquivalence(const Findings& findings) {
    const auto others = undecided(findings);
    if (others.empty())
        return {};
    Interval widest{1, 0};
    for (const Tally& tally : others) {
        const Interval interval = intervalOf(tally);
        widest.low = std::min(widest.low, interval.low);
        widest.high = std::max(widest.high, interval.high);
    }
    return fmt::format("For {} {} the data do not decide: a large p, even 1, does not show that "
                       "two images look equally real, and the intervals leave room for shares from "
                       "{:.0f} to {:.0f} %.",
                       others.size() == tested(findings).size() ? "all" : "the other",
                       others.size(), 100 * widest.low, 100 * widest.high);
}

std::string repeatedVotes(const Findings& findings) {
    if (!findings.conduct || findings.conduct->mostVotes < 2)
        return {};
    return fmt::format("Caution: some participants voted up to {} times on one condition; the "
                       "tests take every vote for another person's, so their p are too small.",
                       findings.conduct->mostVotes);
}

std::string missing(const Findings& findings) {
    std::vector<Tally> empty;
    for (const Tally& tally : findings.tallies)
        if (tally.votes.total() == 0)
            empty.push_back(tally);
    if (empty.empty())
        return {};
    return fmt::format("No votes yet: {}.",
                       listOf(empty, [](const Tally& tally) { return tally.condition; }));
}

std::string bShare(int chosen, int shown) {
    return shown == 0 ? "never shown"
                      : fmt::format("{:.0f} % of {}", 100.0 * chosen / shown, shown);
}

std::string unbalancedOrder(const Conduct& conduct) {
    std::string list;
    for (const auto& [condition, shown] : conduct.shown)
        if (!splitsEvenly({shown.bFirst, shown.bSecond}))
            list += fmt::format("{}{} (b second in {} of {})", list.empty() ? "" : ", ", condition,
                                shown.bSecond, shown.bFirst + shown.bSecond);
    if (list.empty())
        return {};
    return fmt::format("CAUTION: the order of a and b was not balanced, so that a preference for "
                       "a position and one for a picture cannot be told apart there: {}.",
                       list);
}

std::string positionExplains(const Conduct& conduct) {
    if (conduct.shown.empty())
        return {}; // trials that are no pairs
    const Votes positions{conduct.trials - conduct.secondChosen, conduct.secondChosen};
    if (splitsEvenly(positions))
        return {};
    Conduct::Shown all;
    for (const auto& [condition, shown] : conduct.shown) {
        all.bFirst += shown.bFirst;
        all.bSecond += shown.bSecond;
        all.bChosenFirst += shown.bChosenFirst;
        all.bChosenSecond += shown.bChosenSecond;
    }
    const double p = exactP(positions);
    return fmt::format(
        "CAUTION: position {} choices. The second picture was chosen in {} of {} votes "
        "({:.0f} %; exact two-sided binomial p {}). b was chosen, when shown first: {}; when shown "
        "second: {}.",
        unbalancedOrder(conduct).empty() ? "explains" : "may explain", positions.b,
        positions.total(), 100.0 * positions.b / positions.total(),
        p < 0.001 ? "< 0.001" : fmt::format("= {:.3f}", p), bShare(all.bChosenFirst, all.bFirst),
        bShare(all.bChosenSecond, all.bSecond));
}

} // namespace

std::vector<Tested> testsOf(const StudyData& data) {
    std::vector<Tested> tests;
    for (const TestKind& kind : testKinds())
        for (StudyTest& result : kind.run(data))
            tests.push_back({&kind, std::move(result)});
    return tests;
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

std::vector<std::string> cautionsOf(const Findings& findings) {
    std::vector<std::string> cautions;
    if (findings.conduct)
        for (const std::string& caution :
             {positionExplains(*findings.conduct), unbalancedOrder(*findings.conduct)})
            if (!caution.empty())
                cautions.push_back(caution);
    return cautions;
}

std::vector<std::string> summaryOf(const Findings& findings) {
    std::vector<std::string> sentences;
    if (findings.tallies.empty()) {
        sentences = scaleSentences(findings.scales);
        sentences.insert(sentences.begin(), extent(findings));
        return sentences;
    }
    for (const std::string& sentence :
         {extent(findings), differences(findings), uncorrected(findings), disagreement(findings),
          evenSplits(findings), notEquivalence(findings), repeatedVotes(findings),
          missing(findings)})
        if (!sentence.empty())
            sentences.push_back(sentence);
    for (const std::string& sentence : scaleSentences(findings.scales))
        sentences.push_back(sentence);
    return sentences;
}

} // namespace obscura
