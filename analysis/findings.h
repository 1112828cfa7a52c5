#pragma once

#include "analysis/claims.h"
#include "analysis/conduct.h"
#include "analysis/people.h"
#include "analysis/scales/scale_kinds.h"
#include "analysis/study_tests.h"
#include "analysis/votes.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// All that one run of the analysis found; the terminal, the CSV and the report show the same.
struct Findings {
    std::string title;
    std::vector<Tally> tallies;     // none where trials are no pairs
    std::optional<Conduct> conduct; // absent for published counts
    std::optional<Manifest> stimuli;
    std::vector<Tested> tests = {};       // beyond single conditions
    std::vector<ClaimResult> claims = {}; // those that the protocol declares
    std::optional<People> people = {};    // absent for published counts
    // What does not count, and what there would be if it did; absent where nothing is excluded.
    std::vector<Exclusion> exclusions = {};
    struct Whole {
        std::vector<Tally> tallies;
        std::vector<ClaimResult> claims;
    };
    std::optional<Whole> whole = {};
    ScaleFindings scales = {};
};

// Of a study's answers. `claims` stand for those of its design where that has none.
Findings findingsOf(const Answers& answers, std::optional<Manifest> stimuli,
                    const std::vector<Claim>& claims = {});

// Of published counts: a title and tallies.
Findings findingsOf(std::string title, std::vector<Tally> counts,
                    const std::vector<Claim>& claims = {});

// What the votes are: "participants", "SIMULATED", "partly SIMULATED" or "published counts". A
// column of the CSV, so that no table can lose it.
std::string sourceOf(const Findings& findings);

// The loud line above everything when programs answered; "" otherwise.
std::string stampOf(const Findings& findings);

// What a reader must know before any result: that the position of a picture explains choices, or
// cannot be told apart from the picture. Stands above everything and in each line of the CSV.
std::vector<std::string> cautionsOf(const Findings& findings);

// Whether there are votes, but no condition whose votes can be used: then nothing else that is made
// of them means anything, and nobody is told of it in words or pictures.
bool isUnusable(const Findings& findings);

// One sentence for each claim, in the order of the protocol; then a few plain ones that claim no
// more than the numbers do.
std::vector<std::string> summaryOf(const Findings& findings);

} // namespace obscura
