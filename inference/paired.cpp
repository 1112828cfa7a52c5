#include "inference/paired.h"

#include "base/error.h"

#include "inference/ranks.h"
#include "inference/sums.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace obscura {

namespace {

Test chiSquareTest(double statistic, double df) {
    return {statistic, df, chiSquareP(statistic, df)};
}

double square(double x) { return x * x; }

// Sum over people of R (k - R): 0 when nobody changed his answer.
double changes(const AnswerTable& answers) {
    double total = 0;
    for (const std::vector<int>& person : answers) {
        const double chosen = std::accumulate(person.begin(), person.end(), 0);
        total += chosen * (static_cast<double>(person.size()) - chosen);
    }
    return total;
}

// From `origin`, so that scores which are all the same are exactly 0.
std::vector<double> scoresFrom(std::size_t origin, std::span<const double> scores,
                               std::size_t conditions) {
    if (scores.size() != conditions)
        throw Error(fmt::format("expected a score for each of {} conditions, found {}", conditions,
                                scores.size()));
    checkFinite(scores);
    std::vector<double> shifted;
    for (const double score : scores)
        shifted.push_back(score - scores[origin]);
    return shifted;
}

struct Totals {
    double a = 0, b = 0;
    double all() const { return a + b; }
    double share() const { return b / all(); }
    double variance() const { return a / all() * (b / all()); } // of one vote
};

Totals totalsOf(std::span<const Votes> conditions) {
    Totals totals;
    for (const Votes& votes : conditions) {
        totals.a += static_cast<double>(votes.a);
        totals.b += static_cast<double>(votes.b);
    }
    return totals;
}

} // namespace

McNemar mcnemar(PairedVotes votes) {
    const std::int64_t b = votes.firstOnly, c = votes.secondOnly;
    McNemar result{.firstOnly = b, .secondOnly = c, .uncorrected = {}, .corrected = {}};
    if (b + c == 0)
        return result;
    const auto changed = static_cast<double>(b + c),
               difference = static_cast<double>(std::abs(b - c));
    result.uncorrected = chiSquareTest(square(difference) / changed, 1);
    result.corrected = chiSquareTest(square(difference - 1) / changed, 1);
    result.exactP = exactP({c, b});
    result.midP = midP({c, b});
    return result;
}

Interval mcnemarBounds(std::int64_t people, std::int64_t first, std::int64_t second) {
    for (const std::int64_t chosen : {first, second})
        if (chosen < 0 || chosen > people)
            throw Error(
                fmt::format("expected 0 to {} people who chose b, found {}", people, chosen));
    const auto p = [&](std::int64_t both) {
        return mcnemar({.firstOnly = first - both, .secondOnly = second - both}).exactP;
    };
    return {p(std::min(first, second)), p(std::max<std::int64_t>(0, first + second - people))};
}

std::vector<double> columnTotals(const AnswerTable& answers) {
    std::vector<double> totals(answers.empty() ? 0 : answers.front().size());
    for (std::size_t person = 0; person < answers.size(); ++person) {
        if (answers[person].size() != totals.size())
            throw Error(
                fmt::format("expected {} answers of everybody, found {} of person {}; leave "
                            "out who did not answer every condition",
                            totals.size(), answers[person].size(), person + 1));
        for (std::size_t i = 0; i < totals.size(); ++i) {
            if (answers[person][i] != 0 && answers[person][i] != 1)
                throw Error(fmt::format("expected answers 0 and 1, found {} of person {}",
                                        answers[person][i], person + 1));
            totals[i] += answers[person][i];
        }
    }
    return totals;
}

std::optional<Test> cochranQ(const AnswerTable& answers) {
    const std::vector<double> totals = columnTotals(answers);
    const double changed = changes(answers);
    if (changed == 0)
        return std::nullopt;
    const auto k = static_cast<double>(totals.size());
    return chiSquareTest((k - 1) * k * sumOfSquares(totals, mean(totals)) / changed, k - 1);
}

std::optional<Test> pairedTrend(const AnswerTable& answers, std::span<const double> scores) {
    const std::vector<double> totals = columnTotals(answers);
    const std::vector<double> x = scoresFrom(0, scores, totals.size());
    const double changed = changes(answers), centre = mean(x), spread = sumOfSquares(x, centre);
    if (changed == 0 || spread == 0)
        return std::nullopt;
    double sum = 0;
    for (std::size_t i = 0; i < totals.size(); ++i)
        sum += totals[i] * (x[i] - centre);
    const auto k = static_cast<double>(totals.size());
    return chiSquareTest(square(sum) * k * (k - 1) / (spread * changed), 1);
}

std::optional<Test> homogeneity(std::span<const Votes> conditions) {
    const Totals totals = totalsOf(conditions);
    const auto used =
        static_cast<double>(std::count_if(conditions.begin(), conditions.end(),
                                          [](const Votes& votes) { return votes.total() > 0; }));
    if (used < 2 || totals.a == 0 || totals.b == 0)
        return std::nullopt;
    double statistic = 0;
    for (const Votes& votes : conditions)
        if (const auto n = static_cast<double>(votes.total()); n > 0)
            statistic +=
                square(static_cast<double>(votes.b) - n * totals.share()) / (n * totals.variance());
    return chiSquareTest(statistic, used - 1);
}

std::optional<Test> trend(std::span<const Votes> conditions, std::span<const double> scores) {
    const auto first = std::find_if(conditions.begin(), conditions.end(),
                                    [](Votes votes) { return votes.total() > 0; });
    const auto origin = first == conditions.end() ? 0 : first - conditions.begin();
    const std::vector<double> x =
        scoresFrom(static_cast<std::size_t>(origin), scores, conditions.size());
    const Totals totals = totalsOf(conditions);
    if (totals.a == 0 || totals.b == 0)
        return std::nullopt;
    double centre = 0, sum = 0, spread = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        centre += static_cast<double>(conditions[i].total()) * x[i] / totals.all();
    for (std::size_t i = 0; i < x.size(); ++i) {
        const auto n = static_cast<double>(conditions[i].total());
        sum += (x[i] - centre) * (static_cast<double>(conditions[i].b) - n * totals.share());
        spread += n * square(x[i] - centre);
    }
    if (spread == 0)
        return std::nullopt;
    return chiSquareTest(square(sum) / (totals.variance() * spread), 1);
}

std::optional<MantelHaenszel> mantelHaenszel(std::span<const FourfoldTable> strata) {
    double excess = 0, variance = 0;                  // of the first cell
    double r = 0, s = 0, pr = 0, crossed = 0, qs = 0; // as Robins, Breslow and Greenland have them
    for (const auto& [upper, lower] : strata) {
        const auto a = static_cast<double>(upper.b), b = static_cast<double>(upper.a);
        const auto c = static_cast<double>(lower.b), d = static_cast<double>(lower.a);
        const double n = a + b + c + d;
        if (n < 2)
            continue;
        excess += a - (a + b) * (a + c) / n;
        variance += (a + b) * (c + d) / n * (a + c) / n * (b + d) / (n - 1);
        r += a * d / n, s += b * c / n;
        pr += (a + d) / n * (a * d / n), qs += (b + c) / n * (b * c / n);
        crossed += (a + d) / n * (b * c / n) + (b + c) / n * (a * d / n);
    }
    if (variance == 0)
        return std::nullopt;
    MantelHaenszel result{.test = chiSquareTest(square(excess) / variance, 1), .logOddsRatio = {}};
    if (r > 0 && s > 0)
        result.logOddsRatio = {std::log(r / s), std::sqrt(pr / (2 * r * r) + crossed / (2 * r * s) +
                                                          qs / (2 * s * s))};
    return result;
}

namespace {

// Of the mean; absent where the values are the same but for what rounding leaves: R's limit.
std::optional<Estimate> meanOf(std::span<const double> values, double scale) {
    checkFinite(values);
    if (values.size() < 2)
        return std::nullopt;
    const double average = mean(values), squares = sumOfSquares(values, average);
    const auto n = static_cast<double>(values.size());
    const double error = std::sqrt(squares / (n - 1) / n);
    if (error <= 10 * DBL_EPSILON * std::max(std::abs(average), scale))
        return std::nullopt;
    return Estimate{average, error};
}

} // namespace

std::optional<Test> tTest(std::span<const double> values, double centre) {
    const auto estimate = meanOf(values, std::abs(centre));
    if (!estimate)
        return std::nullopt;
    const double t = (estimate->value - centre) / estimate->standardError;
    const double df = static_cast<double>(values.size()) - 1;
    return Test{t, df, studentP(t, df)};
}

Test centreTest(std::span<const double> values, double centre) {
    if (const auto t = tTest(values, centre))
        return *t;
    Votes sides;
    for (const double value : values)
        if (value != centre)
            ++(value > centre ? sides.b : sides.a);
    return {{}, {}, sides.total() > 0 ? exactP(sides) : 1};
}

std::optional<Interval> tInterval(std::span<const double> values, double confidence) {
    const auto estimate = meanOf(values, 0);
    if (!estimate)
        return std::nullopt;
    const double half =
        studentQuantile((1 + confidence) / 2, static_cast<double>(values.size()) - 1) *
        estimate->standardError;
    return Interval{estimate->value - half, estimate->value + half};
}

std::optional<Test> signedRankTest(std::span<const double> values, double centre) {
    checkFinite(values);
    std::vector<double> distances;
    std::vector<bool> above;
    for (const double value : values)
        if (value != centre) {
            distances.push_back(std::abs(value - centre));
            above.push_back(value > centre);
        }
    if (distances.empty())
        return std::nullopt;
    const Ranks ranks = rank(distances);
    double statistic = 0;
    for (std::size_t i = 0; i < above.size(); ++i)
        statistic += above[i] ? ranks.ranks[i] : 0;
    const auto n = static_cast<double>(distances.size());
    const double excess = statistic - n * (n + 1) / 4;
    const double sd = std::sqrt(n * (n + 1) * (2 * n + 1) / 24 - ranks.ties / 48);
    return Test{statistic, {}, normalP(std::max(std::abs(excess) - 0.5, 0.0) / sd)};
}

} // namespace obscura
