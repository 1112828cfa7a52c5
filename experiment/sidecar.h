#pragma once

#include "experiment/broken_session.h"
#include "experiment/row.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// The circumstances of a session, beside its rows: display or model, order, provenance. Written
// when it begins, and again with how it went when it ends; after a crash, what was written first
// remains.
nlohmann::ordered_json circumstances(const Context& context, const Observer& observer);

// Of a session that goes on: what its file said, and, in its list `resumed`, the circumstances
// `now`, after how many trials it went on, and which of them had been half seen.
nlohmann::ordered_json continued(const std::filesystem::path& file,
                                 const nlohmann::ordered_json& now, const BrokenSession& broken);

// Of intervals, those since it began or went on.
void addOutcome(nlohmann::ordered_json& sidecar, const std::string& reason,
                const std::vector<double>& maskIntervals, double refreshHz,
                const Observer& observer);

} // namespace obscura
