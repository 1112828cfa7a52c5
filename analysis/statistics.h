#pragma once

#include "inference/counts.h"

#include <optional>
#include <span>
#include <string_view>

namespace obscura {

// What is computed of the votes of one condition. votes.csv has a column for each, and `golden`
// compares each that R has computed, too: a statistic is one row of this table and one function of
// inference/.
struct CountStatistic {
    std::string_view id;      // column of votes.csv
    std::string_view golden;  // its key in golden_values.csv after "thesis."; "" where it has none
    std::string_view meaning; // in one line
    std::optional<double> (*of)(Votes); // of at least one vote
};
std::span<const CountStatistic> countStatistics();

} // namespace obscura
