#include "inference/agreement.h"

#include "base/error.h"

#include "inference/ranks.h"
#include "inference/sums.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <numeric>

namespace obscura {

namespace {

template <typename T>
void checkLengths(const std::vector<std::vector<T>>& rows, std::size_t expected) {
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].size() != expected)
            throw Error(fmt::format("expected {} numbers in each row of the table, found {} in row "
                                    "{}",
                                    expected, rows[i].size(), i + 1));
}

double pairsOf(std::int64_t n) { return static_cast<double>(n) * static_cast<double>(n - 1) / 2; }

// How many people compared each pair; absent if not all pairs alike.
std::optional<double> judgesOf(const std::vector<std::vector<std::int64_t>>& wins) {
    const std::int64_t judges = wins[0][1] + wins[1][0];
    for (std::size_t i = 0; i < wins.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (wins[i][j] + wins[j][i] != judges)
                return std::nullopt;
    return static_cast<double>(judges);
}

} // namespace

std::optional<CircularTriads> circularTriads(std::span<const std::int64_t> wins) {
    const auto t = static_cast<std::int64_t>(wins.size());
    std::int64_t sum = 0, squares = 0;
    for (const std::int64_t chosen : wins) {
        if (chosen < 0 || chosen >= t)
            return std::nullopt;
        sum += chosen, squares += chosen * chosen;
    }
    if (t < 3 || sum != t * (t - 1) / 2)
        return std::nullopt;
    CircularTriads result;
    result.triads = (t * (t - 1) * (2 * t - 1) / 6 - squares) / 2;
    result.most = t % 2 ? (t * t * t - t) / 24 : (t * t * t - 4 * t) / 24;
    result.zeta = 1 - static_cast<double>(result.triads) / static_cast<double>(result.most);
    return result;
}

std::optional<PairAgreement> kendallU(const std::vector<std::vector<std::int64_t>>& wins) {
    checkLengths(wins, wins.size());
    if (wins.size() < 2)
        return std::nullopt;
    const std::optional<double> judges = judgesOf(wins);
    if (!judges || *judges < 2)
        return std::nullopt;
    const double m = *judges, t = static_cast<double>(wins.size()), pairs = t * (t - 1) / 2;
    double agreeing = 0;
    for (std::size_t i = 0; i < wins.size(); ++i)
        for (std::size_t j = 0; j < wins.size(); ++j)
            agreeing += i == j ? 0 : pairsOf(wins[i][j]);
    PairAgreement result{.u = 8 * agreeing / (m * (m - 1) * t * (t - 1)) - 1, .test = {}};
    if (m < 3)
        return result;
    const double chance = 0.5 * m * (m - 1) / 2 * pairs * (m - 3) / (m - 2);
    const double statistic = 4 / (m - 2) * (agreeing - chance);
    const double df = pairs * m * (m - 1) / ((m - 2) * (m - 2));
    result.test = Test{statistic, df, chiSquareP(std::max(statistic, 0.0), df)};
    return result;
}

std::optional<Concordance> concordance(const std::vector<std::vector<double>>& scores) {
    if (scores.empty() || scores.front().size() < 2)
        return std::nullopt;
    checkLengths(scores, scores.front().size());
    const double m = static_cast<double>(scores.size());
    const double k = static_cast<double>(scores.front().size());
    std::vector<double> sums(scores.front().size());
    double ties = 0;
    for (const std::vector<double>& person : scores) {
        checkFinite(person);
        const Ranks ranks = rank(person);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += ranks.ranks[i];
        ties += ranks.ties;
    }
    const double most = m * m * (k * k * k - k) - m * ties;
    if (most == 0)
        return std::nullopt;
    const double w = 12 * sumOfSquares(sums, m * (k + 1) / 2) / most;
    const double statistic = m * (k - 1) * w;
    return Concordance{w, {statistic, k - 1, chiSquareP(statistic, k - 1)}};
}

std::optional<VarianceRatio> betweenPersonVarianceRatio(const AnswerTable& answers) {
    const std::vector<double> chosen = columnTotals(answers);
    if (answers.size() < 2)
        return std::nullopt;
    const auto m = static_cast<double>(answers.size());
    double expected = 0;
    for (const double people : chosen)
        expected += people / m * (1 - people / m);
    if (expected == 0)
        return std::nullopt;
    std::vector<double> numbers;
    for (const std::vector<int>& person : answers)
        numbers.push_back(std::accumulate(person.begin(), person.end(), 0));
    const double ratio = sumOfSquares(numbers, mean(numbers)) / (m - 1) / expected;
    const double q = ratio * (m - 1) * (m - 1) / m;
    return VarianceRatio{ratio, {q, m - 1, chiSquareP(q, m - 1)}};
}

Votes repeatAgreement(std::span<const Votes> cells) {
    Votes pairs;
    for (const Votes& cell : cells) {
        pairs.a += cell.a * cell.b;
        pairs.b += cell.a * (cell.a - 1) / 2 + cell.b * (cell.b - 1) / 2;
    }
    return pairs;
}

} // namespace obscura
