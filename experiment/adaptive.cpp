#include "experiment/adaptive.h"

#include "base/random.h"

#include "inference/pair_choice.h"
#include "inference/quest_plus.h"
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace obscura {

namespace {

// "" where it was interrupted, or left open.
std::string answerOf(const Protocol& protocol, const PastTrial& past) {
    const auto answer = past.answers.find(protocol.ordering.adaptive.answer);
    return past.interrupted || answer == past.answers.end() ? "" : answer->second;
}

bool isNarrow(const Adaptive& adaptive, double width) {
    return adaptive.width > 0 && width <= adaptive.width;
}

// The images as items of scales, and each condition as a pair of two of them.
struct Items {
    std::vector<ItemPair> pairs; // in the order of the conditions
    int count = 0;
};

Items itemsOf(const Protocol& protocol, std::span<const int> conditions) {
    std::map<std::tuple<std::string, std::string, std::string>, int> numbers;
    Items items;
    for (const int index : conditions) {
        const Condition& condition = conditionOf(protocol, index);
        const auto numberOf = [&](const std::string& shown) {
            const auto role = std::find_if(condition.roles.begin(), condition.roles.end(),
                                           [&](const Role& one) { return one.name == shown; });
            return numbers
                .try_emplace({condition.view, condition.level, role->technique},
                             static_cast<int>(numbers.size()))
                .first->second;
        };
        const int first = numberOf(protocol.trial.order.front());
        items.pairs.emplace_back(first, numberOf(protocol.trial.order.back()));
    }
    items.count = static_cast<int>(numbers.size());
    return items;
}

// "Not sure" is half a vote for each.
Wins winsOf(const Protocol& protocol, std::span<const int> conditions, const Items& items,
            std::span<const PastTrial> past) {
    Wins wins = Wins::Zero(items.count, items.count);
    for (const PastTrial& one : past) {
        const auto at = std::find(conditions.begin(), conditions.end(), one.trial.condition);
        const ItemPair& pair = items.pairs[static_cast<std::size_t>(at - conditions.begin())];
        const std::string answer = answerOf(protocol, one);
        const double first = answer == protocol.trial.order.front() ? 1
                             : answer == "unsure"                   ? 0.5
                                                                    : 0;
        const double second = answer == protocol.trial.order.back() ? 1
                              : answer == "unsure"                  ? 0.5
                                                                    : 0;
        wins(pair.first, pair.second) += first;
        wins(pair.second, pair.first) += second;
    }
    return wins;
}

// Of equals, as at first, that counts which comes first in an order drawn for the batch.
std::vector<int> batchOf(const PairPosterior& posterior, const Items& items, Random random) {
    std::vector<int> order(items.pairs.size());
    std::iota(order.begin(), order.end(), 0);
    random.shuffle(order);
    std::vector<ItemPair> pairs;
    for (const int index : order)
        pairs.push_back(items.pairs[static_cast<std::size_t>(index)]);
    std::vector<int> batch = nextBatch(posterior, pairs);
    for (int& index : batch)
        index = order[static_cast<std::size_t>(index)];
    random.shuffle(batch);
    return batch;
}

} // namespace

const Condition& conditionOf(const Protocol& protocol, int condition) {
    return protocol.conditions[static_cast<std::size_t>(condition)];
}

std::optional<int> questCondition(const Protocol& protocol, std::span<const int> conditions,
                                  std::span<const PastTrial> past) {
    const Adaptive& adaptive = protocol.ordering.adaptive;
    if (static_cast<int>(past.size()) >= adaptive.trials)
        return std::nullopt;
    std::map<double, int> byScore;
    for (std::size_t i = 0; i < conditions.size(); ++i)
        byScore[adaptive.scores[i]] = conditions[i];
    std::vector<double> levels;
    std::vector<int> ladder;
    for (const auto& [score, condition] : byScore) {
        levels.push_back(score);
        ladder.push_back(condition);
    }
    QuestPlus quest(questGrid(levels, adaptive.guess));
    for (const PastTrial& one : past) {
        const std::string answer = answerOf(protocol, one);
        const auto level = std::find(ladder.begin(), ladder.end(), one.trial.condition);
        if (!answer.empty())
            quest.answer(static_cast<int>(level - ladder.begin()),
                         answer == conditionOf(protocol, one.trial.condition).correct);
    }
    if (isNarrow(adaptive, quest.estimate(QuestParameter::threshold).width()))
        return std::nullopt;
    return ladder[static_cast<std::size_t>(quest.next())];
}

std::optional<int> informationCondition(const Protocol& protocol, int slot,
                                        std::span<const int> conditions,
                                        std::span<const PastTrial> past) {
    const Adaptive& adaptive = protocol.ordering.adaptive;
    if (static_cast<int>(past.size()) >= adaptive.trials)
        return std::nullopt;
    const Items items = itemsOf(protocol, conditions);
    const auto posteriorAfter = [&](std::size_t trials) {
        return pairPosterior(winsOf(protocol, conditions, items, past.first(trials)));
    };
    const std::size_t size = nextBatch(posteriorAfter(0), items.pairs).size();
    const std::size_t number = past.size() / size, place = past.size() % size;
    const PairPosterior posterior = posteriorAfter(number * size);
    if (place == 0 && isNarrow(adaptive, widestInterval(posterior, items.pairs)))
        return std::nullopt;
    const Random random(protocol.seed, fmt::format("order/slot {} batch {}", slot, number));
    return conditions[static_cast<std::size_t>(batchOf(posterior, items, random)[place])];
}

} // namespace obscura
