#pragma once

#include "bench/choose/choose.h"

namespace obscura {

// What a choice says: the chosen one and why, why each cheaper one failed, what dearer ones would
// add; or what came nearest, and what would admit it.
std::string choiceText(const SweepStudy& study, const Budget& budget, const Choice& choice);

// An Error when folder/choice.toml or study.toml is there and is none that writeChoice() wrote: it
// would be lost.
void requireOwnChoice(const std::filesystem::path& folder);

// folder/choice.toml: the chosen configuration as matched, ready for a protocol's `include`;
// choice.svg and .pdf: candidates by time and error, the limits, and the choice (figure.h);
// choice.csv: each candidate with its rung and verdict; choice-views.csv: what each measured one
// gave on each view; choice.json: what was asked, of which machine and program; study.toml: a study
// for `sweep` to check it by (study_file.h), of whose environment images `environments` is the
// folder.
void writeChoice(const std::filesystem::path& folder, const SweepStudy& study,
                 const std::filesystem::path& environments, const Budget& budget,
                 const Choice& choice);

} // namespace obscura
