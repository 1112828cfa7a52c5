#include "experiment/schedule.h"

#include "base/random.h"

#include <fmt/format.h>

#include <cassert>
#include <numeric>

namespace obscura {

namespace {

std::vector<int> counted(int count) {
    std::vector<int> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
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
    std::vector<int> rows = counted(conditions), columns = rows, names = rows;
    random.shuffle(rows);
    random.shuffle(columns);
    random.shuffle(names);

    LatinSquare result;
    for (const int row : rows) {
        result.emplace_back();
        for (const int column : columns)
            result.back().push_back(names[static_cast<std::size_t>((row + column) % conditions)]);
    }
    return result;
}

Assignment assign(OrderScheme scheme, int conditions, std::uint64_t seed, int slot) {
    assert(scheme == OrderScheme::thesis && conditions >= 1 && slot >= 1);
    (void)scheme; // the only one so far
    const int place = (slot - 1) % (2 * conditions);

    Assignment assignment;
    assignment.slot = slot;
    assignment.square = (slot - 1) / (2 * conditions) + 1;
    assignment.row = place % conditions + 1;
    assignment.reversed = place >= conditions;
    const LatinSquare square = assignment.square == 1
                                   ? cyclicSquare(conditions)
                                   : permutedSquare(conditions, seed, assignment.square);
    assignment.order = square[static_cast<std::size_t>(assignment.row - 1)];
    return assignment;
}

} // namespace obscura
