#pragma once

#include "bench/choose/choose.h"

namespace obscura {

// What a choice says: the chosen one, why each cheaper one failed, what dearer ones would add.
std::string choiceText(const SweepStudy& study, const Budget& budget, const Choice& choice);

// An Error when folder/choice.toml is there and is none that writeChoice() wrote: it would be lost.
void requireOwnChoice(const std::filesystem::path& folder);

// folder/choice.toml: the chosen configuration as matched, ready for a protocol's `include`;
// choice.svg and .pdf: candidates by time and error, the budget, the front and the choice;
// choice.csv: each candidate with its rung and verdict.
void writeChoice(const std::filesystem::path& folder, const SweepStudy& study, const Budget& budget,
                 const Choice& choice);

} // namespace obscura
