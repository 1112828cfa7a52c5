#include "base/error.h"
#include "tests/inference/trials.h"

#include "inference/agreement.h"
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

// Wins of None, Crytek24, Blizzard24, RayMarching30 of the 24 people of golden/tournament_trials.
const char* const tournament[] = {"1212", "1221", "0213", "1122", "1212", "1212", "1023", "1023",
                                  "1221", "2121", "1131", "1023", "1122", "0132", "2013", "2202",
                                  "0222", "1122", "0123", "0132", "1032", "2211", "0123", "1221"};

std::vector<std::int64_t> winsOf(const char* person) {
    return {person[0] - '0', person[1] - '0', person[2] - '0', person[3] - '0'};
}

TEST(CircularTriadsTest, OfTheTournamentAreThoseOfR) {
    std::int64_t triads = 0;
    double zeta = 0;
    for (const char* person : tournament) {
        const CircularTriads found = circularTriads(winsOf(person)).value();
        EXPECT_EQ(found.most, 2);
        triads += found.triads, zeta += found.zeta / 24;
    }
    EXPECT_EQ(triads, 25);
    EXPECT_NEAR(zeta, 0.479167, 5e-7);
}

TEST(ConcordanceTest, OfTheTournamentIsThatOfR) {
    std::vector<std::vector<double>> scores(24);
    for (std::size_t i = 0; i < 24; ++i)
        for (const std::int64_t wins : winsOf(tournament[i]))
            scores[i].push_back(static_cast<double>(wins));
    const Concordance found = concordance(scores).value();
    EXPECT_NEAR(found.w, 0.246359223301, 1e-12);
    EXPECT_NEAR(found.friedman.statistic.value(), 17.7378640777, 1e-10);
    EXPECT_EQ(found.friedman.df, 3);
    EXPECT_NEAR(found.friedman.p, 0.000498136648414, 1e-14);
}

// golden/tournament_matrix.csv; golden output D5.
TEST(KendallU, OfTheTournamentIsThatOfR) {
    const auto found = kendallU({{0, 10, 6, 6}, {14, 0, 10, 5}, {18, 14, 0, 12}, {18, 19, 12, 0}});
    ASSERT_TRUE(found && found->test);
    EXPECT_NEAR(found->u, 0.11231884058, 1e-11);
    EXPECT_NEAR(found->test->statistic.value(), 23.752066, 5e-7);
    EXPECT_NEAR(found->test->df.value(), 6.8430, 5e-5);
    EXPECT_NEAR(found->test->p, 0.0011215, 5e-8);
}

TEST(KendallU, ReachesFromEvenSplitsToUnanimity) {
    EXPECT_NEAR(kendallU({{0, 3, 3}, {3, 0, 3}, {3, 3, 0}})->u, -1.0 / 5, 1e-15);
    EXPECT_NEAR(kendallU({{0, 3, 2}, {2, 0, 3}, {3, 2, 0}})->u, -1.0 / 5, 1e-15);
    EXPECT_EQ(kendallU({{0, 9, 9}, {0, 0, 9}, {0, 0, 0}})->u, 1);
    EXPECT_FALSE(kendallU({{0, 1}, {1, 0}})->test); // two people
    EXPECT_TRUE(std::isfinite(kendallU({{0, 1'000'000'000}, {3, 0}})->u));
}

TEST(KendallU, IsAbsentForOnePersonAndUnequalPairs) {
    EXPECT_FALSE(kendallU({}));
    EXPECT_FALSE(kendallU({{0}}));
    EXPECT_FALSE(kendallU({{0, 1}, {0, 0}}));
    EXPECT_FALSE(kendallU({{0, 3, 3}, {3, 0, 3}, {3, 2, 0}}));
    EXPECT_THROW(kendallU({{0, 1}, {0}}), Error);
}

// All tournaments of five items: bit by bit who wins, and the circular among the ten triples.
struct Tournament {
    explicit Tournament(int code) {
        for (int i = 0; i < 5; ++i)
            for (int j = i + 1; j < 5; ++j, code /= 2) {
                beats[i][j] = code % 2 != 0, beats[j][i] = !beats[i][j];
                ++wins[beats[i][j] ? i : j];
            }
    }
    int circular() const {
        int count = 0;
        for (int i = 0; i < 5; ++i)
            for (int j = i + 1; j < 5; ++j)
                for (int k = j + 1; k < 5; ++k)
                    count += beats[i][j] == beats[j][k] && beats[j][k] == beats[k][i];
        return count;
    }
    bool beats[5][5] = {};
    std::vector<std::int64_t> wins = {0, 0, 0, 0, 0};
};

TEST(CircularTriadsTest, AreThoseOfAllTournamentsOfFive) {
    for (int code = 0; code < 1024; ++code) {
        const Tournament all(code);
        const CircularTriads found = circularTriads(all.wins).value();
        EXPECT_EQ(found.triads, all.circular());
        EXPECT_EQ(found.most, 5);
        EXPECT_NEAR(found.zeta, 1 - all.circular() / 5.0, 1e-15);
    }
}

TEST(CircularTriadsTest, AreAbsentForIncompleteTournaments) {
    for (const std::vector<std::int64_t>& wins :
         {std::vector<std::int64_t>{}, {0}, {0, 1}, {0, 1, 1}, {0, 0, 3}, {-1, 2, 2}})
        EXPECT_FALSE(circularTriads(wins));
}

// R 4.2.2, friedman.test(S), with ties and one person who ties everything.
TEST(ConcordanceTest, WithTiesIsThatOfR) {
    const std::vector<std::vector<double>> scores = {
        {3, 1, 2, 2}, {4, 1, 1, 2}, {1, 2, 3, 4}, {2, 2, 2, 2}, {5, 1, 4, 3}};
    const auto found = concordance(scores);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->friedman.statistic.value(), 4.97368421052632, 1e-13);
    EXPECT_NEAR(found->friedman.p, 0.173734288825469, 1e-14);
    EXPECT_NEAR(found->w, 0.331578947368421, 1e-14);
}

TEST(ConcordanceTest, OfUnanimityTiesAndNobody) {
    EXPECT_NEAR(concordance({{1, 2, 3}, {10, 20, 30}})->w, 1, 1e-15);
    EXPECT_NEAR(concordance({{1, 2, 3}, {3, 2, 1}})->w, 0, 1e-15);
    EXPECT_FALSE(concordance({}));
    EXPECT_FALSE(concordance({{1}, {2}}));
    EXPECT_FALSE(concordance({{4, 4, 4}, {1, 1, 1}}));
    EXPECT_THROW(concordance({{1, 2}, {1}}), Error);
    EXPECT_THROW(concordance({{1, 2}, {1, std::nan("")}}), Error);
}

// R: var(rowSums(X)) / sum(colMeans(X) * (1 - colMeans(X))); Cochran's Q of t(X).
TEST(VarianceRatioTest, IsThatOfR) {
    EXPECT_NEAR(betweenPersonVarianceRatio(trialAnswers())->ratio, 1.3001, 5e-5);
    const AnswerTable sample = {{1, 0, 1, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}, {0, 0, 0, 0},
                                {0, 1, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 1, 1},
                                {0, 1, 1, 1}, {1, 0, 1, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}};
    const auto found = betweenPersonVarianceRatio(sample);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->ratio, 1.39744552967693, 1e-13);
    EXPECT_NEAR(found->test.statistic.value(), 14.0909090909091, 1e-12);
    EXPECT_EQ(found->test.df, 11);
    EXPECT_NEAR(found->test.p, 0.228003870040477, 1e-13);
}

TEST(VarianceRatioTest, TellsCampsFromBalancedAnswers) {
    AnswerTable camps, balanced;
    for (int i = 0; i < 20; ++i) {
        camps.push_back({i % 2, i % 2, i % 2, i % 2});
        balanced.push_back({i % 2, 1 - i % 2, i % 2, 1 - i % 2});
    }
    EXPECT_LT(betweenPersonVarianceRatio(camps)->test.p, 1e-6);
    EXPECT_GT(betweenPersonVarianceRatio(camps)->ratio, 4);
    EXPECT_EQ(betweenPersonVarianceRatio(balanced)->ratio, 0);
    EXPECT_EQ(betweenPersonVarianceRatio(balanced)->test.p, 1);
}

TEST(VarianceRatioTest, IsAbsentWhereNothingVaries) {
    EXPECT_FALSE(betweenPersonVarianceRatio({}));
    EXPECT_FALSE(betweenPersonVarianceRatio({{1, 0}}));
    EXPECT_FALSE(betweenPersonVarianceRatio({{1, 0}, {1, 0}}));
    EXPECT_THROW(betweenPersonVarianceRatio({{1, 0}, {}}), Error);
}

TEST(RepeatAgreement, CountsPairsOfRepeats) {
    const Votes pairs =
        repeatAgreement(std::vector<Votes>{{2, 0}, {1, 1}, {0, 2}, {1, 3}, {1, 0}, {}});
    EXPECT_EQ(pairs.b, 1 + 0 + 1 + 3);
    EXPECT_EQ(pairs.a, 0 + 1 + 0 + 3);
    EXPECT_EQ(repeatAgreement({}).total(), 0);
}

} // namespace
} // namespace obscura
