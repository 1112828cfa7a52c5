#pragma once

#include "analysis/answer.h"
#include "protocols/reader/claims.h"
#include "protocols/reader/slots.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// Whose answers do not count, and why: by the rules that the protocol declares, by the ledger, and
// by a file. Excluded rows are kept, because every result is also told with them.

// Moves what does not count from `rows`, which may hold catch trials, to `excluded`; each row for
// the first reason that applies, whole people and sessions before single trials. `slots` are the
// ledger's lines (readSlots). `file`: a CSV with the columns
// participant_id,session_id,condition_id,reason, where an empty cell stands for all; a line that
// fits no row is an Error. "": none.
struct Exclusion {
    std::string participant, session; // "" and "": single trials of several
    std::string reason;
    int trials = 0; // main ones
};
struct Excluded {
    std::vector<Answer> rows;
    std::vector<Exclusion> reasons;
};
Excluded exclude(std::vector<Answer>& rows, const Declared& declared,
                 std::span<const SlotRecord> slots, const std::filesystem::path& file);

// Each rule that was declared, in words, for the report and for preregistration.
std::vector<std::string> inWords(const ExclusionRules& rules);

} // namespace obscura
