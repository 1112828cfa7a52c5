#pragma once

#include "bench/sweep/row.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// Sweeps put together: rows of one study that were measured by several processes, on several
// machines. Errors are the same on all machines but for rounding, and carry over; times are
// comparable only within one kind of machine.

// All that decides times: renderer and driver, processor, and the clock's name. "" where nothing
// was timed.
std::string kindOf(const TimedOn& machine);

// Of what each kind of machine timed, that which stays: that of most rows, and of equals the first.
// `notes` gets a sentence on each of the others: what is left out, and how to have it measured
// where the kept ones were.
struct TimedKind {
    TimedOn machine;
    std::size_t rows = 0;
};
std::size_t keptKind(std::span<const TimedKind> kinds, std::string& notes);

// Adds a run's clock rates, date, renderer or notes to others, "a; b"; of many, the first few.
void addTo(std::string& list, const std::string& one);

// Adds to `all` what another run was measured on and with, whose folder an Error names if they are
// of different studies, programs (which may differ in what does not measure) or displays. `first`
// says where those of `all` come from. Both are of one kind of machine, or either timed nothing.
void joinMachines(SweepMachine& all, const SweepMachine& part, const std::string& first,
                  const std::filesystem::path& folder);

// What a sweep lacks, "30 of the study's 180 rows, ...; 12 rows without times", and how to have it
// measured; "" of a whole one.
std::string incompleteness(const Sweep& sweep);

// Writes the parts of one study as one sweep, with their thumbnails, into a folder that has none.
// A row's errors and times may come from different parts. An Error says what was measured twice and
// where, or in what the parts differ.
Sweep mergeSweeps(const std::vector<std::filesystem::path>& parts,
                  const std::filesystem::path& folder);

} // namespace obscura
