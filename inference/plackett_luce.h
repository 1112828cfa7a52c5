#pragma once

#include "inference/scales.h"

#include <optional>
#include <span>
#include <vector>

namespace obscura {

// Items that somebody ordered, best first, each at most once; those that were not shown are left
// out. Items number from 0.
using Ranking = std::vector<int>;

// Plackett, Appl. Stat. 24 (1975) 193; Luce 1959: the best is chosen with probabilities
// proportional to the worths, then the best of the rest, and so on. Values are log worths; pairs
// alone give bradleyTerry(). There is no free share to compare with: the deviance is -2 log
// likelihood, and fitTest() is absent; equalityTest() holds. Absent where some set of items was
// never ranked above the others (Hunter, Ann. Stat. 32 (2004) 384).
std::optional<Scale> plackettLuce(int items, std::span<const Ranking> rankings);

// How often each item stands above each other.
Wins winsOf(int items, std::span<const Ranking> rankings);

} // namespace obscura
