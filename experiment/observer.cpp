#include "experiment/observer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

constexpr double refreshHz = 60;
constexpr double quickest = 0.15; // seconds; nobody sees and reacts faster
constexpr double keyDown = 0.08;  // seconds for which a key is held

// The first option with which the session goes on, from 0.
int admitted(const Question& question) {
    const auto option =
        std::find(question.options.begin(), question.options.end(), question.endsUnless.front());
    return static_cast<int>(option - question.options.begin());
}

} // namespace

const std::string& Upcoming::role(const std::string& image) const {
    for (std::size_t i = 0; i < order.size(); ++i)
        if (image == fmt::format("{}", i + 1))
            return order[i];
    return image;
}

SimulatedObserver::SimulatedObserver(const Protocol& protocol, std::uint64_t seed,
                                     const std::string& participant)
    : protocol_(protocol), phases_(phasesOf(protocol.trial)), seed_(seed),
      random_(seed, "observer/" + participant) {}

Refresh SimulatedObserver::refresh() const {
    return {refreshHz, "none", "simulated: a clock without a display"};
}

void SimulatedObserver::describe(nlohmann::ordered_json& sidecar) const {
    const Simulation& model = protocol_.simulation;
    const auto spell = [](const ExGaussian& time) {
        return nlohmann::ordered_json{
            {"mean_s", time.mean}, {"deviation_s", time.deviation}, {"tail_s", time.tail}};
    };
    sidecar["model"] = {{"seed", seed_},
                        {"position_bias", model.positionBias},
                        {"view", spell(model.view)},
                        {"decision", spell(model.decision)}};
}

void SimulatedObserver::prepare(const Upcoming& trial) {
    page_ = nullptr;
    const Condition& condition =
        protocol_.conditions.at(static_cast<std::size_t>(trial.planned.condition));
    const double preferSecond =
        trial.order.front() == "b" ? 1 - condition.simulated.chooseB : condition.simulated.chooseB;
    chooseSecond_ = std::clamp(preferSecond + protocol_.simulation.positionBias, 0.0, 1.0);
}

double SimulatedObserver::show(const TrialMachine& trial) {
    trial_ = &trial;
    clock_ = (std::floor(clock_ * refreshHz + 1e-6) + 1) / refreshHz;
    return clock_;
}

std::vector<Event> SimulatedObserver::events(bool wait) {
    if (!wait || !trial_)
        return {};
    if (const Form* form = trial_->form())
        return answer(*form);
    const Phase& phase = page_ ? *page_ : phases_[static_cast<std::size_t>(trial_->screen())];
    const auto go = static_cast<gl::Key>(protocol_.keys.go.front());
    if (phase.images.empty())
        return press(go, draw(protocol_.simulation.decision));
    return press(go, std::max(phase.atLeast + quickest, draw(protocol_.simulation.view)));
}

// Which image of a pair looks better is the model's; all other questions are answered at random,
// but never so that the session ends.
std::vector<Event> SimulatedObserver::answer(const Form& form) {
    const double after = draw(protocol_.simulation.decision);
    if (form.answered(static_cast<std::size_t>(form.focus())))
        return press(gl::Key::enter, after); // to the next, or the end
    const Question& question = form.questions()[static_cast<std::size_t>(form.focus())];
    const auto digit = [&](int number) {
        const Keys& keys = protocol_.keys;
        if (isOfTwo(question) && number <= 2)
            return static_cast<gl::Key>((number == 1 ? keys.first : keys.second).front());
        return static_cast<gl::Key>(static_cast<int>(gl::Key::zero) + number % 10);
    };
    switch (question.kind) {
    case Question::Kind::choice:
        if (question.images && question.options.size() == 2 && question.unsure.empty())
            return press(digit(random_.uniform() < chooseSecond_ ? 2 : 1), after);
        [[fallthrough]];
    case Question::Kind::scale:
        if (!question.endsUnless.empty())
            return press(digit(1 + admitted(question)), after);
        [[fallthrough]];
    case Question::Kind::rank:
        return press(digit(1 + static_cast<int>(random_.below(
                                   static_cast<std::uint32_t>(form.optionsOf(question))))),
                     after);
    case Question::Kind::slider:
        return press(digit(static_cast<int>(random_.below(10))), after);
    case Question::Kind::number:
    case Question::Kind::text:
        break;
    }
    return type(question, after);
}

// A number in the middle of the range, or a letter.
std::vector<Event> SimulatedObserver::type(const Question& question, double after) {
    clock_ += after;
    std::vector<Event> events;
    const bool number = question.kind == Question::Kind::number;
    for (const char letter :
         number ? fmt::format("{}", (question.least + question.most) / 2) : "x") {
        Event event{Event::Kind::text, clock_};
        event.symbol = static_cast<unsigned char>(letter);
        events.push_back(event);
    }
    return events;
}

std::vector<Event> SimulatedObserver::press(gl::Key key, double after) {
    clock_ += after;
    return {{Event::Kind::press, clock_, key}, {Event::Kind::release, clock_ + keyDown, key}};
}

double SimulatedObserver::draw(const ExGaussian& time) {
    const double gaussian = time.mean + time.deviation * random_.normal();
    return std::max(quickest, gaussian + time.tail * random_.exponential());
}

} // namespace obscura
