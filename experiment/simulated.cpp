#include "experiment/simulated.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace obscura {

namespace {

constexpr double simulatedHz = 60;
constexpr double quickest = 0.15; // seconds; nobody sees and reacts faster
constexpr double keyDown = 0.08;  // seconds for which a key is held

gl::Key digit(int number) {
    return static_cast<gl::Key>(static_cast<int>(gl::Key::zero) + number % 10);
}

// The first option with which the session goes on, from 1.
int admitted(const Question& question) {
    const auto option =
        std::find(question.options.begin(), question.options.end(), question.endsUnless.front());
    return static_cast<int>(option - question.options.begin()) + 1;
}

} // namespace

SimulatedParticipant::SimulatedParticipant(const Protocol& protocol, std::uint64_t seed,
                                           const std::string& name, const Manifest* seen)
    : protocol_(protocol), phases_(phasesOf(protocol.trial)), seed_(seed),
      random_(seed, "observer/" + name), pages_(seed, "pages/" + name) {
    if (seen)
        eyes_.emplace(protocol, *seen, Random(seed, "eyes/" + name));
}

void SimulatedParticipant::describe(nlohmann::ordered_json& sidecar) const {
    const Simulation& model = protocol_.simulation;
    const auto spell = [](const ExGaussian& time) {
        return nlohmann::ordered_json{
            {"mean_s", time.mean}, {"deviation_s", time.deviation}, {"tail_s", time.tail}};
    };
    sidecar["model"] = {{"observer", eyes_ ? "jod" : "preference"},
                        {"seed", seed_},
                        {"position_bias", model.positionBias},
                        {"view", spell(model.view)},
                        {"decision", spell(model.decision)}};
    if (eyes_)
        eyes_->describe(sidecar["model"]);
}

void SimulatedParticipant::prepare(const Upcoming& trial) {
    const Condition& condition =
        protocol_.conditions.at(static_cast<std::size_t>(trial.planned.condition));
    const double preferSecond =
        trial.order.front() == "b" ? 1 - condition.simulated.chooseB : condition.simulated.chooseB;
    chooseSecond_ =
        eyes_ ? 0.5 : std::clamp(preferSecond + protocol_.simulation.positionBias, 0.0, 1.0);
    if (eyes_)
        eyes_->look(trial);
    deed_.reset();
    page_ = nullptr;
}

void SimulatedParticipant::preparePage(const Phase& page) {
    deed_.reset();
    page_ = &page;
}

gl::Key SimulatedParticipant::keyOf(const Question& question, int option) const {
    const Keys& keys = protocol_.keys;
    if (isOfTwo(question) && option <= 2)
        return static_cast<gl::Key>((option == 1 ? keys.first : keys.second).front());
    return digit(option);
}

void SimulatedParticipant::sees(const TrialMachine& trial, double time) {
    if (std::exchange(screen_, trial.screen()) != trial.screen())
        deed_.reset();
    if (deed_ || screen_ == leaveScreen)
        return;
    const Phase& phase = phaseOn(screen_);
    if (!trial.form() && phase.locked())
        return;
    deed_ = decide(trial, phase);
    deed_->time += time;
}

std::optional<double> SimulatedParticipant::next() const {
    return deed_ ? std::optional(deed_->time) : std::nullopt;
}

std::optional<Deed> SimulatedParticipant::take(double time) {
    return deed_ && deed_->time <= time ? std::exchange(deed_, std::nullopt) : std::nullopt;
}

double SimulatedParticipant::reading() {
    const ExGaussian& time = protocol_.simulation.decision;
    return std::max(quickest, time.mean + time.deviation * pages_.normal());
}

Deed SimulatedParticipant::decide(const TrialMachine& trial, const Phase& phase) {
    if (const Form* form = trial.form())
        return answer(*form);
    const double time =
        draw(phase.images.empty() ? protocol_.simulation.decision : protocol_.simulation.view);
    return {phase.atLeast > 0 || !phase.images.empty() ? std::max(phase.atLeast + quickest, time)
                                                       : time,
            static_cast<gl::Key>(protocol_.keys.go.front()),
            {}};
}

// Questions about images are answered by the eyes, or, without them, which of a pair looks better
// by the model; all others at random: a number in the middle of the range, or a letter, where they
// are typed; but never so that the session ends.
Deed SimulatedParticipant::answer(const Form& form) {
    Deed deed{draw(protocol_.simulation.decision), gl::Key::enter, {}}; // to the next, or the end
    if (form.answered(static_cast<std::size_t>(form.focus())))
        return deed;
    const auto focus = static_cast<std::size_t>(form.focus());
    const Question& question = form.questions()[focus];
    if (eyes_ && !page_)
        if (const auto seen = eyes_->answer(question, form.entries()[focus].ranks)) {
            deed.key = keyOf(question, *seen);
            return deed;
        }
    switch (question.kind) {
    case Question::Kind::choice:
        if (question.images && question.options.size() == 2 && question.unsure.empty()) {
            deed.key = keyOf(question, random_.uniform() < chooseSecond_ ? 2 : 1);
            break;
        }
        [[fallthrough]];
    case Question::Kind::scale:
        if (!question.endsUnless.empty()) {
            deed.key = keyOf(question, admitted(question));
            break;
        }
        [[fallthrough]];
    case Question::Kind::rank:
        deed.key = keyOf(question, 1 + static_cast<int>(random_.below(
                                           static_cast<std::uint32_t>(form.optionsOf(question)))));
        break;
    case Question::Kind::slider:
        deed.key = digit(static_cast<int>(random_.below(10)));
        break;
    case Question::Kind::number:
        deed.typed = fmt::format("{}", (question.least + question.most) / 2);
        break;
    case Question::Kind::text:
        deed.typed = "x";
        break;
    }
    return deed;
}

double SimulatedParticipant::draw(const ExGaussian& time) {
    const double gaussian = time.mean + time.deviation * random_.normal();
    return std::max(quickest, gaussian + time.tail * random_.exponential());
}

Refresh SimulatedObserver::refresh() const {
    return {simulatedHz, "none", "simulated: a clock without a display"};
}

double SimulatedObserver::show(const TrialMachine& trial) {
    trial_ = &trial;
    clock_ = (std::floor(clock_ * simulatedHz + 1e-6) + 1) / simulatedHz;
    participant_.sees(trial, clock_);
    return clock_;
}

const std::vector<Event>& SimulatedObserver::events(bool wait) {
    events_.clear();
    if (!trial_)
        return events_;
    if (wait) {
        participant_.sees(*trial_, clock_); // a key that changed nothing
        clock_ = std::max(clock_, participant_.next().value_or(clock_));
    }
    const std::optional<Deed> deed = participant_.take(clock_);
    if (!deed)
        return events_;
    if (deed->typed.empty())
        events_ = {{Event::Kind::press, deed->time, deed->key},
                   {Event::Kind::release, deed->time + keyDown, deed->key}};
    for (const char letter : deed->typed) {
        events_.push_back({Event::Kind::text, deed->time});
        events_.back().symbol = static_cast<unsigned char>(letter);
    }
    return events_;
}

} // namespace obscura
