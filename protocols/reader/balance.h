#pragma once

#include "protocols/reader/protocol.h"

#include <string>
#include <vector>

namespace obscura {

// How the conditions of a study are dealt out to its people, as far as numbers go; the orders are
// in experiment/schedule.h.

// The number of rows of a scheme's squares; 1 where it has none.
int rowsOf(OrderScheme scheme, int conditions);

// What trials of it have in common under [ordering]'s `blocks` and `apart`.
const std::string& labelOf(const Condition& condition, Likeness likeness);

// Conditions for main trials: those that are neither for practice nor to catch; counted from 0 as
// in the protocol, and in its order.
std::vector<int> mainConditions(const Protocol& protocol);

// The conditions of each block of main trials, in the order of the protocol; one block where none
// are asked for.
std::vector<std::vector<int>> blocksOf(const Protocol& protocol);

// After so many slots all that the ordering balances is balanced, the first time and ever again: a
// study's number of people is best a multiple of it.
int balancedSlots(const Protocol& protocol);

} // namespace obscura
