#include "analysis/scales/ladders.h"

#include <algorithm>
#include <set>
#include <utility>

namespace obscura {

namespace {

// What was boosted is no longer as far from the reference as it was rendered.
const StimulusMeasure measures[] = {
    {"difference in predicted JOD",
     [](const ImageRecord& image) {
         return image.quality && !image.derived ? std::optional(image.quality->jod) : std::nullopt;
     },
     true},
    {"difference in RMSE from the reference",
     [](const ImageRecord& image) {
         return image.quality && !image.derived ? std::optional(image.quality->rmse) : std::nullopt;
     },
     false},
    {"difference in mean occlusion",
     [](const ImageRecord& image) { return std::optional(image.meanOcclusion); }, false},
};

bool isKnownOfAll(const Manifest& stimuli, const StimulusMeasure& measure) {
    for (const ConditionRecord& condition : stimuli.conditions)
        for (const ImageRecord& image : condition.images)
            if (!measure.of(image))
                return false;
    return true;
}

} // namespace

std::vector<const StimulusMeasure*> stimulusMeasures(const Manifest* stimuli) {
    if (!stimuli)
        return {};
    if (isKnownOfAll(*stimuli, measures[0]))
        return {&measures[0], &measures[1]};
    return {&measures[2]};
}

std::optional<double> stimulusDifference(const Manifest& stimuli, const StimulusMeasure& measure,
                                         const std::string& condition, const std::string& a,
                                         const std::string& b) {
    const auto found =
        std::find_if(stimuli.conditions.begin(), stimuli.conditions.end(),
                     [&](const ConditionRecord& record) { return record.condition == condition; });
    if (found == stimuli.conditions.end() || !found->find(a) || !found->find(b))
        return std::nullopt;
    const auto ofA = measure.of(found->image(a)), ofB = measure.of(found->image(b));
    return ofA && ofB ? std::optional(*ofB - *ofA) : std::nullopt;
}

std::vector<std::optional<double>> differencesOf(const Manifest* stimuli,
                                                 const std::string& condition, const std::string& a,
                                                 const std::string& b) {
    std::vector<std::optional<double>> differences;
    for (const StimulusMeasure* measure : stimulusMeasures(stimuli))
        differences.push_back(stimulusDifference(*stimuli, *measure, condition, a, b));
    return differences;
}

namespace {

// Whether every step has a difference by this measure and all rise, or all fall.
bool isOrderly(const std::vector<Step>& steps, std::size_t measure) {
    bool rise = true, fall = true;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const auto& here = steps[i].differences[measure];
        if (!here)
            return false;
        rise = rise && (i == 0 || *here > *steps[i - 1].differences[measure]);
        fall = fall && (i == 0 || *here < *steps[i - 1].differences[measure]);
    }
    return rise || fall;
}

// Whether the share of successes falls with the level: the sign of their covariance.
bool falls(const PsychometricData& data) {
    const double trials = data.trials.sum();
    const double mean = data.level.dot(data.trials) / trials;
    const double share = data.successes.sum() / trials;
    return ((data.level.array() - mean) * (data.successes - share * data.trials).array()).sum() < 0;
}

} // namespace

std::optional<std::size_t> orderlyMeasure(const std::vector<Step>& steps) {
    const std::size_t count = steps.empty() ? 0 : steps.front().differences.size();
    for (std::size_t measure = 0; measure < count; ++measure)
        if (isOrderly(steps, measure))
            return measure;
    return std::nullopt;
}

void setLevels(Ladder& ladder, const std::vector<Step>& steps, const Manifest* stimuli,
               std::optional<std::size_t> measure) {
    ladder.isOrder = !measure;
    ladder.axis = "place on the ladder";
    if (measure) {
        const StimulusMeasure& known = *stimulusMeasures(stimuli)[*measure];
        ladder.axis = known.name;
        ladder.isPredicted = known.isPredicted;
    }
    const auto n = static_cast<Eigen::Index>(steps.size());
    ladder.data = {Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    ladder.labels.clear();
    for (Eigen::Index i = 0; i < n; ++i) {
        const Step& step = steps[static_cast<std::size_t>(i)];
        ladder.data.level(i) = measure ? *step.differences[*measure] : static_cast<double>(i + 1);
        ladder.data.successes(i) = step.successes;
        ladder.data.trials(i) = step.trials;
        ladder.labels.push_back(step.label);
    }
    ladder.isFalling = falls(ladder.data);
    if (ladder.isFalling)
        ladder.data.level = -ladder.data.level;
}

void addPairLadders(std::vector<Ladder>& ladders, const ScaleGroup& group,
                    const std::vector<Step>& steps, const Manifest* stimuli,
                    const std::string& success) {
    for (std::size_t measure = 0; measure < stimulusMeasures(stimuli).size(); ++measure) {
        std::set<double> differences;
        for (const Step& step : steps) {
            if (!step.differences[measure])
                return;
            differences.insert(*step.differences[measure]);
        }
        if (differences.size() < 3)
            continue;
        Ladder ladder{group};
        ladder.success = success;
        setLevels(ladder, steps, stimuli, measure);
        ladders.push_back(std::move(ladder));
    }
}

} // namespace obscura
