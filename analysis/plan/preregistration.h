#pragma once

#include "analysis/plan/plan.h"

#include <string>
#include <string_view>

namespace obscura {

// What stands before each sentence that only a person can write; the text begins with their number.
constexpr std::string_view toBeWritten = "**TO BE WRITTEN:**";

// Markdown: all that a protocol declares about its study, in words, to be registered before the
// first participant. `date`: such as "2026-11-29". The same protocol and date give the same text.
std::string preregistration(const Protocol& protocol, const Plan& plan, std::string_view date);

} // namespace obscura
