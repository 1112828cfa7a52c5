#include "stimuli/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace obscura {

std::vector<PlannedImage> plan(const Protocol& protocol) {
    std::vector<PlannedImage> images;
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i)
        for (const Role& role : protocol.conditions[i].roles)
            images.push_back({i, static_cast<int>(&role - protocol.conditions[i].roles.data()),
                              fmt::format("{}_{}_{}.png", protocol.conditions[i].id, role.name,
                                          role.technique)});
    const auto load = [&](const PlannedImage& image) {
        const Condition& condition = protocol.conditions[image.condition];
        const View& view = protocol.view(condition.view);
        return std::tie(view.file, view.builtin, condition.level);
    };
    std::stable_sort(
        images.begin(), images.end(),
        [&](const PlannedImage& a, const PlannedImage& b) { return load(a) < load(b); });
    return images;
}

} // namespace obscura
