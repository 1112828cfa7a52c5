#include "analysis/tests/tests.h"

#include "inference/agreement.h"
#include "inference/multiplicity.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace obscura {

namespace {

constexpr double level = 0.05; // below which words say "more than chance"

// What a ratio can tell. Camps that are of one opinion throughout make people's totals vary; camps
// whose opinions differ from condition to condition do not, and only repeats show them.
std::string meaningOf(const VarianceRatio& ratio, bool repeats) {
    if (ratio.test.p < level)
        return "people are of different opinions: an even split may be two camps, not guessing";
    return repeats
               ? "could be chance; camps that differ anew in each condition look so, too"
               : "could be chance: an even split looks like guessing, but without repeats camps "
                 "that differ anew in each condition look so, too";
}

// What all repeats together tell of even splits.
std::string meaningOf(const Votes& agreement, double p) {
    if (p >= level)
        return "as guessing would: no firm opinions can be seen";
    return agreement.b > agreement.a
               ? "people are of firm opinions: even splits are camps rather than guessing"
               : "people contradict themselves more than guessing would: look at positions";
}

// The repeats of one condition: each person's votes, and how many pairs of them were in one order.
struct Repeats {
    std::vector<Votes> cells;
    std::int64_t sameOrder = 0;

    bool onlyPairs() const {
        return std::all_of(cells.begin(), cells.end(),
                           [](const Votes& cell) { return cell.total() <= 2; });
    }
};

std::vector<Repeats> repeatsOf(const StudyData& data) {
    std::map<std::uint32_t, std::size_t> places;
    for (std::size_t i = 0; i < data.tallies.size(); ++i)
        places[Symbol(data.tallies[i].condition).number()] = i;
    struct Cell {
        Votes votes, orders; // orders: a is first, or second
    };
    std::map<std::pair<std::size_t, std::uint64_t>, Cell> cells;
    for (const Answer& answer : *data.answers) {
        Cell& cell = cells[{places.at(answer.row.conditionId.number()), answer.row.person()}];
        ++(answer.row.choseB ? cell.votes.b : cell.votes.a);
        ++(answer.row.aFirst ? cell.orders.a : cell.orders.b);
    }
    std::vector<Repeats> repeats(data.tallies.size());
    for (const auto& [key, cell] : cells) {
        Repeats& condition = repeats[key.first];
        condition.cells.push_back(cell.votes);
        const auto [a, b] = cell.orders;
        condition.sameOrder += (a * (a - 1) + b * (b - 1)) / 2;
    }
    return repeats;
}

std::optional<Test> testOf(const Repeats& repeats, const Votes& agreement) {
    if (agreement.total() == 0)
        return std::nullopt;
    if (repeats.onlyPairs())
        return Test{std::nullopt, std::nullopt, exactP(agreement)};
    const double statistic = chiSquare(agreement);
    return Test{statistic, 1, chiSquareP(statistic)};
}

// Who always takes the same place agrees with himself where the order is the same, and disagrees
// where it is the other.
std::string orderNote(const Repeats& repeats, const Votes& agreement) {
    if (repeats.sameOrder == 0)
        return "all repeats were in the other order";
    return fmt::format(
        "{} of {} pairs were shown in the same order, where a bias of position looks "
        "like an opinion",
        repeats.sameOrder, agreement.total());
}

std::string shareOf(const Votes& agreement) {
    return fmt::format("{} of {} pairs of repeats agree ({:.0f} %)", agreement.b, agreement.total(),
                       100.0 * static_cast<double>(agreement.b) /
                           static_cast<double>(agreement.total()));
}

// An even split is guessing, or two camps, each of an opinion.
std::string meaningOf(const Votes& votes, const Votes& agreement, double p) {
    const bool even = exactP(votes) >= level;
    if (p >= level)
        return even ? "as guessing would: no opinion can be seen"
                    : "people need not be of firm opinions";
    if (agreement.b < agreement.a)
        return "people contradict themselves more than guessing would: look at positions";
    return even ? "opposed camps: people split, but are of firm opinions" : "firm opinions";
}

} // namespace

std::vector<StudyTest> varianceTests(const StudyData& data) {
    Group all;
    for (std::size_t i = 0; i < data.tallies.size(); ++i)
        if (data.tallies[i].votes.total() > 0)
            all.push_back(i);
    const AnswerTable complete = completeOf(data, all);
    const auto ratio = data.answers && complete.size() > 1 && all.size() > 1
                           ? betweenPersonVarianceRatio(complete)
                           : std::nullopt;
    if (!ratio)
        return {};
    return {
        {fmt::format("people's numbers of b vary {:.2f} times as much as chance", ratio->ratio),
         ratio->test,
         joined({meaningOf(*ratio, data.repeats),
                 data.repeats ? "the first answer of each counts" : "", leftOut(data, complete)})}};
}

std::vector<StudyTest> repeatTests(const StudyData& data) {
    if (!data.answers || !data.repeats)
        return {};
    Repeats all;
    for (const Repeats& one : repeatsOf(data)) {
        all.cells.insert(all.cells.end(), one.cells.begin(), one.cells.end());
        all.sameOrder += one.sameOrder;
    }
    const Votes agreement = repeatAgreement(all.cells);
    const auto test = testOf(all, agreement);
    return {{shareOf(agreement), test,
             joined({meaningOf(agreement, test ? test->p : 1), orderNote(all, agreement)})}};
}

std::vector<StudyTest> conditionRepeatTests(const StudyData& data) {
    if (!data.answers || !data.repeats)
        return {};
    const std::vector<Repeats> repeats = repeatsOf(data);
    std::vector<StudyTest> tests;
    std::vector<std::pair<std::size_t, Votes>> of;
    std::vector<double> p;
    for (std::size_t i = 0; i < repeats.size(); ++i) {
        const Votes agreement = repeatAgreement(repeats[i].cells);
        const auto test = testOf(repeats[i], agreement);
        if (!test)
            continue;
        const auto& [a, b] = data.tallies[i].votes;
        tests.push_back({fmt::format("{}: {} : {} votes, {}", data.tallies[i].condition, a, b,
                                     shareOf(agreement)),
                         test, orderNote(repeats[i], agreement)});
        of.emplace_back(i, agreement);
        p.push_back(test->p);
    }
    const std::vector<double> adjusted = holm(p);
    for (std::size_t i = 0; i < tests.size(); ++i)
        tests[i].note = joined(
            {meaningOf(data.tallies[of[i].first].votes, of[i].second, adjusted[i]), tests[i].note});
    return tests;
}

} // namespace obscura
