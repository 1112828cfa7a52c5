#pragma once

#include "bench/sweep_row.h"
#include "renderer/gl/context.h"
#include "renderer/gl/timer.h"

namespace obscura {

// What times are times of: driver, processor, the GPU's clocks where nvidia-smi tells them, else
// the processor's, program and date; `study` is the hash of the study's text.
SweepMachine machineOf(const gl::Driver& driver, const gl::TimingChoice& timing,
                       const std::string& study);

} // namespace obscura
