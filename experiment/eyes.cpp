#include "experiment/eyes.h"

#include "protocols/reader/stimuli.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace obscura {

namespace {

constexpr double best = 10; // JOD of what cannot be told from the reference

// Which of two differences from b is the larger (MLDS); b lies between the two in order.
bool asksOfTriads(const Trial& trial) {
    return std::set(trial.order.begin(), trial.order.end()) == std::set<std::string>{"a", "c"} &&
           rolesOf(trial).contains("b");
}

int stepOf(double jods) { return static_cast<int>(std::lround(jods)); }

} // namespace

Eyes::Eyes(const Protocol& protocol, const Manifest& stimuli, Random random)
    : protocol_(protocol), display_(stimuli.display ? inWords(*stimuli.display) : ""),
      observer_{protocol.simulation.lapse, protocol.simulation.positionBias}, random_(random),
      triads_(asksOfTriads(protocol.trial)) {
    for (const Condition& condition : protocol.conditions) {
        std::map<std::string, double>& jods = jods_.emplace_back();
        for (const Role& role : condition.roles)
            if (isOrdered(protocol.trial, role.name) || (triads_ && role.name == "b"))
                jods[role.name] = predictedJod(stimuli, condition.id, role.name);
        asksForWorse_.push_back(asksForWorse(protocol, condition, stimuli));
    }
}

void Eyes::describe(nlohmann::ordered_json& model) const {
    model["lapse"] = observer_.lapse;
    model["predicted_by"] = "ColorVideoVDP";
    model["display"] = display_;
    model["look_deviation_jod"] = lookDeviation;
    model["unsure_within_jod"] = unsureWithin;
}

void Eyes::look(const Upcoming& trial) {
    lapsed_ = random_.uniform() < observer_.lapse;
    const auto condition = static_cast<std::size_t>(trial.planned.condition);
    std::map<std::string, double> seen = jods_.at(condition);
    for (auto& [role, worth] : seen)
        worth += lookDeviation * random_.normal();
    worths_.clear();
    scores_.clear();
    for (const std::string& role : trial.order) {
        worths_.push_back(seen.at(role));
        scores_.push_back(triads_                    ? std::abs(seen.at(role) - seen.at("b"))
                          : asksForWorse_[condition] ? -seen.at(role)
                                                     : seen.at(role));
    }
    if (scores_.size() == 2)
        scores_[1] += observer_.advantage();
}

std::optional<int> Eyes::answer(const Question& question, const std::vector<int>& ranked) const {
    if (lapsed_)
        return std::nullopt;
    switch (question.kind) {
    case Question::Kind::choice:
        return question.images ? std::optional(choice(question)) : std::nullopt;
    case Question::Kind::rank:
        return nextOf(ranked);
    case Question::Kind::scale:
    case Question::Kind::slider:
        return rating(question);
    case Question::Kind::number:
    case Question::Kind::text:
        break;
    }
    return std::nullopt;
}

int Eyes::choice(const Question& question) const {
    const auto first = std::max_element(scores_.begin(), scores_.end());
    for (auto other = scores_.begin(); !question.unsure.empty() && other != scores_.end(); ++other)
        if (other != first && *first - *other < unsureWithin)
            return static_cast<int>(question.options.size()) + 1;
    return static_cast<int>(first - scores_.begin()) + 1;
}

int Eyes::nextOf(const std::vector<int>& ranked) const {
    std::vector<double> left = scores_;
    for (const int place : ranked)
        left[static_cast<std::size_t>(place - 1)] = -std::numeric_limits<double>::infinity();
    return static_cast<int>(std::max_element(left.begin(), left.end()) - left.begin()) + 1;
}

// A step, or a tenth of a slider's range, is 1 JOD: of one image down from the top, which is for
// what cannot be told from the reference; of two, where the scale goes below 0, the second's
// advance from the middle.
std::optional<int> Eyes::rating(const Question& question) const {
    const bool isSlider = question.kind == Question::Kind::slider;
    const int steps = static_cast<int>(question.options.size());
    const double lowest = isSlider ? question.least : question.lowest;
    if (worths_.size() == 1)
        return isSlider ? std::clamp(stepOf(worths_[0]) - 1, 0, 9)
                        : std::clamp(steps + stepOf(worths_[0] - best), 1, steps);
    if (worths_.size() != 2 || lowest >= 0)
        return std::nullopt;
    const int advance = stepOf(worths_[1] - worths_[0] + observer_.advantage());
    return isSlider ? std::clamp(5 + advance, 0, 9)
                    : std::clamp(1 - question.lowest + advance, 1, steps);
}

} // namespace obscura
