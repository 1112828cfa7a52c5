#include "analysis/people_words.h"

#include "analysis/verdict.h"

#include "inference/multiplicity.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace obscura {

namespace {

// Of each condition with votes, whether its p, adjusted for its family, is a difference.
template <typename POf>
std::vector<bool> differences(const std::vector<Tally>& tallies, const POf& pOf) {
    std::map<std::string, std::pair<std::vector<std::size_t>, std::vector<double>>> families;
    for (std::size_t i = 0; i < tallies.size(); ++i)
        if (tallies[i].votes.total() > 0) {
            auto& [members, p] = families[tallies[i].family];
            members.push_back(i);
            p.push_back(pOf(i));
        }
    std::vector<bool> differs(tallies.size());
    for (const auto& [family, both] : families) {
        const std::vector<double> adjustedP = holm(both.second);
        for (std::size_t k = 0; k < adjustedP.size(); ++k)
            differs[both.first[k]] = adjustedP[k] < significance;
    }
    return differs;
}

// Where another estimate of the shares contradicts a verdict: by it a condition differs from an
// even split though the verdict has no difference, or the other way round. So that this is no
// matter of the kind of test, it must contradict the votes by chi-square, too, and move the share
// by half a percent at least. A condition whose estimate is absent keeps its votes.
std::string contradictions(const std::vector<Tally>& tallies,
                           const std::vector<std::optional<EstimatedShare>>& other) {
    const auto chi = [&](std::size_t i) { return chiSquareP(chiSquare(tallies[i].votes)); };
    const std::vector<bool> raw = differences(tallies, chi);
    const std::vector<bool> now =
        differences(tallies, [&](std::size_t i) { return other[i] ? other[i]->p : chi(i); });
    const auto verdicts = verdictsOf(tallies);
    std::string text;
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        const Tally& tally = tallies[i];
        if (!verdicts[i] || !other[i] || verdicts[i]->outcome == Verdict::Outcome::unusable)
            continue;
        const auto [a, b] = tally.votes;
        const double share = static_cast<double>(b) / static_cast<double>(a + b);
        if (now[i] != raw[i] && now[i] != verdicts[i]->differs() &&
            std::abs(share - other[i]->share) >= 0.005)
            text += fmt::format("{}{} ({}, {}) {:.0f} % instead of {:.0f} %, which would {}differ "
                                "from an even split",
                                text.empty() ? "" : "; ", tally.condition, tally.scene, tally.level,
                                100 * other[i]->share, 100 * share, now[i] ? "" : "not ");
    }
    return text;
}

std::string pText(double p) { return p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", p); }

const Tested* testOf(const std::vector<Tested>& tests, std::string_view id) {
    const auto found = std::find_if(tests.begin(), tests.end(),
                                    [&](const Tested& one) { return one.kind->id == id; });
    return found == tests.end() || !found->result.test ? nullptr : &*found;
}

// By person; positionExplains() speaks of all votes.
std::string leaning(const std::vector<Tested>& tests) {
    const Tested* test = testOf(tests, "position-people");
    if (!test || test->result.test->p >= significance)
        return {};
    return fmt::format("CAUTION: people lean to one place. The second picture was chosen in {} (t "
                       "test by person, {}). The shares for balanced orders allow for that.",
                       test->result.about, pText(test->result.test->p));
}

std::string onePlace(const People& people) {
    const auto biased = std::count_if(people.persons.begin(), people.persons.end(),
                                      [](const Person& one) { return one.holm < significance; });
    if (biased == 0)
        return {};
    return fmt::format("CAUTION: {} of {} people chose one place more often than chance, whatever "
                       "stood there (exact p < .05 after Holm); people.csv names them. Their votes "
                       "count, but say little about the pictures.",
                       biased, people.persons.size());
}

std::string adjusted(const std::vector<Tally>& tallies) {
    std::vector<std::optional<EstimatedShare>> shares;
    for (const Tally& tally : tallies)
        shares.push_back(tally.people ? std::nullopt // its votes depend on each other
                                      : balancedShare(tally.bFirst, tally.bSecond));
    const std::string list = contradictions(tallies, shares);
    return list.empty() ? ""
                        : fmt::format("CAUTION: the order changes results. Were b first and second "
                                      "equally often, its share would be: {}.",
                                      list);
}

// Even splits are guessing or camps: as far as that can be told.
std::string camps(const std::vector<Tested>& tests) {
    std::string text;
    for (const char* id : {"people", "repeats"})
        if (const Tested* test = testOf(tests, id))
            text += fmt::format("{}{} ({}): {}.", text.empty() ? "Guessing or camps: " : " ",
                                test->result.about, pText(test->result.test->p), test->result.note);
    return text;
}

std::string flaggedTimes(const ResponseTimes& times, const std::vector<Tally>& tallies) {
    const std::int64_t count = times.count();
    if (count == 0)
        return {};
    std::string changes;
    for (const ResponseTimes::Change& change : times.changes)
        changes += fmt::format("{}{} is {} and would be {}", changes.empty() ? "" : "; ",
                               tallies[change.tally].condition, nameOf(change.with),
                               nameOf(change.without));
    return fmt::format("{} of {} decision times are unusual (logarithms more than 2.5 MAD from the "
                       "median); their votes count. Without them {}.",
                       count, times.isFlagged.size(),
                       changes.empty() ? "every verdict would be the same" : changes);
}

std::string observersOf(const People& people, const std::vector<Tally>& tallies,
                        const std::vector<Tested>& tests) {
    const auto& observers = people.observers;
    if (observers.empty() || people.persons.size() < 2)
        return {};
    const Tested* camps = testOf(tests, "people");
    const char* unsuited = camps && camps->result.test->p < significance
                               ? " That model knows no camps: it takes the smaller for guessing."
                               : "";
    const std::string list = contradictions(tallies, observers);
    return (list.empty() ? "With people's bias, lapses and reliability in the model, every "
                           "difference stays, and there is no new one."
                         : fmt::format("With people's bias, lapses and reliability in the model, a "
                                       "typical observer's share of b is: {}.",
                                       list)) +
           std::string(unsuited);
}

std::vector<std::string> spoken(const std::vector<std::string>& sentences) {
    std::vector<std::string> some;
    for (const std::string& sentence : sentences)
        if (!sentence.empty())
            some.push_back(sentence);
    return some;
}

} // namespace

std::vector<std::string> peopleCautions(const People& people, const std::vector<Tally>& tallies,
                                        const std::vector<Tested>& tests) {
    return spoken({leaning(tests), onePlace(people), adjusted(tallies)});
}

std::vector<std::string> peopleSentences(const People& people, const std::vector<Tally>& tallies,
                                         const std::vector<Tested>& tests) {
    return spoken(
        {camps(tests), observersOf(people, tallies, tests), flaggedTimes(people.times, tallies)});
}

} // namespace obscura
