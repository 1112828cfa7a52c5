#include "analysis/tests/tests.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

namespace obscura {

namespace {

// Conditions that compare the same two techniques at several levels and have votes: all of them
// and, where other scenes are among them, those of one scene, which differ in nothing but the
// level.
std::vector<Group> groupedPairs(const std::vector<Tally>& tallies) {
    std::map<std::pair<std::string, std::string>, std::map<std::string, Group>> pairs; // by scene
    for (std::size_t i = 0; i < tallies.size(); ++i)
        if (tallies[i].votes.total() > 0)
            for (const std::string& scene : {std::string(), tallies[i].scene})
                pairs[{tallies[i].techniqueA, tallies[i].techniqueB}][scene].push_back(i);
    std::vector<Group> several;
    for (const auto& [pair, scenes] : pairs)
        for (const auto& [scene, group] : scenes) {
            std::set<std::string> levels;
            for (const std::size_t member : group)
                levels.insert(tallies[member].level);
            const bool again = !scene.empty() && group == scenes.begin()->second;
            if (levels.size() >= 2 && !again)
                several.push_back(group);
        }
    return several;
}

std::string namesOf(const StudyData& data, const Group& group) {
    const Tally& first = data.tallies[group.front()];
    std::string names;
    for (const std::size_t member : group)
        names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", data.tallies[member].level,
                             data.tallies[member].scene);
    return fmt::format("{} over {}: {}", first.techniqueB, first.techniqueA, names);
}

// Where every level has a scene of its own, nobody can say which of the two makes a difference.
std::string confounding(const StudyData& data, const Group& group) {
    std::map<std::string, std::set<std::string>> levels; // by scene
    for (const std::size_t member : group)
        levels[data.tallies[member].scene].insert(data.tallies[member].level);
    const bool crossed = std::any_of(levels.begin(), levels.end(),
                                     [](const auto& scene) { return scene.second.size() >= 2; });
    if (!crossed)
        return "level and scene change together: which of them matters cannot be told";
    return levels.size() > 1 ? "scenes differ, too" : "";
}

// The words for levels whose order everybody knows.
constexpr std::array<std::string_view, 3> knownLevels = {"low", "moderate", "high"};

// The group's levels from the least: in the order of those words, or else of the tallies, which is
// the protocol's where that is known.
std::vector<std::string> orderedLevels(const StudyData& data, const Group& group) {
    std::vector<std::string> levels;
    for (const std::size_t member : group)
        if (std::find(levels.begin(), levels.end(), data.tallies[member].level) == levels.end())
            levels.push_back(data.tallies[member].level);
    const auto rank = [](const std::string& one) {
        return std::find(knownLevels.begin(), knownLevels.end(), one);
    };
    if (std::all_of(levels.begin(), levels.end(),
                    [&](const std::string& one) { return rank(one) != knownLevels.end(); }))
        std::sort(levels.begin(), levels.end(),
                  [&](const auto& x, const auto& y) { return rank(x) < rank(y); });
    return levels;
}

// Each condition's level by rank, from 1.
std::vector<double> scoresOf(const StudyData& data, const Group& group) {
    const std::vector<std::string> levels = orderedLevels(data, group);
    std::vector<double> scores;
    for (const std::size_t member : group)
        scores.push_back(static_cast<double>(
                             std::find(levels.begin(), levels.end(), data.tallies[member].level) -
                             levels.begin()) +
                         1);
    return scores;
}

std::string scoring(const StudyData& data, const Group& group) {
    return fmt::format("levels count 1, 2, ... in this order: {}",
                       fmt::join(orderedLevels(data, group), ", "));
}

constexpr const char* notPeople = "takes the votes for those of different people, which they are "
                                  "not: only trial by trial can decide";

std::vector<Votes> votesOf(const StudyData& data, const Group& group) {
    std::vector<Votes> votes;
    for (const std::size_t member : group)
        votes.push_back(data.tallies[member].votes);
    return votes;
}

// What the published totals allow, were it known who answered what.
std::string boundsOf(const std::vector<Votes>& votes) {
    if (votes.size() != 2 || votes[0].total() != votes[1].total())
        return {};
    const Interval p = mcnemarBounds(votes[0].total(), votes[0].b, votes[1].b);
    return fmt::format("McNemar's exact p could be anything from {:.4f} to {:.4f}", p.low, p.high);
}

// Of each group of at least so many conditions, where the study knows who answered.
template <typename Result>
std::vector<StudyTest> ofPeople(const StudyData& data, std::size_t least, std::size_t most,
                                const Result& result) {
    std::vector<StudyTest> tests;
    for (const Group& group : groupedPairs(data.tallies)) {
        if (!data.answers || group.size() < least || group.size() > most)
            continue;
        const AnswerTable complete = completeOf(data, group);
        StudyTest test = result(complete, group);
        test.about = namesOf(data, group);
        test.note = joined({test.note, confounding(data, group), leftOut(data, complete)});
        tests.push_back(std::move(test));
    }
    return tests;
}

// Of totals: all that can be said where nobody knows who answered what.
template <typename Result>
std::vector<StudyTest> ofTotals(const StudyData& data, std::size_t least, const Result& result) {
    std::vector<StudyTest> tests;
    for (const Group& group : groupedPairs(data.tallies)) {
        if (data.answers || group.size() < least)
            continue;
        StudyTest test = result(votesOf(data, group), group);
        test.about = namesOf(data, group);
        test.note = joined({notPeople, test.note, confounding(data, group)});
        tests.push_back(std::move(test));
    }
    return tests;
}

constexpr std::size_t any = 1'000'000;

} // namespace

std::string joined(const std::vector<std::string>& notes) {
    std::string text;
    for (const std::string& note : notes)
        if (!note.empty())
            text += (text.empty() ? "" : "; ") + note;
    return text;
}

// The answers of those people who answered all conditions of the group.
AnswerTable completeOf(const StudyData& data, const Group& group) {
    AnswerTable table;
    for (const std::vector<int>& person : data.people) {
        std::vector<int> row;
        for (const std::size_t member : group)
            if (person[member] >= 0)
                row.push_back(person[member]);
        if (row.size() == group.size())
            table.push_back(std::move(row));
    }
    return table;
}

std::string leftOut(const StudyData& data, const AnswerTable& complete) {
    const std::size_t missing = data.people.size() - complete.size();
    return missing == 0
               ? ""
               : fmt::format("{} people who did not answer all of them are left out", missing);
}

std::vector<StudyTest> cochranTests(const StudyData& data) {
    return ofPeople(data, 3, any, [](const AnswerTable& complete, const Group&) {
        return StudyTest{{}, complete.empty() ? std::nullopt : cochranQ(complete), {}};
    });
}

std::vector<StudyTest> mcNemarTests(const StudyData& data) {
    return ofPeople(data, 2, 2, [](const AnswerTable& complete, const Group&) {
        PairedVotes votes;
        for (const std::vector<int>& row : complete)
            ++(row[0] ? (row[1] ? votes.both : votes.firstOnly)
                      : (row[1] ? votes.secondOnly : votes.neither));
        const McNemar result = mcnemar(votes);
        return StudyTest{{},
                         Test{std::nullopt, std::nullopt, result.exactP},
                         fmt::format("{} and {} people changed their answer; mid-p {:.4f}, "
                                     "chi-square with Yates' correction p {:.4f}: the exact one is "
                                     "the one to trust",
                                     result.firstOnly, result.secondOnly, result.midP,
                                     result.corrected.p)};
    });
}

std::vector<StudyTest> levelTrendTests(const StudyData& data) {
    return ofPeople(data, 3, any, [&](const AnswerTable& complete, const Group& group) {
        return StudyTest{{},
                         complete.empty() ? std::nullopt
                                          : pairedTrend(complete, scoresOf(data, group)),
                         scoring(data, group)};
    });
}

std::vector<StudyTest> homogeneityTests(const StudyData& data) {
    return ofTotals(data, 2, [](const std::vector<Votes>& votes, const Group&) {
        return StudyTest{{}, homogeneity(votes), boundsOf(votes)};
    });
}

std::vector<StudyTest> totalsTrendTests(const StudyData& data) {
    return ofTotals(data, 3, [&](const std::vector<Votes>& votes, const Group& group) {
        return StudyTest{{}, trend(votes, scoresOf(data, group)), scoring(data, group)};
    });
}

} // namespace obscura
