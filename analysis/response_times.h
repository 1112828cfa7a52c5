#pragma once

#include "analysis/answer.h"
#include "analysis/verdict.h"
#include "analysis/votes.h"

#include "inference/robust.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace obscura {

// How long people looked and how fast they answered, by summaries that a few wild times cannot
// move. A flag says "look here"; it deletes nothing. Looking long is no fault in a study whose
// viewing is up to the participant, so only decisions are flagged.

// The six rules, in the order of what follows; the default is the one to prefer.
struct NamedRule {
    FlagRule rule;
    std::string_view id, text;
};
std::span<const NamedRule> flagRules();
constexpr FlagRule defaultFlag = FlagRule::madLog;

constexpr std::array<double, 5> timeShares = {0.05, 0.25, 0.5, 0.75, 0.95};

struct ResponseTimes {
    struct Measure {
        std::string_view id, name; // view1_ms, "first view"
        Summary summary;           // ms
        std::array<double, timeShares.size()> quantiles{};
    };
    struct Change {
        std::size_t tally = 0;
        Verdict::Outcome with{}, without{};
    };

    std::vector<Measure> measures;     // views, and decisions last
    std::vector<std::int64_t> flagged; // decisions, by each of flagRules()
    std::vector<bool> isFlagged;       // each answer, by the default
    std::vector<double> flaggedMs;     // those, a few hundred at most, evenly from all
    std::vector<Change> changes;       // verdicts that are others without the flagged trials
    std::int64_t count() const;        // flagged by the default
};

// Of at least one answer; `tallies` are theirs.
ResponseTimes responseTimes(const std::vector<Answer>& answers, const std::vector<Tally>& tallies);

} // namespace obscura
