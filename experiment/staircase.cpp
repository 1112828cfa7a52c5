#include "experiment/staircase.h"

namespace obscura {

std::optional<int> nextLevel(const Staircase& staircase, int levels, std::span<const Step> steps) {
    int level = 0, direction = 0, reversals = 0, right = 0, wrong = 0;
    for (const Step step : steps) {
        if (step == Step::none)
            continue;
        right = step == Step::right ? right + 1 : 0;
        wrong = step == Step::wrong ? wrong + 1 : 0;
        const int move = right == staircase.down ? 1 : wrong == staircase.up ? -1 : 0;
        if (move == 0)
            continue;
        right = wrong = 0;
        if (level + move < 0 || level + move >= levels)
            continue;
        level += move;
        reversals += direction == -move;
        direction = move;
    }
    if (reversals >= staircase.reversals || static_cast<int>(steps.size()) >= staircase.trials)
        return std::nullopt;
    return level;
}

} // namespace obscura
