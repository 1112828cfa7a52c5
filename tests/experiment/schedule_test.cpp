#include "experiment/schedule.h"
#include "protocols/reader/balance.h"
#include "tests/experiment/order_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace obscura {
namespace {

using test::orderOf;
using test::orderStudy;
using Trials = std::vector<PlannedTrial>;

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
    const Protocol study = orderStudy(OrderScheme::thesis, 7);
    for (int slot = 1; slot <= 7; ++slot)
        EXPECT_EQ(orderOf(study, slot), golden[static_cast<std::size_t>(slot - 1)])
            << "slot " << slot;
}

// Written down from the program as it was before there were other schemes (commit c4250e3): studies
// that run must go on as they began.
TEST(Schedule, LaterSquaresOfTheThesisSchemeAreAsTheyWere) {
    const std::map<int, std::vector<int>> before = {{15, {2, 1, 6, 3, 7, 4, 5}},
                                                    {16, {4, 3, 1, 5, 6, 7, 2}},
                                                    {22, {2, 1, 6, 3, 7, 4, 5}},
                                                    {29, {3, 5, 2, 6, 7, 1, 4}},
                                                    {43, {1, 3, 7, 5, 4, 2, 6}}};
    const Protocol study = orderStudy(OrderScheme::thesis, 7, 20100);
    for (const auto& [slot, order] : before)
        EXPECT_EQ(orderOf(study, slot), order) << "slot " << slot;
}

// psychophysics.md 4, and shared golden/williams7.csv.
TEST(Schedule, WilliamsSquareOfSevenIsThePrintedOne) {
    const LatinSquare printed = {
        {1, 2, 7, 3, 6, 4, 5}, {2, 3, 1, 4, 7, 5, 6}, {3, 4, 2, 5, 1, 6, 7}, {4, 5, 3, 6, 2, 7, 1},
        {5, 6, 4, 7, 3, 1, 2}, {6, 7, 5, 1, 4, 2, 3}, {7, 1, 6, 2, 5, 3, 4}, {5, 4, 6, 3, 7, 2, 1},
        {6, 5, 7, 4, 1, 3, 2}, {7, 6, 1, 5, 2, 4, 3}, {1, 7, 2, 6, 3, 5, 4}, {2, 1, 3, 7, 4, 6, 5},
        {3, 2, 4, 1, 5, 7, 6}, {4, 3, 5, 2, 6, 1, 7}};
    const Protocol study = orderStudy(OrderScheme::williams, 7);
    for (int slot = 1; slot <= 28; ++slot)
        EXPECT_EQ(orderOf(study, slot), printed[static_cast<std::size_t>((slot - 1) % 14)])
            << "slot " << slot;
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
    const Protocol study = orderStudy(OrderScheme::thesis, 7);
    const std::vector<int> third = {3, 4, 5, 6, 7, 1, 2};
    EXPECT_EQ(orderOf(study, 3), third);
    EXPECT_EQ(orderOf(study, 10), third);
    for (const int slot : {3, 10})
        for (const PlannedTrial& trial : planned(study, slot))
            EXPECT_EQ(trial.reversed(), slot == 10);
    const Assignment tenth = assign(study, 10), seventeenth = assign(study, 17);
    EXPECT_EQ(tenth.square, 1);
    EXPECT_EQ(tenth.row, 3);
    EXPECT_EQ(tenth.exchange, 1);
    EXPECT_EQ(seventeenth.square, 2);
    EXPECT_EQ(seventeenth.row, 3);
    EXPECT_EQ(seventeenth.exchange, 0);
}

// psychophysics.md 4: base order by the parity of row and condition, and the second half of the
// slots complements the first.
TEST(Schedule, PairsOfTheRecommendedOrderGoByTheParityOfRowAndCondition) {
    const Protocol study = orderStudy(OrderScheme::williams, 7);
    for (int slot = 1; slot <= 14; ++slot) {
        const Trials base = planned(study, slot), exchanged = planned(study, slot + 14);
        for (std::size_t i = 0; i < 7; ++i) {
            EXPECT_EQ(base[i].reversed(), (slot + base[i].condition + 1) % 2 != 0);
            EXPECT_EQ(base[i].condition, exchanged[i].condition);
            EXPECT_NE(base[i].reversed(), exchanged[i].reversed());
        }
    }
}

// What a set of slots balances, counted from the trials themselves.
struct Counts {
    std::map<std::pair<int, std::size_t>, int> places;     // of condition and position
    std::map<std::pair<int, int>, int> neighbours;         // of condition and the next
    std::map<std::pair<int, bool>, int> exchanged;         // of condition and order of the pair
    std::map<std::tuple<int, std::size_t, bool>, int> all; // of condition, position, order
};

Counts countsOf(const Protocol& study, int firstSlot, int slots, int repeat = 1) {
    Counts counts;
    for (int slot = firstSlot; slot < firstSlot + slots; ++slot) {
        Trials trials = planned(study, slot);
        std::erase_if(trials, [&](const PlannedTrial& trial) { return trial.repeat != repeat; });
        for (std::size_t i = 0; i < trials.size(); ++i) {
            ++counts.places[{trials[i].condition, i}];
            ++counts.exchanged[{trials[i].condition, trials[i].reversed()}];
            ++counts.all[{trials[i].condition, i, trials[i].reversed()}];
            if (i > 0)
                ++counts.neighbours[{trials[i - 1].condition, trials[i].condition}];
        }
    }
    return counts;
}

template <typename Key>
void expectEven(const std::map<Key, int>& counts, int kinds, int each, const std::string& what) {
    EXPECT_EQ(counts.size(), static_cast<std::size_t>(kinds)) << what;
    for (const auto& [key, count] : counts)
        EXPECT_EQ(count, each) << what;
}

// Of the first set of slots, of a later one, and of each repeat.
TEST(Schedule, WilliamsBalancesPositionsNeighboursAndExchangesForTwoToTwelve) {
    for (int n = 2; n <= 12; ++n) {
        Protocol study = orderStudy(OrderScheme::williams, n);
        study.ordering.repeats = 3;
        const int rows = n % 2 == 0 ? n : 2 * n;
        for (const int set : {0, 1, 4})
            for (const int repeat : {1, 2, 3}) {
                const Counts counts = countsOf(study, 1 + set * 2 * rows, 2 * rows, repeat);
                const std::string what = fmt::format("{} conditions, repeat {}", n, repeat);
                expectEven(counts.places, n * n, 2 * rows / n, "places: " + what);
                expectEven(counts.neighbours, n * (n - 1), 2 * rows / n, "neighbours: " + what);
                expectEven(counts.exchanged, 2 * n, rows, "exchanges: " + what);
                expectEven(counts.all, 2 * n * n, rows / n, "all: " + what);
            }
    }
}

TEST(Schedule, LatinSchemesBalancePositionsAndExchangesForTwoToTwelve) {
    for (const OrderScheme scheme : {OrderScheme::thesis, OrderScheme::latin})
        for (int n = 2; n <= 12; ++n) {
            Protocol study = orderStudy(scheme, n);
            study.ordering.repeats = 2;
            for (const int set : {0, 1, 4})
                for (const int repeat : {1, 2}) {
                    const Counts counts = countsOf(study, 1 + set * 2 * n, 2 * n, repeat);
                    expectEven(counts.places, n * n, 2, "places");
                    expectEven(counts.exchanged, 2 * n, n, "exchanges");
                    expectEven(counts.all, 2 * n * n, 1, "all");
                }
        }
}

// psychophysics.md 4: only 7 of the 42 ordered neighbours occur in the cyclic square, each 6 times.
TEST(Schedule, TheThesisOrderCarriesSevenNeighboursOfFortyTwo) {
    expectEven(countsOf(orderStudy(OrderScheme::thesis, 7), 1, 7).neighbours, 7, 6, "thesis");
}

// Not in the cyclic square of the thesis, which all participants share.
TEST(Schedule, SquaresOfTheLatinSchemeAreDrawn) {
    const Protocol one = orderStudy(OrderScheme::latin, 7, 1),
                   other = orderStudy(OrderScheme::latin, 7, 2);
    EXPECT_NE(orderOf(one, 1), orderOf(other, 1));
    EXPECT_NE(orderOf(one, 1), orderOf(one, 15));
    EXPECT_EQ(orderOf(one, 1), orderOf(one, 8));
}

TEST(Schedule, ListedIsTheProtocolsOrderWithEveryOtherPairExchanged) {
    const Protocol study = orderStudy(OrderScheme::listed, 4);
    for (int slot = 1; slot <= 6; ++slot)
        EXPECT_EQ(orderOf(study, slot), (std::vector<int>{1, 2, 3, 4}));
    expectEven(countsOf(study, 1, 6).exchanged, 8, 3, "exchanges");
    EXPECT_NE(planned(study, 1)[0].reversed(), planned(study, 1)[1].reversed());
}

TEST(Schedule, LaterSquaresAreFreshSeededAndRepeatable) {
    EXPECT_EQ(permutedSquare(7, 5, 2), permutedSquare(7, 5, 2));
    EXPECT_NE(permutedSquare(7, 5, 2), permutedSquare(7, 5, 3));
    EXPECT_NE(permutedSquare(7, 5, 2), permutedSquare(7, 6, 2));
    EXPECT_NE(permutedSquare(7, 5, 2), cyclicSquare(7));
}

// Every repeat in another order, and no pair twice in a row.
TEST(Schedule, RepeatsAreInAFreshOrderAndMeetNothingTheyFollow) {
    for (const OrderScheme scheme :
         {OrderScheme::thesis, OrderScheme::latin, OrderScheme::williams})
        for (const int n : {2, 3, 7, 8})
            for (std::uint64_t seed = 0; seed < 20; ++seed) {
                const LatinSquare once = squareOf(scheme, n, seed, 1, 1),
                                  again = squareOf(scheme, n, seed, 1, 2),
                                  third = squareOf(scheme, n, seed, 1, 3);
                EXPECT_TRUE((once != again && again != third) || n <= 3);
                for (std::size_t row = 0; row < once.size(); ++row)
                    EXPECT_NE(once[row].back(), again[row].front());
            }
}

// Each of three or more roles, too, is at each place equally often.
TEST(Schedule, ExchangesOfRolesAreLatin) {
    EXPECT_EQ(exchangesOf(1), (LatinSquare{{0}}));
    EXPECT_EQ(exchangesOf(2), (LatinSquare{{0, 1}, {1, 0}}));
    for (const int roles : {3, 4, 5}) {
        std::map<std::pair<std::size_t, int>, int> counts;
        for (const auto& order : exchangesOf(roles))
            for (std::size_t place = 0; place < order.size(); ++place)
                ++counts[{place, order[place]}];
        expectEven(counts, roles * roles, roles % 2 ? 2 : 1, "roles");
    }
}

TEST(Schedule, CrossedGoesThroughEachPairOnceAndBothGoRoundFast) {
    for (int m = 1; m <= 12; ++m)
        for (int n = 1; n <= 12; ++n) {
            std::set<std::pair<int, int>> pairs;
            for (int i = 0; i < m * n; ++i) {
                const std::pair<int, int> pair = crossed(i, m, n);
                pairs.insert(pair);
                EXPECT_EQ(pair.first, i % m);
                EXPECT_EQ(pair, crossed(i + m * n, m, n));
                EXPECT_TRUE(pair.second >= 0 && pair.second < n);
            }
            EXPECT_EQ(pairs.size(), static_cast<std::size_t>(m * n)) << m << " x " << n;
        }
}

// What is counted here is what participants see, slot by slot, and knows nothing of the formula.
TEST(Schedule, IsBalancedAfterTheSlotsThatThePlanSays) {
    const std::tuple<OrderScheme, int, int> cases[] = {
        {OrderScheme::williams, 7, 28}, {OrderScheme::williams, 4, 8},
        {OrderScheme::latin, 7, 14},    {OrderScheme::thesis, 7, 14},
        {OrderScheme::listed, 5, 2},    {OrderScheme::shuffle, 5, 2}};
    for (const auto& [scheme, conditions, slots] : cases) {
        const Protocol study = orderStudy(scheme, conditions, 1);
        EXPECT_EQ(balancedSlots(study), slots);
        // How often a condition comes at a position, with one image first and with the other.
        std::map<std::pair<int, int>, std::map<bool, int>> shown;
        std::map<int, std::map<bool, int>> firsts;
        for (int slot = 1; slot <= slots; ++slot) {
            int position = 0;
            for (const PlannedTrial& trial : planned(study, slot)) {
                ++shown[{trial.condition, position++}][trial.reversed()];
                ++firsts[trial.condition][trial.reversed()];
            }
        }
        for (const auto& [condition, orders] : firsts)
            EXPECT_EQ(orders.at(false), orders.at(true)) << condition;
        if (scheme == OrderScheme::listed || scheme == OrderScheme::shuffle)
            continue;
        EXPECT_EQ(shown.size(), static_cast<std::size_t>(conditions * conditions));
        for (const auto& [place, orders] : shown)
            EXPECT_EQ(orders.at(false), slots / conditions / 2) << place.first;
    }
}

} // namespace
} // namespace obscura
