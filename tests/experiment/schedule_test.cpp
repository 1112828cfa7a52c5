#include "experiment/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace obscura {
namespace {

void expectLatin(const LatinSquare& square, int n) {
    ASSERT_EQ(square.size(), static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < square.size(); ++i) {
        std::set<int> row(square[i].begin(), square[i].end()), column;
        for (const auto& other : square)
            column.insert(other.at(i));
        EXPECT_EQ(row.size(), static_cast<std::size_t>(n));
        EXPECT_EQ(column.size(), static_cast<std::size_t>(n));
        EXPECT_EQ(*row.begin(), 0);
        EXPECT_EQ(*row.rbegin(), n - 1);
    }
}

// shared golden/latin7_cyclic.csv
TEST(Schedule, FirstSquareIsTheCyclicOneOfTheGoldenFile) {
    const LatinSquare golden = {{1, 2, 3, 4, 5, 6, 7}, {2, 3, 4, 5, 6, 7, 1}, {3, 4, 5, 6, 7, 1, 2},
                                {4, 5, 6, 7, 1, 2, 3}, {5, 6, 7, 1, 2, 3, 4}, {6, 7, 1, 2, 3, 4, 5},
                                {7, 1, 2, 3, 4, 5, 6}};
    for (int slot = 1; slot <= 7; ++slot) {
        std::vector<int> order = assign(OrderScheme::thesis, 7, 99, slot).order;
        for (int& condition : order)
            ++condition;
        EXPECT_EQ(order, golden[static_cast<std::size_t>(slot - 1)]) << "slot " << slot;
    }
}

TEST(Schedule, SquaresAreLatinForAnyOrderAndSeed) {
    for (const int n : {1, 2, 3, 7, 10}) {
        expectLatin(cyclicSquare(n), n);
        for (std::uint64_t seed = 0; seed < 50; ++seed)
            expectLatin(permutedSquare(n, seed, 2), n);
    }
}

// psychophysics.md 4: participants 3, 10 and 17.
TEST(Schedule, WorkedExamplesOfTheThesisScheme) {
    const Assignment third = assign(OrderScheme::thesis, 7, 1, 3);
    EXPECT_EQ(third.order, (std::vector<int>{2, 3, 4, 5, 6, 0, 1}));
    EXPECT_FALSE(third.reversed);

    const Assignment tenth = assign(OrderScheme::thesis, 7, 1, 10);
    EXPECT_EQ(tenth.order, third.order);
    EXPECT_TRUE(tenth.reversed);
    EXPECT_EQ(tenth.square, 1);

    const Assignment seventeenth = assign(OrderScheme::thesis, 7, 1, 17);
    EXPECT_EQ(seventeenth.square, 2);
    EXPECT_EQ(seventeenth.row, 3);
    EXPECT_FALSE(seventeenth.reversed);
}

TEST(Schedule, HalvesOfASquareComplementEachOther) {
    for (const int n : {2, 5, 7})
        for (int slot = 1; slot <= 6 * n; ++slot) {
            const Assignment one = assign(OrderScheme::thesis, n, 7, slot);
            if (one.reversed)
                continue;
            const Assignment other = assign(OrderScheme::thesis, n, 7, slot + n);
            EXPECT_TRUE(other.reversed);
            EXPECT_EQ(one.order, other.order);
            EXPECT_EQ(one.square, other.square);
            EXPECT_EQ(one.row, other.row);
        }
}

// Over a multiple of 14 slots every condition is shown equally often in each position and in each
// order within its pair.
TEST(Schedule, TwentyEightSlotsAreBalanced) {
    std::vector<std::vector<int>> inPosition(7, std::vector<int>(7));
    std::vector<int> reversed(7);
    for (int slot = 1; slot <= 28; ++slot) {
        const Assignment assignment = assign(OrderScheme::thesis, 7, 3, slot);
        for (std::size_t position = 0; position < 7; ++position) {
            const auto condition = static_cast<std::size_t>(assignment.order[position]);
            ++inPosition[condition][position];
            reversed[condition] += assignment.reversed;
        }
    }
    for (std::size_t condition = 0; condition < 7; ++condition) {
        EXPECT_EQ(inPosition[condition], std::vector<int>(7, 4));
        EXPECT_EQ(reversed[condition], 14);
    }
}

TEST(Schedule, LaterSquaresAreFreshSeededAndRepeatable) {
    EXPECT_EQ(permutedSquare(7, 5, 2), permutedSquare(7, 5, 2));
    EXPECT_NE(permutedSquare(7, 5, 2), permutedSquare(7, 5, 3));
    EXPECT_NE(permutedSquare(7, 5, 2), permutedSquare(7, 6, 2));
    EXPECT_NE(permutedSquare(7, 5, 2), cyclicSquare(7));
}

} // namespace
} // namespace obscura
