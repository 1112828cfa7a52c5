#pragma once

#include "experiment/past_trial.h"
#include "protocols/reader/protocol.h"

#include <optional>
#include <span>

namespace obscura {

// Orders that go by the answers through inference/: which condition comes after the main trials
// `past`; std::nullopt: the session is at its end. `conditions` are those of main trials. Pure, as
// next() is (selection.h), and quick enough to be asked before each trial: a step takes less than
// a millisecond. An interrupted trial counts as one, and its answer for nothing.

// QUEST+ over the scores of the conditions: that with the least expected entropy.
std::optional<int> questCondition(const Protocol& protocol, std::span<const int> conditions,
                                  std::span<const PastTrial> past);

// Batches of the pairs that are expected to narrow the scales most, given the answers before the
// batch; each in an order drawn for the slot. Images of a scene and level that conditions lead from
// one to another have a scale of their own, and all scales are measured together.
std::optional<int> informationCondition(const Protocol& protocol, int slot,
                                        std::span<const int> conditions,
                                        std::span<const PastTrial> past);

// Counted from 0.
const Condition& conditionOf(const Protocol& protocol, int condition);

} // namespace obscura
