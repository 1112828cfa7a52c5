#pragma once

#include "experiment/row.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace obscura {

// The circumstances of a session, beside its rows: display or model, order, provenance. Written
// when it begins, and again with how it went when it ends; after a crash, what was written first
// remains.
nlohmann::ordered_json circumstances(const Context& context, const Observer& observer);
void addOutcome(nlohmann::ordered_json& sidecar, const std::string& reason,
                const std::vector<double>& maskIntervals, double refreshHz);

} // namespace obscura
