#pragma once

#include "renderer/probe.h"

namespace obscura {

// View depths (metres) as a buffer of fewer bits returns them.

// 11 significant bits.
float halfFloatDepth(float depth);
Probe::StoredDepth halfFloatDepths();

// The z-buffer's depth, 0 at a near plane of 0.1 m and 1 infinitely far away, in 24 bits. Reversing
// it changes nothing with whole numbers.
float fixedPointDepth(float depth);
Probe::StoredDepth fixedPointDepths();

} // namespace obscura
