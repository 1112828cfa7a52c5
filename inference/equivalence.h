#pragma once

#include "inference/counts.h"

namespace obscura {

// Is the share of b as good as even? p = 1 of a test of difference never says so. At least one
// vote.

// Two one-sided exact tests (Schuirmann, J. Pharmacokinet. Biopharm. 15 (1987) 657) of the share
// of b within 1/2 -+ margin: max(P(X >= b | 1/2 - margin), P(X <= b | 1/2 + margin)); R's pbinom.
// 0 <= margin <= 1/2; at 0 it is at least 1/2.
double equivalenceP(Votes votes, double margin);

// The smallest margin that equivalenceP grants at `level` (0 < level < 1/2): the larger distance
// from 1/2 of the two limits of clopperPearson at confidence 1 - 2 level.
double smallestMargin(Votes votes, double level = 0.05);

} // namespace obscura
