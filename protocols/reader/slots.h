#pragma once

#include "base/process.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// The ledger of a study's data folder: a file of lines, one per change of a slot, that
// obscura-experiment writes (experiment/ledger.h) and others read.

// One person's one session: what a slot is claimed for, and what names its files.
struct SessionId {
    std::string participant; // letters and digits
    int number = 1;
    bool simulated = false;
    bool rehearsal = false; // claims no slot
};

enum class SlotState { reserved, completed, returned };
std::string_view nameOf(SlotState state); // "void" for returned: what experimenters call it

constexpr int highestSlot = 1000000;

// What became of a slot.
struct SlotRecord {
    int slot = 0; // from 1
    SlotState state = SlotState::reserved;
    SessionId session;
    std::string machine, time;
    int process = 0;
    std::optional<ProcessId> owner; // nothing in lines of version 1
    std::string design;             // SHA-256 of Study::design(); "" in lines of version 1
};

// Every line of a ledger; none where there is no file. A last line that is being written, or is
// torn, is left out. An Error with file and line at the first damaged one, and where lines are
// missing.
std::vector<SlotRecord> readSlots(const std::filesystem::path& file);

// Of such lines the last for each slot, by slot.
std::vector<SlotRecord> lastOfEach(const std::vector<SlotRecord>& history);

std::string slotLine(const SlotRecord& record); // ends with a line feed
bool isWholeSlotLine(std::string_view text);

} // namespace obscura
