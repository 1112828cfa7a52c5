#pragma once

#include "analysis/conduct.h"
#include "analysis/votes.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// A p below this is called a difference. It is not corrected for the number of tests; the summary
// says what that means.
constexpr double significance = 0.05;

// All that one run of the analysis found; the terminal, the CSV and the report show the same.
struct Findings {
    std::string title;
    std::vector<Tally> tallies;
    std::optional<Conduct> conduct; // absent for published counts
    std::optional<Manifest> stimuli;
};

// What the votes are: "participants", "SIMULATED", "partly SIMULATED" or "published counts". A
// column of the CSV, so that no table can lose it.
std::string sourceOf(const Findings& findings);

// The loud line above everything when programs answered; "" otherwise.
std::string stampOf(const Findings& findings);

// What a reader must know before any result: that the position of a picture explains choices, or
// cannot be told apart from the picture. Stands above everything and in each line of the CSV.
std::vector<std::string> cautionsOf(const Findings& findings);

// A few plain sentences that claim no more than the numbers do.
std::vector<std::string> summaryOf(const Findings& findings);

bool differs(const Votes& votes); // exact p < significance

} // namespace obscura
