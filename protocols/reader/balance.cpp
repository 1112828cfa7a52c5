#include "protocols/reader/balance.h"

#include <map>
#include <numeric>
#include <set>

namespace obscura {

namespace {

int sizeOf(const auto& items) { return static_cast<int>(items.size()); }

} // namespace

int rowsOf(OrderScheme scheme, int conditions) {
    switch (scheme) {
    case OrderScheme::thesis:
    case OrderScheme::latin:
        return conditions;
    case OrderScheme::williams:
        return conditions % 2 == 0 || conditions == 1 ? conditions : 2 * conditions;
    case OrderScheme::shuffle:
    case OrderScheme::listed:
    case OrderScheme::staircase:
    case OrderScheme::quest:
    case OrderScheme::information:
        break;
    }
    return 1;
}

const std::string& labelOf(const Condition& condition, Likeness likeness) {
    switch (likeness) {
    case Likeness::scene:
        return condition.view;
    case Likeness::level:
        return condition.level;
    case Likeness::condition:
        break;
    }
    return condition.id;
}

std::vector<int> mainConditions(const Protocol& protocol) {
    std::set<std::string> others(protocol.ordering.practice.begin(),
                                 protocol.ordering.practice.end());
    others.insert(protocol.ordering.catches.begin(), protocol.ordering.catches.end());
    std::vector<int> main;
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i)
        if (!others.contains(protocol.conditions[i].id))
            main.push_back(static_cast<int>(i));
    return main;
}

std::vector<std::vector<int>> blocksOf(const Protocol& protocol) {
    std::vector<std::vector<int>> blocks;
    std::map<std::string, std::size_t> numbers;
    for (const int condition : mainConditions(protocol)) {
        const std::string label =
            protocol.ordering.blocks
                ? labelOf(protocol.conditions[static_cast<std::size_t>(condition)],
                          *protocol.ordering.blocks)
                : "";
        const auto [at, isNew] = numbers.emplace(label, blocks.size());
        if (isNew)
            blocks.emplace_back();
        blocks[at->second].push_back(condition);
    }
    return blocks;
}

int balancedSlots(const Protocol& protocol) {
    const auto blocks = blocksOf(protocol);
    int rows = 1;
    for (const std::vector<int>& block : blocks)
        rows = std::lcm(rows, rowsOf(protocol.ordering.scheme, sizeOf(block)));
    // The images' own orders are a Williams square, too, and so is that of the blocks.
    return rows * rowsOf(OrderScheme::williams, sizeOf(protocol.trial.order)) *
           rowsOf(OrderScheme::williams, sizeOf(blocks));
}

} // namespace obscura
