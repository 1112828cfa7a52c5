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

// Adds to `all` the clocks and dates of another run, whose folder an Error names if anything
// else differs: studies, programs, methods, machines. `first` says where those of `all` come from.
void joinMachines(SweepMachine& all, SweepMachine part, const std::string& first,
                  const std::filesystem::path& folder);

// "30 of the study's 180 rows; ..." of a sweep that was interrupted or lacks parts; "" of a whole
// one.
std::string incompleteness(const Sweep& sweep);

// Writes the parts of one study as one sweep, with their thumbnails, into a folder that has none.
// An Error says what was measured twice and where, or in what the parts differ.
Sweep mergeSweeps(const std::vector<std::filesystem::path>& parts,
                  const std::filesystem::path& folder);

} // namespace obscura
