#include "stimuli/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace obscura {

std::vector<PlannedImage> plan(const Protocol& protocol) {
    std::vector<PlannedImage> images;
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i)
        for (int member : {0, 1}) {
            const Condition& condition = protocol.conditions[i];
            images.push_back({i, member,
                              fmt::format("{}_{}_{}.png", condition.id, member == 0 ? "a" : "b",
                                          condition.pair[static_cast<std::size_t>(member)])});
        }
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
