#include "analysis/findings.h"
#include "analysis/people_words.h"
#include "analysis/prices/price_words.h"
#include "analysis/scales/scale_words.h"
#include "analysis/verdict.h"

#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

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

std::vector<Tally> undecided(const Findings& findings) {
    return select(findings, [](const Tally&, const Verdict& verdict) {
        return verdict.outcome == Verdict::Outcome::undecided;
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
        select(findings, [](const Tally&, const Verdict& verdict) { return verdict.differs(); });
    const std::string list = found.empty() ? "" : ": " + listOf(found, preference);
    return fmt::format("{} of {} conditions {} from an even split at .05 (exact binomial test, "
                       "corrected by Holm within each {}){}.",
                       found.size(), tested(findings).size(),
                       found.size() == 1 ? "differs" : "differ",
                       findings.claims.empty() ? "hypothesis" : "claim", list);
}

// What only looks like a difference, because there are several tests.
std::string uncorrected(const Findings& findings) {
    const auto lost = select(findings, [](const Tally& tally, const Verdict& verdict) {
        return !verdict.differs() && decidingP(tally) < significance;
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

// A margin nobody has declared is named, too.
std::string evenSplits(const Findings& findings) {
    std::string list;
    const auto verdicts = verdictsOf(findings.tallies);
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        if (!verdicts[i] || verdicts[i]->outcome != Verdict::Outcome::equivalent)
            continue;
        const Tally& tally = findings.tallies[i];
        const auto [low, high] = intervalOf(tally);
        list += fmt::format("{}with {} votes, the share of {} over {} ({}) lies from {:.1f} to "
                            "{:.1f} % (95 % interval), and within 50 ∓ {:.0f} % by two exact "
                            "one-sided tests",
                            list.empty() ? "" : "; ", tally.votes.total(), tally.techniqueB,
                            tally.techniqueA, place(tally), 100 * low, 100 * high,
                            100 * verdicts[i]->margin);
    }
    return list.empty() ? "" : fmt::format("No noticeable preference: {}.", list);
}

std::string unusable(const Findings& findings) {
    std::map<std::string, int> reasons;
    for (const auto& verdict : verdictsOf(findings.tallies))
        if (verdict && verdict->outcome == Verdict::Outcome::unusable)
            ++reasons[verdict->why];
    std::string list;
    for (const auto& [why, conditions] : reasons)
        list += fmt::format("{}{} of {} conditions: {}", list.empty() ? "" : "; ", conditions,
                            findings.tallies.size(), why);
    return list.empty() ? "" : fmt::format("Not to be used: {}.", list);
}

std::string declaredOrNot(const Findings& findings) {
    if (findings.claims.empty())
        return "Nothing was claimed before the data: all of this is exploratory, and the "
               "hypotheses named in the data form the families for corrections.";
    std::string list;
    for (const Tally& tally : findings.tallies)
        if (tally.votes.total() > 0 && tally.family.empty())
            list += (list.empty() ? "" : ", ") + tally.condition;
    return list.empty() ? ""
                        : fmt::format("No claim names these conditions, which are "
                                      "exploratory: {}.",
                                      list);
}

// What the exclusions change, or that they change nothing.
std::string exclusionsOf(const Findings& findings) {
    if (!findings.whole)
        return {};
    int trials = 0;
    for (const Exclusion& exclusion : findings.exclusions)
        trials += exclusion.trials;
    std::string changed;
    const auto add = [&](const std::string& what, std::string_view without, std::string_view with) {
        if (without != with)
            changed += fmt::format("{}{} would be {} instead of {}", changed.empty() ? "" : "; ",
                                   what, with, without);
    };
    for (std::size_t i = 0; i < findings.claims.size(); ++i)
        add(fmt::format("\u201c{}\u201d", findings.claims[i].claim.name),
            nameOf(findings.claims[i].outcome), nameOf(findings.whole->claims[i].outcome));
    const auto without = verdictsOf(findings.tallies), with = verdictsOf(findings.whole->tallies);
    for (std::size_t i = 0; i < without.size(); ++i)
        if (without[i] && with[i])
            add(findings.tallies[i].condition, nameOf(without[i]->outcome),
                nameOf(with[i]->outcome));
    return fmt::format("{} votes do not count, by rules and reasons named below. With them, {}.",
                       trials, changed.empty() ? "no answer would be another" : changed);
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
    return fmt::format("Some participants voted up to {} times on one condition: there, verdicts "
                       "and intervals are of people's shares (Student's t), and the tests of votes "
                       "beside them take every vote for another person's.",
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

std::vector<std::string> pricesOf(const Findings& findings) {
    return findings.stimuli ? priceSentences(pricedScales(findings.scales, *findings.stimuli))
                            : std::vector<std::string>();
}

void add(std::vector<std::string> more, std::vector<std::string>& sentences) {
    std::move(more.begin(), more.end(), std::back_inserter(sentences));
}

} // namespace

std::vector<std::string> cautionsOf(const Findings& findings) {
    std::vector<std::string> cautions;
    if (findings.conduct)
        for (const std::string& caution :
             {positionExplains(*findings.conduct), unbalancedOrder(*findings.conduct)})
            if (!caution.empty())
                cautions.push_back(caution);
    if (findings.people)
        for (std::string& caution :
             peopleCautions(*findings.people, findings.tallies, findings.tests))
            cautions.push_back(std::move(caution));
    return cautions;
}

bool isUnusable(const Findings& findings) {
    int voted = 0, unusable = 0;
    for (const auto& verdict : verdictsOf(findings.tallies)) {
        voted += verdict.has_value();
        unusable += verdict && verdict->outcome == Verdict::Outcome::unusable;
    }
    return voted > 0 && voted == unusable;
}

std::vector<std::string> summaryOf(const Findings& findings) {
    std::vector<std::string> sentences;
    for (const ClaimResult& claim : findings.claims)
        sentences.push_back(sentenceOf(claim));
    if (findings.tallies.empty()) {
        add(pricesOf(findings), sentences);
        sentences.push_back(extent(findings));
        add(scaleSentences(findings.scales), sentences);
        return sentences;
    }
    if (!isUnusable(findings))
        add(pricesOf(findings), sentences);
    for (const std::string& sentence :
         {extent(findings), declaredOrNot(findings), differences(findings), uncorrected(findings),
          disagreement(findings), evenSplits(findings), notEquivalence(findings),
          unusable(findings), exclusionsOf(findings), repeatedVotes(findings), missing(findings)})
        if (!sentence.empty())
            sentences.push_back(sentence);
    if (isUnusable(findings))
        return sentences;
    add(scaleSentences(findings.scales), sentences);
    if (findings.people)
        add(peopleSentences(*findings.people, findings.tallies, findings.tests), sentences);
    return sentences;
}

} // namespace obscura
