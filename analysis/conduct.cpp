#include "analysis/conduct.h"

#include "base/parallel.h"
#include "base/percentile.h"

#include "inference/counts.h"
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace obscura {

namespace {

Percentiles spreadOf(const std::vector<Answer>& answers, double Vote::*field) {
    std::vector<double> values;
    values.reserve(answers.size());
    for (const Answer& answer : answers)
        values.push_back(answer.row.*field);
    return spread(values);
}

std::uint64_t both(Symbol x, Symbol y) { return std::uint64_t{x.number()} << 32 | y.number(); }

// The number of rows for each key.
template <typename Key, typename KeyOf>
std::map<Key, int> countBy(const std::vector<Answer>& answers, const KeyOf& keyOf) {
    std::vector<Key> keys;
    keys.reserve(answers.size());
    for (const Answer& answer : answers)
        keys.push_back(keyOf(answer.row));
    std::sort(keys.begin(), keys.end());
    std::map<Key, int> counts;
    for (const Key& key : keys)
        ++counts.emplace_hint(counts.end(), key, 0)->second;
    return counts;
}

void countPeople(const std::vector<Answer>& answers, Conduct& conduct) {
    std::uint64_t person = 0;
    for (const auto& [key, given] :
         countBy<std::pair<std::uint64_t, std::uint32_t>>(answers, [](const Vote& row) {
             return std::pair(both(row.studyId, row.participantId), row.conditionId.number());
         })) {
        conduct.participants += conduct.participants == 0 || key.first != person;
        person = key.first;
        conduct.mostVotes = std::max(conduct.mostVotes, given);
    }
}

void countSessions(const std::vector<Answer>& answers, Conduct& conduct) {
    struct Session {
        const Vote* row = nullptr;
        int trials = 0;
    };
    std::map<std::pair<std::uint64_t, std::uint32_t>, Session> sessions;
    int longest = 0;
    for (const Answer& answer : answers) {
        const Vote& row = answer.row;
        Session& session = sessions[{both(row.studyId, row.participantId), row.sessionId.number()}];
        session.row = &row;
        longest = std::max(longest, ++session.trials);
    }
    conduct.sessions = static_cast<int>(sessions.size());
    for (const auto& [id, session] : sessions) {
        auto& [base, exchanged] = conduct.squares[session.row->squareId];
        ++(session.row->pairsReversed ? exchanged : base);
        ++conduct.slots[session.row->slotId];
        conduct.incomplete += session.trials < longest;
    }
}

using ShownByCondition = std::unordered_map<std::uint32_t, Conduct::Shown>;

void countTrial(const Vote& row, ShownByCondition& shownBy,
                std::unordered_map<std::uint32_t, int>& sources, Conduct& conduct) {
    conduct.simulated += row.simulated;
    conduct.interrupted += row.interrupted;
    conduct.secondChosen += row.choseSecond();
    Conduct::Shown& shown = shownBy[row.conditionId.number()];
    ++(row.aFirst ? shown.bSecond : shown.bFirst);
    (row.aFirst ? shown.bChosenSecond : shown.bChosenFirst) += row.choseB;
    ++sources[row.timestampSource.number()];
    conduct.wrongMasks += row.maskFramesShown != row.maskFramesPlanned;
    conduct.missedFrames += row.missedFrames > 0;
    conduct.earlyPresses += row.earlyPressesInMask > 0;
    ++conduct.maskTimes[static_cast<int>(std::lround(row.maskMs))];
    ++conduct.maskFrames[row.maskFramesShown - row.maskFramesPlanned];
    ++conduct.missed[row.missedFrames];
}

void countTrials(const std::vector<Answer>& answers, Conduct& conduct) {
    ShownByCondition shown;
    std::unordered_map<std::uint32_t, int> sources;
    for (const Answer& answer : answers)
        countTrial(answer.row, shown, sources, conduct);
    for (const auto& [condition, counts] : shown)
        conduct.shown[Symbol::numbered(condition)] = counts;
    for (const auto& [source, trials] : sources)
        conduct.timestampSources[Symbol::numbered(source)] = trials;
}

void noteProvenance(const std::vector<Answer>& answers, Conduct& conduct) {
    std::unordered_map<std::uint32_t, std::uint64_t> images; // of each condition, the first seen
    std::unordered_set<std::uint64_t> programs;
    std::unordered_set<std::uint32_t> protocols, machines;
    for (const auto& [row, file, line] : answers) {
        const std::uint64_t pair = both(row.sha256A, row.sha256B);
        if (images.try_emplace(row.conditionId.number(), pair).first->second != pair)
            conduct.changedImages.insert(row.conditionId);
        if (protocols.insert(row.protocolSha256.number()).second)
            conduct.protocols.insert(row.protocolSha256);
        if (programs.insert(both(row.appVersion, row.gitCommit)).second)
            conduct.programs.insert(fmt::format("{} ({})", row.appVersion, row.gitCommit));
        if (machines.insert(row.machineId.number()).second)
            conduct.machines.insert(row.machineId);
    }
}

template <auto field>
auto rangeOf(const std::vector<Answer>& answers) {
    const auto [least, most] =
        std::minmax_element(answers.begin(), answers.end(), [](const Answer& x, const Answer& y) {
            return x.row.*field < y.row.*field;
        });
    return std::pair(least->row.*field, most->row.*field);
}

std::string utcOf(std::int64_t seconds) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

} // namespace

Percentiles spread(const std::vector<double>& values) {
    assert(!values.empty());
    const std::vector<double> found = percentiles(values, std::array{0.05, 0.5, 0.95});
    return {found[0], found[1], found[2]};
}

Conduct conductOf(const Answers& answers) {
    const std::vector<Answer>& counted = answers.counted;
    Conduct conduct;
    conduct.files = answers.files;
    conduct.trials = static_cast<int>(counted.size());
    conduct.leftOut = answers.leftOut;
    conduct.earlierFiles = answers.earlierFiles;
    conduct.bad = answers.bad;
    countPeople(counted, conduct);
    countSessions(counted, conduct);
    conduct.flow = flowOf(answers, conduct.participants, conduct.sessions);
    countTrials(counted, conduct);
    noteProvenance(counted, conduct);
    const std::pair<Percentiles*, double Vote::*> spreads[] = {
        {&conduct.maskMs, &Vote::maskMs},
        {&conduct.view1Ms, &Vote::view1Ms},
        {&conduct.view2Ms, &Vote::view2Ms},
        {&conduct.decisionMs, &Vote::decisionRtMs}};
    forEachInParallel(std::size(spreads), [&](std::size_t i) {
        *spreads[i].first = spreadOf(counted, spreads[i].second);
    });
    std::tie(conduct.slowestHz, conduct.fastestHz) = rangeOf<&Vote::refreshHz>(counted);
    const auto [first, last] = rangeOf<&Vote::wallTime>(counted);
    conduct.firstTime = utcOf(first);
    conduct.lastTime = utcOf(last);
    return conduct;
}

namespace {

std::string peopleLine(const Conduct& c) {
    std::string text = fmt::format("{} in {} sessions, {} to {}", c.participants, c.sessions,
                                   c.firstTime, c.lastTime);
    if (c.incomplete > 0)
        text += fmt::format("; {} sessions have fewer trials than the longest", c.incomplete);
    if (c.simulated > 0)
        text += fmt::format("; {} of {} trials were answered by a program", c.simulated, c.trials);
    return text;
}

std::string trials(const Conduct& c) {
    std::string text = fmt::format("{} main trials from {} files", c.trials, c.files);
    if (c.interrupted > 0)
        text +=
            fmt::format(", {} of them interrupted (the window lost the keyboard)", c.interrupted);
    if (c.earlierFiles > 0)
        text += fmt::format("; {} of the files are of an earlier version, which marked no "
                            "rehearsals: taken for the study's",
                            c.earlierFiles);
    const LeftOut& out = c.leftOut;
    const std::pair<int, const char*> parts[] = {
        {out.practice, "practice"},       {out.catches, "catch"},
        {out.interrupted, "interrupted"}, {out.duplicates, "answered twice"},
        {out.simulated, "simulated"},     {out.real, "not simulated"},
        {out.rehearsed, "rehearsed"},     {static_cast<int>(c.bad.size()), "unreadable"}};
    std::string list;
    for (const auto& [number, kind] : parts)
        if (number > 0)
            list += fmt::format("{}{} {}", list.empty() ? "" : ", ", number, kind);
    return text + (list.empty() ? "; nothing left out" : "; left out: " + list);
}

constexpr std::size_t fewest = 6; // squares or slots that are named one by one

std::string conditionOrder(const Conduct& c) {
    std::string text;
    if (c.squares.size() <= fewest)
        for (const auto& [square, sessions] : c.squares)
            text += fmt::format("square {}: {} sessions in base order, {} exchanged; ", square,
                                sessions.base, sessions.exchanged);
    else {
        Conduct::Sessions all;
        for (const auto& [square, sessions] : c.squares) {
            all.base += sessions.base;
            all.exchanged += sessions.exchanged;
        }
        text = fmt::format("{} squares: {} sessions in base order, {} exchanged; ",
                           c.squares.size(), all.base, all.exchanged);
    }
    std::vector<int> shared;
    for (const auto& [slot, sessions] : c.slots)
        if (sessions > 1)
            shared.push_back(slot);
    if (shared.empty())
        return text + "no slot used twice";
    const std::size_t named = std::min(shared.size(), fewest);
    return text +
           fmt::format("slots used more than once: {}{}",
                       fmt::join(shared.begin(), shared.begin() + static_cast<int>(named), ", "),
                       shared.size() > named ? fmt::format(" and {} more", shared.size() - named)
                                             : "");
}

std::string imageOrder(const Conduct& c) {
    double least = 1, most = 0;
    for (const auto& [condition, shown] : c.shown) {
        const double share = static_cast<double>(shown.bSecond) / (shown.bFirst + shown.bSecond);
        least = std::min(least, share);
        most = std::max(most, share);
    }
    const std::string shares = least == most
                                   ? fmt::format("{:.0f}", 100 * least)
                                   : fmt::format("{:.0f} to {:.0f}", 100 * least, 100 * most);
    return fmt::format("b was the second image in {} % of each condition's trials", shares);
}

std::string positionBias(const Conduct& c) {
    const auto [low, high] = wilson(c.secondChosen, c.trials);
    return fmt::format("{} of {} ({:.0f} %, 95 % interval {:.0f}–{:.0f} % if votes of one "
                       "person were independent)",
                       c.secondChosen, c.trials, 100.0 * c.secondChosen / c.trials, 100 * low,
                       100 * high);
}

std::string seconds(const Percentiles& ms) {
    return fmt::format("{:.2f} s ({:.2f}–{:.2f})", ms.median / 1000, ms.low / 1000, ms.high / 1000);
}

std::string times(const Conduct& c) {
    return fmt::format("image 1 {}, image 2 {}, decision {}", seconds(c.view1Ms),
                       seconds(c.view2Ms), seconds(c.decisionMs));
}

std::string mask(const Conduct& c) {
    return fmt::format("{}; {} of {} trials showed other than the planned number of refreshes, "
                       "{} had a missed frame; a key was pressed and ignored in {}",
                       seconds(c.maskMs), c.wrongMasks, c.trials, c.missedFrames, c.earlyPresses);
}

std::string display(const Conduct& c) {
    std::string text = c.slowestHz == c.fastestHz
                           ? fmt::format("{:.2f} Hz", c.slowestHz)
                           : fmt::format("{:.2f}–{:.2f} Hz", c.slowestHz, c.fastestHz);
    for (const auto& [source, number] : c.timestampSources)
        text += fmt::format("; timestamps from \"{}\" in {} trials", source, number);
    if (c.timestampSources.contains("none"))
        text += " (no vertical blank: not fit for claims about timing)";
    return text;
}

std::string images(const Conduct& c) {
    if (c.changedImages.empty())
        return "each condition showed the same two files throughout";
    return fmt::format("other files in some trials than in others: condition {}",
                       fmt::join(c.changedImages, ", "));
}

} // namespace

std::vector<Fact> factsOf(const Conduct& conduct) {
    if (conduct.shown.empty()) // trials that are no pairs
        return {{"Participants", peopleLine(conduct)},
                {"Trials", trials(conduct)},
                {"Median time to the answer (5–95 %)", seconds(conduct.decisionMs)},
                {"Machine", fmt::format("{}", fmt::join(conduct.machines, ", "))},
                {"Presented by",
                 fmt::format("obscura-experiment {}", fmt::join(conduct.programs, ", "))},
                {"Protocol, SHA-256", fmt::format("{}", fmt::join(conduct.protocols, ", "))}};
    return {
        {"Participants", peopleLine(conduct)},
        {"Trials", trials(conduct)},
        {"Order of conditions", conditionOrder(conduct)},
        {"Order within pairs", imageOrder(conduct)},
        {"Second image chosen", positionBias(conduct)},
        {"Median time (5–95 %)", times(conduct)},
        {"Grey mask, median (5–95 %)", mask(conduct)},
        {"Display", display(conduct)},
        {"Images", images(conduct)},
        {"Machine", fmt::format("{}", fmt::join(conduct.machines, ", "))},
        {"Presented by", fmt::format("obscura-experiment {}", fmt::join(conduct.programs, ", "))},
        {"Protocol, SHA-256", fmt::format("{}", fmt::join(conduct.protocols, ", "))}};
}

} // namespace obscura
