#pragma once

#include "protocols/reader/ordering.h"

#include <optional>
#include <span>

namespace obscura {

// What a trial was to a staircase; `none`: it was interrupted, and leads nowhere.
enum class Step { wrong, right, none };

// Levitt, "Transformed up-down methods in psychoacoustics", J. Acoust. Soc. Am. 49, 1971. The level
// of the next trial, from 0, the easiest, to `levels` - 1; std::nullopt: the staircase has ended.
// `down` right answers in a row lead to the next level, `up` wrong ones in a row back; then both
// are counted anew. Beyond the first and the last level there is nothing: such a step is not taken,
// and is no reversal. A reversal is a step in another direction than the step before. With 2 down
// and 1 up, levels settle where 70.7 % are right: where p squared is one half.
std::optional<int> nextLevel(const Staircase& staircase, int levels, std::span<const Step> steps);

} // namespace obscura
