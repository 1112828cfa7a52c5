#pragma once

#include "experiment/selection.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace obscura::test {

// A study of which only the order matters: `conditions` of them, c1, c2, ..., all of one scene and
// level.
inline Protocol orderStudy(OrderScheme scheme, int conditions, std::uint64_t seed = 20100) {
    Protocol protocol;
    protocol.seed = seed;
    protocol.ordering.scheme = scheme;
    for (int i = 1; i <= conditions; ++i) {
        Condition condition;
        condition.id = fmt::format("c{}", i);
        condition.view = "box";
        condition.level = "low";
        protocol.conditions.push_back(condition);
    }
    return protocol;
}

// The conditions of a slot's main trials, counted from 1, as people print squares.
inline std::vector<int> orderOf(const Protocol& protocol, int slot) {
    std::vector<int> order;
    for (const PlannedTrial& trial : planned(protocol, slot))
        if (trial.kind == PlannedTrial::Kind::main)
            order.push_back(trial.condition + 1);
    return order;
}

} // namespace obscura::test
