#pragma once

#include "bench/sweep/row.h"
#include "bench/sweep/units.h"

#include <filesystem>

namespace obscura {

// A sweep as its finished units have it, whoever did them: rows in the study's order (view, size,
// configuration), each with its errors, its times or both; of times those of the kind of machine
// that timed most rows. Equal units give equal sweeps. `about`: study, program, display and rows.
Sweep assembled(const SweepStudy& study, const std::filesystem::path& folder, const Units& units,
                const SweepMachine& about);

// Makes a kind of machine known to assembled(), before any unit of it is done.
void addKind(const std::filesystem::path& folder, const std::string& kind);

} // namespace obscura
