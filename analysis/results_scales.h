#pragma once

#include "analysis/findings.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace obscura {

using Numbers = std::vector<std::pair<std::string, std::optional<double>>>;

// A scale for programs: its numbers by the names that results.csv and results.json give them.
// Every item has `value`, `standard_error`, `low` and `high` as scales.csv has them. Where the
// stimuli tell prices, techniques also have `jod_people`, `jod_people_standard_error`,
// `jod_people_low` and `jod_people_high` relative to the reference, `jod_predicted` relative to the
// same, `rmse` and `milliseconds`.
struct ScaleNumbers {
    std::string subject; // "thurstone: atrium, sky"
    std::string id, question, scene, level, unit, intervals;
    std::string reference; // the technique that jod_people and jod_predicted are relative to; or ""
    std::vector<std::string> notes;
    std::vector<std::pair<std::string, Numbers>> items;
};
std::vector<ScaleNumbers> scaleNumbers(const Findings& findings);

} // namespace obscura
