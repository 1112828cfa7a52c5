#include "validity/simulated_study.h"

#include "base/files.h"
#include "base/random.h"
#include "experiment/play.h"
#include "experiment/row.h"
#include "experiment/selection.h"
#include "experiment/simulated.h"

#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

// As if the images were there: rows name them.
Manifest manifestFor(const Protocol& protocol) {
    Manifest manifest;
    manifest.study = protocol.name;
    manifest.title = protocol.title;
    for (const Condition& condition : protocol.conditions) {
        ConditionRecord record;
        record.condition = condition.id;
        record.level = condition.level;
        record.view = condition.view;
        record.hypothesis = condition.hypothesis;
        for (const Role& role : condition.roles) {
            ImageRecord& image = record.image(role.name);
            image.name = role.technique;
            const std::string file = condition.id + "_" + role.name + ".png";
            image.image = {file, sha256(file)};
        }
        manifest.conditions.push_back(std::move(record));
    }
    return manifest;
}

// The share of one person whose leaning, in probit units, is added to that of all: the mean of
// such shares over normal leanings is `share`.
double personal(double share, double leaning, double deviation) {
    constexpr double sure = 1e-12;
    const double centre =
        probit(std::clamp(share, sure, 1 - sure)) * std::sqrt(1 + deviation * deviation);
    return 0.5 * std::erfc(-(centre + leaning) / std::sqrt(2.0));
}

} // namespace

struct StudySimulator::Parts {
    Study study;
    std::string design;
    PairPhases pair;
    std::vector<Phase> phases;
};

StudySimulator::StudySimulator(Protocol protocol) : parts_(std::make_unique<Parts>()) {
    parts_->study.manifest = manifestFor(protocol);
    parts_->study.protocol = std::move(protocol);
    parts_->design = sha256(parts_->study.design());
    parts_->pair = pairPhasesOf(parts_->study.protocol.trial).value();
    parts_->phases = phasesOf(parts_->study.protocol.trial);
}

StudySimulator::~StudySimulator() = default;

const Protocol& StudySimulator::protocol() const { return parts_->study.protocol; }

std::string StudySimulator::rows(const Truth& truth, int people, std::uint64_t seed) const {
    const double deviation = truth.spread * probit(0.75);
    Random random(seed, "validity/people");
    std::string text = responseHeader();
    const int count = longest(protocol());
    for (int person = 1; person <= people; ++person) {
        Protocol own = protocol();
        const double leaning = deviation * random.normal();
        for (std::size_t i = 0; i < own.conditions.size(); ++i)
            own.conditions[i].simulated.chooseB = personal(truth.shares[i], leaning, deviation);
        own.simulation.positionBias = truth.positionBias;
        const SessionId session{fmt::format("S{:02}", person), 1, true};
        SimulatedObserver observer(own, seed, session.participant);
        const Assignment assignment = assign(protocol(), person);
        const Refresh refresh = observer.refresh();
        const Context context{parts_->study, session, assignment, refresh, parts_->design};
        int index = 1;
        for (const PlannedTrial& trial : planned(protocol(), person)) {
            if (trial.kind == PlannedTrial::Kind::rest)
                continue;
            const Upcoming next = upcoming(own, trial, index++, count);
            TrialMachine machine(parts_->phases, static_cast<int>(next.order.size()), refresh.hz,
                                 own.keys);
            observer.prepare(next);
            play(machine, observer, [] {});
            text += responseLine(makeRow(context, next, machine.record(), parts_->pair));
        }
    }
    return text;
}

} // namespace obscura
