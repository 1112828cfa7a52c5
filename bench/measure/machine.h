#pragma once

#include "bench/sweep/row.h"
#include "gl/context.h"
#include "gl/timer.h"

#include <string>
#include <string_view>

namespace obscura {

// Version, commit and a hash of the code that measures, for a commit alone does not tell what was
// edited since: "obscura 0.1.0 (abc123, code 0123abcd...)".
std::string programName();

// Hash of the benches' own code (code_hash.cmake).
std::string_view measuringCode();

// What times were measured on and when: driver, processor, the GPU's clocks where nvidia-smi tells
// them, else the processor's, program and date; `study` is the hash of the study's text.
SweepMachine machineOf(const gl::Driver& driver, const gl::TimingChoice& timing,
                       const std::string& study);

} // namespace obscura
