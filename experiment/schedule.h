#pragma once

#include "protocols/reader/ordering.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace obscura {

// The squares from which orders are taken, and a slot's place in them. A slot is one participant's
// place in the ordering scheme; slots are claimed from the ledger (ledger.h). Everything here is a
// pure function of numbers: sessions that run at the same time know nothing of each other.
// selection.h makes trials of it.
//
// `thesis` (thesis 5.4), for n conditions: a Latin square serves 2n slots. The first n take its
// rows in turn; the next n take the same rows with the two images of every pair exchanged. The
// first square is the cyclic one, each later one (for seven conditions: from slot 15) is drawn
// anew. The cyclic square has only n of the n (n - 1) ordered neighbours: who follows whom is the
// same for all.
//
// `latin`: every square is drawn; of the 2n slots the second n complement the first n, but who is
// shown exchanged pairs is crossed with the rows.
//
// `williams` (Williams 1949): a square in which, besides, every condition follows every other
// equally often. It has n rows for even n, 2n for odd n (no square of n rows is known to do it for
// every odd n), and serves twice as many slots: 28 for seven conditions.

// Rows of numbers, counted from 0: each once in every row and equally often in every column.
using LatinSquare = std::vector<std::vector<int>>;

// The square whose row r is r, r + 1, ..., going round in a circle.
LatinSquare cyclicSquare(int conditions);

// The cyclic square with its rows, columns and conditions permuted at random. This does not draw
// evenly from all squares of an order (Jacobson and Matthews 1996 would), but, like the thesis,
// asks only that positions be balanced. `square` numbers the draws.
LatinSquare permutedSquare(int conditions, std::uint64_t seed, int square);

// Row r is r, r + 1, r - 1, r + 2, ..., going round in a circle; for odd numbers of conditions, the
// same rows read backwards follow (Williams 1949). For one condition, one row.
LatinSquare williamsSquare(int conditions);

// The square by which the slots of `square` see their conditions for the `repeat`th time (both from
// 1). A repeat has a square of its own, in which no row begins with the condition that the same row
// ended with before (unless there is only one). Of the scheme `listed`, always the one row. Not for
// shuffles, whose orders are drawn, nor for schemes that go by the answers.
LatinSquare squareOf(OrderScheme scheme, int conditions, std::uint64_t seed, int square,
                     int repeat);

// The orders in which a trial's roles are shown, each role equally often at each place, and each
// equally often after each other: a Williams square of them. For pairs, {0, 1} and {1, 0}.
LatinSquare exchangesOf(int roles);

// Pairs (first of m, second of n), numbered from 0, so that both go round as fast as they can and
// the first m * n numbers have each pair once; then they come again.
std::pair<int, int> crossed(int number, int m, int n);

// A slot's place.
struct Assignment {
    int slot = 0;     // from 1
    int square = 0;   // from 1
    int row = 0;      // from 1
    int exchange = 0; // which of exchangesOf() the row begins with, from 0
    int beside = 0;   // which of what goes round at the same time, from 0
};

// Slots go through all rows with the first exchange, then with the next, and then to the next
// square. `exchanges` is their number. Where something else goes round at the same time (blocks, in
// `besides` orders), the two are crossed.
Assignment assign(OrderScheme scheme, int conditions, int exchanges, int slot, int besides = 1);

} // namespace obscura
