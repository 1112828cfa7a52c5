#pragma once

#include "inference/counts.h"

#include <optional>
#include <span>

namespace obscura {

// Fisher's exact test of homogeneity of k x 2 totals (Freeman and Halton, Biometrika 38 (1951)
// 141): the probability, given the margins, of all tables no likelier than the one seen, by the
// bounds of Mehta and Patel, J. Am. Stat. Assoc. 78 (1983) 427. R's fisher.test, with its
// tolerance of 1e-7 for "no likelier". As homogeneity() it takes votes as independent.
// Absent where that is, and for tables too large to go through (more than 5000 votes, or about
// a second, as 10 conditions of 36): there the chi-square test is as good.
std::optional<double> fisherP(std::span<const Votes> conditions);

} // namespace obscura
