#include "experiment/selection.h"

#include "base/random.h"
#include "experiment/adaptive.h"
#include "experiment/staircase.h"
#include "protocols/reader/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>

namespace obscura {

namespace {

int numberOf(const Protocol& protocol, const std::string& id) {
    const auto at = std::find_if(protocol.conditions.begin(), protocol.conditions.end(),
                                 [&](const Condition& one) { return one.id == id; });
    return static_cast<int>(at - protocol.conditions.begin());
}

LatinSquare exchangesOf(const Protocol& protocol) {
    return obscura::exchangesOf(static_cast<int>(protocol.trial.order.size()));
}

std::vector<int> rolesOf(const Protocol& protocol, int exchange) {
    const LatinSquare exchanges = exchangesOf(protocol);
    return exchanges[static_cast<std::size_t>(exchange) % exchanges.size()];
}

int exchangeCount(const Protocol& protocol) {
    return static_cast<int>(exchangesOf(protocol).size());
}

// The conditions, each once, in an order in which no two neighbours have the same label, the last
// of the pass before included. Drawn one by one from those that leave such an order for the rest,
// each of them equally likely; not all orders are. The labels must allow it (ordering.cpp sees to
// that).
class Shuffle {
  public:
    Shuffle(const Protocol& protocol, std::vector<int> conditions, const std::string& purpose)
        : protocol_(protocol), conditions_(std::move(conditions)), random_(protocol.seed, purpose) {
    }

    std::vector<int> pass() {
        std::vector<int> left = conditions_, order;
        if (!protocol_.ordering.apart) {
            random_.shuffle(left);
            return left;
        }
        while (!left.empty()) {
            std::vector<std::size_t> possible;
            for (std::size_t i = 0; i < left.size(); ++i)
                if (leavesAnOrder(left, i))
                    possible.push_back(i);
            assert(!possible.empty());
            const std::size_t chosen =
                possible[random_.below(static_cast<std::uint32_t>(possible.size()))];
            last_ = label(left[chosen]);
            order.push_back(left[chosen]);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(chosen));
        }
        return order;
    }

  private:
    const std::string& label(int condition) const {
        return labelOf(conditionOf(protocol_, condition), *protocol_.ordering.apart);
    }

    // Conditions have an order if no label is more than half of them, rounded up. That of the
    // chosen one, which must not come first then, is never too many if this held before.
    bool leavesAnOrder(const std::vector<int>& left, std::size_t chosen) const {
        const std::string& taken = label(left[chosen]);
        if (taken == last_)
            return false;
        std::map<std::string, std::size_t> counts;
        for (const int condition : left)
            ++counts[label(condition)];
        --counts[taken];
        return std::all_of(counts.begin(), counts.end(),
                           [&](const auto& count) { return 2 * count.second <= left.size(); });
    }

    const Protocol& protocol_;
    std::vector<int> conditions_;
    Random random_;
    std::string last_; // label; "" before the first
};

std::vector<int> rowOf(const Protocol& protocol, const std::vector<int>& conditions,
                       const Assignment& place, int repeat) {
    const LatinSquare square =
        squareOf(protocol.ordering.scheme, static_cast<int>(conditions.size()), protocol.seed,
                 place.square, repeat);
    std::vector<int> order;
    for (const int index : square[static_cast<std::size_t>(place.row - 1)])
        order.push_back(conditions[static_cast<std::size_t>(index)]);
    return order;
}

// All presentations of a block's conditions.
std::vector<PlannedTrial> blockTrials(const Protocol& protocol, const std::vector<int>& conditions,
                                      const Assignment& place) {
    const Ordering& ordering = protocol.ordering;
    Shuffle shuffle(protocol, conditions,
                    fmt::format("order/slot {} of {}", place.slot, conditions.front()));
    std::vector<PlannedTrial> trials;
    for (int repeat = 1; repeat <= ordering.repeats; ++repeat) {
        const std::vector<int> order = ordering.scheme == OrderScheme::shuffle
                                           ? shuffle.pass()
                                           : rowOf(protocol, conditions, place, repeat);
        for (const int condition : order) {
            PlannedTrial trial{PlannedTrial::Kind::main, condition, {}, repeat};
            const auto index = std::find(conditions.begin(), conditions.end(), condition);
            trial.roles = rolesOf(protocol, ordering.scheme == OrderScheme::thesis
                                                ? place.exchange
                                                : place.exchange + place.row - 1 +
                                                      static_cast<int>(index - conditions.begin()));
            if (repeat % 2 == 0)
                std::reverse(trial.roles.begin(), trial.roles.end());
            trials.push_back(std::move(trial));
        }
    }
    return trials;
}

// All main trials of a fixed scheme.
std::vector<PlannedTrial> mainTrials(const Protocol& protocol, int slot) {
    const auto blocks = blocksOf(protocol);
    const LatinSquare orders = williamsSquare(static_cast<int>(blocks.size()));
    const int besides = static_cast<int>(orders.size());
    std::vector<PlannedTrial> trials;
    int number = 0;
    for (const int block : orders[static_cast<std::size_t>((slot - 1) % besides)]) {
        const auto& conditions = blocks[static_cast<std::size_t>(block)];
        const Assignment place =
            obscura::assign(protocol.ordering.scheme, static_cast<int>(conditions.size()),
                            exchangeCount(protocol), slot, besides);
        ++number;
        for (PlannedTrial& trial : blockTrials(protocol, conditions, place)) {
            trial.block = number;
            trials.push_back(std::move(trial));
        }
    }
    return trials;
}

int countOf(std::span<const PastTrial> history, PlannedTrial::Kind kind) {
    return static_cast<int>(
        std::count_if(history.begin(), history.end(),
                      [kind](const PastTrial& past) { return past.trial.kind == kind; }));
}

// A trial that is in no square.
PlannedTrial beside(const Protocol& protocol, const std::string& id, PlannedTrial::Kind kind,
                    int exchange) {
    return {kind, numberOf(protocol, id), rolesOf(protocol, exchange)};
}

// In the order listed; roles change from trial to trial and from slot to slot.
PlannedTrial practiceTrial(const Protocol& protocol, int slot, std::size_t index) {
    return beside(protocol, protocol.ordering.practice[index], PlannedTrial::Kind::practice,
                  slot - 1 + static_cast<int>(index));
}

// The list is gone through from an entry that changes from slot to slot; each time round, the roles
// of all change.
PlannedTrial catchTrial(const Protocol& protocol, int slot, int index) {
    const auto& catches = protocol.ordering.catches;
    const int count = static_cast<int>(catches.size());
    const auto [first, exchange] = crossed(slot - 1, count, exchangeCount(protocol));
    const int entry = (first + index) % count;
    PlannedTrial trial = beside(protocol, catches[static_cast<std::size_t>(entry)],
                                PlannedTrial::Kind::catchTrial, exchange + entry + index / count);
    trial.repeat = index / count + 1;
    return trial;
}

std::optional<int> staircaseCondition(const Protocol& protocol, std::span<const int> ladder,
                                      std::span<const PastTrial> past) {
    std::vector<Step> steps;
    for (const PastTrial& one : past) {
        const auto answer = one.answers.find(protocol.ordering.staircase.answer);
        const std::string& correct = conditionOf(protocol, one.trial.condition).correct;
        steps.push_back(one.interrupted                                            ? Step::none
                        : answer != one.answers.end() && answer->second == correct ? Step::right
                                                                                   : Step::wrong);
    }
    const auto level =
        nextLevel(protocol.ordering.staircase, static_cast<int>(ladder.size()), steps);
    return level ? std::optional(ladder[static_cast<std::size_t>(*level)]) : std::nullopt;
}

std::optional<int> nextCondition(const Protocol& protocol, int slot,
                                 std::span<const PastTrial> past) {
    const std::vector<int> conditions = mainConditions(protocol);
    switch (protocol.ordering.scheme) {
    case OrderScheme::quest:
        return questCondition(protocol, conditions, past);
    case OrderScheme::information:
        return informationCondition(protocol, slot, conditions, past);
    default:
        return staircaseCondition(protocol, conditions, past);
    }
}

// Of a scheme that goes by the answers. Roles are drawn for a group of slots, in each of which they
// are others: nobody can foresee them, and over the group each is equally often at each place.
std::optional<PlannedTrial> adaptiveTrial(const Protocol& protocol, int slot,
                                          std::span<const PastTrial> history) {
    std::vector<PastTrial> past;
    std::copy_if(history.begin(), history.end(), std::back_inserter(past),
                 [](const PastTrial& one) { return one.trial.kind == PlannedTrial::Kind::main; });
    const auto condition = nextCondition(protocol, slot, past);
    if (!condition)
        return std::nullopt;
    int repeat = 1;
    for (const PastTrial& one : past)
        repeat += one.trial.condition == *condition;
    const int exchanges = exchangeCount(protocol);
    Random random(protocol.seed,
                  fmt::format("order/slots {} trial {}", (slot - 1) / exchanges, past.size()));
    const int drawn = static_cast<int>(random.below(static_cast<std::uint32_t>(exchanges)));
    return PlannedTrial{PlannedTrial::Kind::main, *condition, rolesOf(protocol, drawn + slot - 1),
                        repeat};
}

// Whether something that comes after every `every` main trials comes after this many.
bool isDue(int mainTrials, int every) { return every > 0 && mainTrials % every == 0; }

// `main`: the main trial that comes next.
std::optional<PlannedTrial> withOthers(const Protocol& protocol, int slot,
                                       std::span<const PastTrial> history,
                                       std::optional<PlannedTrial> main) {
    const Ordering& ordering = protocol.ordering;
    if (history.size() < ordering.practice.size())
        return practiceTrial(protocol, slot, history.size());
    const int mainTrials = countOf(history, PlannedTrial::Kind::main);
    if (!main || mainTrials == 0)
        return main;
    const PlannedTrial& last = history.back().trial;
    std::optional<PlannedTrial> other;
    if (isDue(mainTrials, ordering.catchEvery) && last.kind == PlannedTrial::Kind::main)
        other = catchTrial(protocol, slot, countOf(history, PlannedTrial::Kind::catchTrial));
    else if (isDue(mainTrials, ordering.breakEvery) && last.kind != PlannedTrial::Kind::rest)
        other = PlannedTrial{PlannedTrial::Kind::rest};
    if (!other)
        return main;
    other->block = last.block;
    return other;
}

std::optional<PlannedTrial> atOf(const std::vector<PlannedTrial>& trials, int index) {
    const auto at = static_cast<std::size_t>(index);
    return at < trials.size() ? std::optional(trials[at]) : std::nullopt;
}

} // namespace

std::string_view nameOf(PlannedTrial::Kind kind) {
    switch (kind) {
    case PlannedTrial::Kind::practice:
        return "practice";
    case PlannedTrial::Kind::main:
        return "main";
    case PlannedTrial::Kind::catchTrial:
        return "catch";
    case PlannedTrial::Kind::rest:
        break;
    }
    return "break";
}

std::optional<PlannedTrial> next(const Protocol& protocol, int slot,
                                 std::span<const PastTrial> history) {
    const bool adaptive = adaptiveTrials(protocol.ordering) > 0;
    return withOthers(
        protocol, slot, history,
        adaptive ? adaptiveTrial(protocol, slot, history)
                 : atOf(mainTrials(protocol, slot), countOf(history, PlannedTrial::Kind::main)));
}

std::vector<PlannedTrial> planned(const Protocol& protocol, int slot) {
    std::vector<PlannedTrial> result;
    if (adaptiveTrials(protocol.ordering) > 0)
        return result;
    const auto main = mainTrials(protocol, slot);
    std::vector<PastTrial> history;
    while (const auto trial = withOthers(protocol, slot, history,
                                         atOf(main, countOf(history, PlannedTrial::Kind::main)))) {
        result.push_back(*trial);
        history.push_back({*trial, {}, false});
    }
    return result;
}

int longest(const Protocol& protocol) {
    const Ordering& ordering = protocol.ordering;
    const int most = adaptiveTrials(ordering);
    const int main =
        most > 0 ? most : ordering.repeats * static_cast<int>(mainConditions(protocol).size());
    const int catches = ordering.catchEvery > 0 ? (main - 1) / ordering.catchEvery : 0;
    return static_cast<int>(ordering.practice.size()) + main + catches;
}

Assignment assign(const Protocol& protocol, int slot) {
    const auto blocks = blocksOf(protocol);
    return assign(protocol.ordering.scheme, static_cast<int>(blocks.front().size()),
                  exchangeCount(protocol), slot,
                  static_cast<int>(williamsSquare(static_cast<int>(blocks.size())).size()));
}

} // namespace obscura
