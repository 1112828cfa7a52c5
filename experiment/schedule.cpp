#include "experiment/schedule.h"

#include "base/random.h"
#include "protocols/reader/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <numeric>

namespace obscura {

namespace {

std::vector<int> counted(int count) {
    std::vector<int> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

// The square with its rows, its numbers and, if `columns`, its columns permuted.
LatinSquare permuted(const LatinSquare& square, bool columns, Random& random) {
    const int conditions = static_cast<int>(square.front().size());
    std::vector<int> rows = counted(static_cast<int>(square.size())), places = counted(conditions),
                     names = places;
    random.shuffle(rows);
    if (columns)
        random.shuffle(places);
    random.shuffle(names);

    LatinSquare result;
    for (const int row : rows) {
        result.emplace_back();
        for (const int place : places)
            result.back().push_back(names[static_cast<std::size_t>(
                square[static_cast<std::size_t>(row)][static_cast<std::size_t>(place)])]);
    }
    return result;
}

bool meets(const LatinSquare& before, const LatinSquare& after) {
    for (std::size_t row = 0; row < before.size(); ++row)
        if (before[row].back() == after[row].front())
            return true;
    return false;
}

} // namespace

LatinSquare cyclicSquare(int conditions) {
    LatinSquare square;
    for (const int row : counted(conditions)) {
        square.push_back(counted(conditions));
        for (int& cell : square.back())
            cell = (cell + row) % conditions;
    }
    return square;
}

LatinSquare permutedSquare(int conditions, std::uint64_t seed, int square) {
    Random random(seed, fmt::format("order/square {}", square));
    return permuted(cyclicSquare(conditions), true, random);
}

LatinSquare williamsSquare(int conditions) {
    LatinSquare square = cyclicSquare(conditions);
    for (std::vector<int>& row : square) {
        const std::vector<int> circle = row;
        for (std::size_t i = 0; i < row.size(); ++i) // 0, 1, -1, 2, -2, ...
            row[i] = circle[i % 2 ? (i + 1) / 2 : (row.size() - i / 2) % row.size()];
    }
    if (conditions % 2 == 0 || conditions == 1)
        return square;
    for (const int row : counted(conditions)) {
        const std::vector<int>& forwards = square[static_cast<std::size_t>(row)];
        square.push_back({forwards.rbegin(), forwards.rend()});
    }
    return square;
}

LatinSquare squareOf(OrderScheme scheme, int conditions, std::uint64_t seed, int square,
                     int repeat) {
    assert(scheme == OrderScheme::thesis || scheme == OrderScheme::latin ||
           scheme == OrderScheme::williams || scheme == OrderScheme::listed);
    if (scheme == OrderScheme::listed)
        return {counted(conditions)};
    const bool williams = scheme == OrderScheme::williams;
    if (repeat == 1) {
        if (scheme == OrderScheme::latin || (square > 1 && !williams))
            return permutedSquare(conditions, seed, square);
        if (square == 1)
            return williams ? williamsSquare(conditions) : cyclicSquare(conditions);
    }
    Random random(seed, fmt::format("order/square {} repeat {}", square, repeat));
    const LatinSquare base = williams ? williamsSquare(conditions) : cyclicSquare(conditions);
    LatinSquare drawn = permuted(base, !williams, random);
    if (repeat > 1 && conditions > 1) {
        const LatinSquare before = squareOf(scheme, conditions, seed, square, repeat - 1);
        while (meets(before, drawn))
            drawn = permuted(base, !williams, random);
    }
    return drawn;
}

LatinSquare exchangesOf(int roles) { return williamsSquare(roles); }

std::pair<int, int> crossed(int number, int m, int n) {
    // After the least common multiple of both, the same pairs would come again.
    const int shared = std::gcd(m, n);
    const int rounds = number / (m * (n / shared));
    return {number % m, (number + rounds % shared) % n};
}

Assignment assign(OrderScheme scheme, int conditions, int exchanges, int slot, int besides) {
    assert(conditions >= 1 && exchanges >= 1 && slot >= 1 && besides >= 1);
    const int rows = rowsOf(scheme, conditions), places = rows * exchanges;
    const auto [beside, place] = crossed(slot - 1, besides, places);

    Assignment assignment;
    assignment.slot = slot;
    assignment.square = (slot - 1) / (besides * places) + 1;
    assignment.row = place % rows + 1;
    assignment.exchange = place / rows;
    assignment.beside = beside;
    return assignment;
}

} // namespace obscura
