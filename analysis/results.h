#pragma once

#include "analysis/findings.h"
#include "analysis/table.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace obscura {

// Everything that was found, for programs. Statistics are named by the keys of golden_values.csv
// where these have them, else by the columns of votes.csv.

// Tidy: of,subject,statistic,value, a line for each number. `of` is condition, claim, test or
// scale. What does not exist has no line.
std::string resultsCsv(const Findings& findings);

// The same with all texts, as one object: made, source, title, cautions, summary, claims,
// conditions, tests, scales, exclusions. `made` says how it was asked for (whole_analysis.h).
std::string resultsJson(const Findings& findings, const nlohmann::ordered_json& made);

// A line for each reason and person: participant_id,session_id,reason,trials.
std::string exclusionsCsv(const Findings& findings);

// For people: each claim with its numbers; each reason with how many it concerns.
Table claimTable(const std::vector<ClaimResult>& claims);
Table exclusionTable(const std::vector<Exclusion>& exclusions);

} // namespace obscura
