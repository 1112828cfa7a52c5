#pragma once

#include "analysis/votes.h"

#include <optional>
#include <vector>

namespace obscura {

// A p below this is called a difference.
constexpr double significance = 0.05;

// Of one condition: the exact test's p, adjusted for its family, and what follows. The conditions
// of a hypothesis are a family, and so are those without one. Everything that says, shades or marks
// a difference asks here.
struct Verdict {
    double holm = 1;              // any false difference in the family: at most 5 %
    double benjaminiHochberg = 1; // of the differences called so, at most 5 % false on average
    bool differs = false;         // holm < significance
};

// Of each in turn; absent without votes.
std::vector<std::optional<Verdict>> verdictsOf(const std::vector<Tally>& tallies);

} // namespace obscura
