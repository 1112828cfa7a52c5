#include "inference/equivalence.h"

#include "inference/tails.h"

#include <algorithm>
#include <cassert>

namespace obscura {

// P(X <= b | 1/2 + margin) is P(X >= a | 1/2 - margin): of the two, that of the larger count is
// the smaller.
double equivalenceP(Votes votes, double margin) {
    assert(margin >= 0 && margin <= 0.5);
    requireVotes(votes);
    return binomialUpper(std::min(votes.a, votes.b), votes.total(), 0.5 - margin);
}

double smallestMargin(Votes votes, double level) {
    assert(level > 0 && level < 0.5);
    const auto [low, high] = clopperPearson(votes.b, votes.total(), 1 - 2 * level);
    return std::max(0.5 - low, high - 0.5);
}

} // namespace obscura
