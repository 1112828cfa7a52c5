#pragma once

#include "bench/sweep/row.h"

#include <filesystem>

namespace obscura {

// A sweep as a folder: sweep.csv and growth.csv, a line for each row, sweep.json, the machine, and
// the thumbnails that rows name. Columns are in the order of the structures; times are in
// milliseconds and say so; an empty cell is NaN. What is read back equals what was written. A sweep
// of an earlier version is read too: numbers of columns that it lacks are NaN, and
// SweepMachine::formatVersion tells.

std::string sweepCsv(const std::vector<SweepRow>& rows);
std::string growthCsv(const std::vector<GrowthRow>& rows);

// Thumbnails are not written here; whoever makes a row writes its thumbnail.
void writeSweep(const std::filesystem::path& folder, const Sweep& sweep);

// An Error names file, line and column.
Sweep readSweep(const std::filesystem::path& folder);

} // namespace obscura
