#include "analysis/scales/ladders.h"

#include <algorithm>

namespace obscura {

const char* const stimulusDifferenceName = "difference in mean occlusion";

std::optional<double> stimulusDifference(const Manifest* stimuli, const std::string& condition,
                                         const std::string& a, const std::string& b) {
    if (!stimuli)
        return std::nullopt;
    const auto found =
        std::find_if(stimuli->conditions.begin(), stimuli->conditions.end(),
                     [&](const ConditionRecord& record) { return record.condition == condition; });
    if (found == stimuli->conditions.end() || !found->find(a) || !found->find(b))
        return std::nullopt;
    return found->image(b).meanOcclusion - found->image(a).meanOcclusion;
}

namespace {

// Whether every step has a difference and, `inOrder`, all rise or all fall.
bool areUsable(const std::vector<Step>& steps, bool inOrder) {
    bool rise = true, fall = true;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!steps[i].difference)
            return false;
        rise = rise && (i == 0 || *steps[i].difference > *steps[i - 1].difference);
        fall = fall && (i == 0 || *steps[i].difference < *steps[i - 1].difference);
    }
    return !inOrder || rise || fall;
}

// Whether the share of successes falls with the level: the sign of their covariance.
bool falls(const PsychometricData& data) {
    const double trials = data.trials.sum();
    const double mean = data.level.dot(data.trials) / trials;
    const double share = data.successes.sum() / trials;
    return ((data.level.array() - mean) * (data.successes - share * data.trials).array()).sum() < 0;
}

} // namespace

void setLevels(Ladder& ladder, const std::vector<Step>& steps, bool mustFollowOrder) {
    ladder.isOrder = !areUsable(steps, mustFollowOrder);
    ladder.axis = ladder.isOrder ? "place on the ladder" : stimulusDifferenceName;
    const auto n = static_cast<Eigen::Index>(steps.size());
    ladder.data = {Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    ladder.labels.clear();
    for (Eigen::Index i = 0; i < n; ++i) {
        const Step& step = steps[static_cast<std::size_t>(i)];
        ladder.data.level(i) = ladder.isOrder ? static_cast<double>(i + 1) : *step.difference;
        ladder.data.successes(i) = step.successes;
        ladder.data.trials(i) = step.trials;
        ladder.labels.push_back(step.label);
    }
    ladder.isFalling = falls(ladder.data);
    if (ladder.isFalling)
        ladder.data.level = -ladder.data.level;
}

} // namespace obscura
