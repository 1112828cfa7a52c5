#pragma once

#include "protocols/reader/protocol.h"

#include <cstdint>
#include <vector>

namespace obscura {

// Who sees what in which order. A slot is one participant's place in the ordering scheme; slots
// are claimed from the ledger (ledger.h). Everything here is a pure function of the protocol's
// seed and the slot's number.
//
// Scheme `thesis` (thesis 5.4), for n conditions: a Latin square serves 2n slots. The first n take
// its rows in turn; the next n take the same rows with the two images of every pair exchanged. The
// first square is the cyclic one, each later one (for seven conditions: from slot 15) is drawn
// anew.

// Rows of conditions, counted from 0: each condition once in every row and every column.
using LatinSquare = std::vector<std::vector<int>>;

// The square whose row r is r, r + 1, ..., going round in a circle.
LatinSquare cyclicSquare(int conditions);

// The cyclic square with its rows, columns and conditions permuted at random. This does not draw
// evenly from all squares of an order (Jacobson and Matthews 1996 would), but, like the thesis,
// asks only that positions be balanced.
LatinSquare permutedSquare(int conditions, std::uint64_t seed, int square);

struct Assignment {
    int slot = 0;           // from 1
    int square = 0;         // from 1
    int row = 0;            // from 1
    bool reversed = false;  // member b of every pair comes first
    std::vector<int> order; // conditions as the protocol lists them, from 0
};

Assignment assign(OrderScheme scheme, int conditions, std::uint64_t seed, int slot);

} // namespace obscura
