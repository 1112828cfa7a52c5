#pragma once

#include "analysis/findings.h"

#include <filesystem>
#include <span>

namespace obscura {

// The findings of a study whose trials are no pairs: no tallies and no tests of them, but scales.
Findings trialFindings(std::span<const std::filesystem::path> data, const AnswerRules& rules,
                       const std::optional<Manifest>& stimuli);

} // namespace obscura
