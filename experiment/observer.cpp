#include "experiment/observer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

constexpr double refreshHz = 60;
constexpr double quickest = 0.15; // seconds; nobody sees and reacts faster
constexpr double keyDown = 0.08;  // seconds for which a key is held

} // namespace

SimulatedObserver::SimulatedObserver(const Protocol& protocol, std::uint64_t seed,
                                     const std::string& participant)
    : protocol_(protocol), seed_(seed), random_(seed, "observer/" + participant) {}

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
    const Condition& condition = protocol_.conditions.at(static_cast<std::size_t>(trial.condition));
    const double preferSecond =
        trial.reversed ? 1 - condition.simulated.chooseB : condition.simulated.chooseB;
    chooseSecond_ = std::clamp(preferSecond + protocol_.simulation.positionBias, 0.0, 1.0);
}

double SimulatedObserver::show(Screen screen) {
    visible_ = screen;
    clock_ = (std::floor(clock_ * refreshHz + 1e-6) + 1) / refreshHz;
    return clock_;
}

std::vector<Event> SimulatedObserver::events(bool wait) {
    if (!wait)
        return {};
    if (visible_ == Screen::first || visible_ == Screen::second)
        return press(gl::Key::space, std::max(protocol_.trial.minimumView + quickest,
                                              draw(protocol_.simulation.view)));
    if (visible_ == Screen::question) {
        const double after = draw(protocol_.simulation.decision);
        return press(random_.uniform() < chooseSecond_ ? gl::Key::two : gl::Key::one, after);
    }
    return press(gl::Key::space, draw(protocol_.simulation.decision));
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
