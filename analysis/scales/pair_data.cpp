#include "analysis/scales/ladders.h"
#include "analysis/scales/scale_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace obscura {

namespace {

// Beyond these, people are not told apart: resampling them would take longer than all the rest.
constexpr std::size_t mostResampled = 200000;
constexpr std::size_t mostPeople = 2000;
constexpr std::size_t mostCells = 200000; // of all people's tables of wins in a group

using Members = std::vector<const Tally*>;

// Scenes and levels in the order of the tallies, and all together where there are several.
std::vector<std::pair<ScaleGroup, Members>> groupsOf(const std::vector<Tally>& tallies) {
    std::vector<std::pair<ScaleGroup, Members>> groups;
    Members all;
    for (const Tally& tally : tallies) {
        if (tally.votes.total() == 0)
            continue;
        all.push_back(&tally);
        auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& one) {
            return one.first.scene == tally.scene && one.first.level == tally.level;
        });
        if (group == groups.end())
            group = groups.insert(group, {ScaleGroup{{}, tally.scene, tally.level, {}}, {}});
        group->second.push_back(&tally);
    }
    if (groups.size() > 1)
        groups.push_back({ScaleGroup{}, all});
    std::vector<std::string> techniques; // in the protocol's order
    for (const Tally* tally : all)
        for (const std::string& item : {tally->techniqueA, tally->techniqueB})
            if (std::find(techniques.begin(), techniques.end(), item) == techniques.end())
                techniques.push_back(item);
    for (auto& [group, members] : groups) {
        std::set<std::string> shown;
        for (const Tally* tally : members) {
            shown.insert({tally->techniqueA, tally->techniqueB});
            group.answers += static_cast<int>(tally->votes.total());
        }
        for (const std::string& technique : techniques)
            if (shown.contains(technique))
                group.items.push_back(technique);
    }
    return groups;
}

Eigen::Index indexOf(const ScaleGroup& group, const std::string& item) {
    return std::find(group.items.begin(), group.items.end(), item) - group.items.begin();
}

// Of each condition of the group, the places of b and a among its items.
using Places = std::unordered_map<std::uint32_t, std::pair<Eigen::Index, Eigen::Index>>;

void addPeople(Comparisons& group, const Places& places, const std::vector<Answer>& answers) {
    const auto n = static_cast<Eigen::Index>(group.items.size());
    std::unordered_map<std::uint64_t, std::size_t> people;
    for (const Answer& answer : answers) {
        const auto place = places.find(answer.row.conditionId.number());
        if (place == places.end())
            continue;
        const std::uint64_t person =
            std::uint64_t{answer.row.studyId.number()} << 32 | answer.row.participantId.number();
        const std::size_t index = people.try_emplace(person, people.size()).first->second;
        if (index == group.winsOf.size())
            group.winsOf.push_back(Wins::Zero(n, n));
        const auto [b, a] = place->second;
        ++(answer.row.choseB ? group.winsOf[index](b, a) : group.winsOf[index](a, b));
    }
    group.people = static_cast<int>(people.size());
    if (people.size() > mostPeople || people.size() * static_cast<std::size_t>(n * n) > mostCells) {
        group.winsOf.clear();
        group.notes.push_back("too many people to resample them");
    }
}

Comparisons comparisonsOf(const ScaleGroup& group, const Members& members,
                          const std::vector<Answer>* answers) {
    Comparisons result{group};
    const auto n = static_cast<Eigen::Index>(group.items.size());
    result.wins = Wins::Zero(n, n);
    result.ties = Eigen::MatrixXd::Zero(n, n);
    Places places;
    for (const Tally* tally : members) {
        const Eigen::Index a = indexOf(group, tally->techniqueA),
                           b = indexOf(group, tally->techniqueB);
        result.wins(b, a) += static_cast<double>(tally->votes.b);
        result.wins(a, b) += static_cast<double>(tally->votes.a);
        places[Symbol(tally->condition).number()] = {b, a};
    }
    if (answers && answers->size() <= mostResampled)
        addPeople(result, places, *answers);
    else if (answers)
        result.notes.push_back(
            fmt::format("people are not resampled with more than {} votes", mostResampled));
    return result;
}

// Preference for b against how its image differs.
void addLadders(ScaleData& data, const ScaleGroup& group, const Members& members,
                const Manifest* stimuli) {
    std::vector<Step> steps;
    for (const Tally* tally : members)
        steps.push_back(
            {tally->condition, fmt::format("{} > {}", tally->techniqueB, tally->techniqueA),
             differencesOf(stimuli, tally->condition, "a", "b"),
             static_cast<double>(tally->votes.b), static_cast<double>(tally->votes.total())});
    addPairLadders(data.ladders, group, steps, stimuli, "choices of b");
}

} // namespace

ScaleData scaleData(const std::vector<Tally>& tallies, const std::vector<Answer>* answers,
                    const Manifest* stimuli) {
    ScaleData data;
    for (const auto& [group, members] : groupsOf(tallies)) {
        if (group.items.size() >= 3)
            data.comparisons.push_back(comparisonsOf(group, members, answers));
        addLadders(data, group, members, stimuli);
    }
    return data;
}

} // namespace obscura
