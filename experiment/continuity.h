#pragma once

#include "experiment/data_folder.h"
#include "experiment/study.h"

#include <string>
#include <vector>

namespace obscura {

// Whether a session that begins now continues the study whose data lie in the folder. Sessions are
// known from the ledger and, should it be lost, from what lies beside it: sidecars, journals and
// rows.

// An Error when the design is another than that of the sessions before, saying what has changed, or
// when the ledger does not know all of them. Gives what could not be compared, since earlier
// versions did not keep it; "" for nothing.
std::string checkContinues(const DataFolder& folder, const Study& study);

// Keeps the study's design beside its first session, for checkContinues to tell what has changed.
void keepDesign(const DataFolder& folder, const Study& study);

// Sessions beside the ledger that it does not know, as the lines that it should have, those that
// fill gaps in the order of slots among them.
std::vector<SlotRecord> lostFromLedger(const DataFolder& folder);

} // namespace obscura
