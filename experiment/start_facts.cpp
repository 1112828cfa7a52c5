#include "experiment/start_facts.h"

#include "experiment/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

double meanOf(const ExGaussian& time) { return time.mean + time.tail; }

double secondsOf(const Phase& phase, const Simulation& model) {
    constexpr double refreshHz = 60;
    if (phase.counted())
        return phase.frames > 0 ? phase.frames / refreshHz : phase.seconds;
    if (!phase.questions.empty())
        return static_cast<double>(phase.questions.size()) * meanOf(model.decision);
    return std::max(phase.atLeast, meanOf(phase.images.empty() ? model.decision : model.view));
}

double secondsOf(const std::vector<Phase>& phases, const Simulation& model) {
    double sum = 0;
    for (const Phase& phase : phases)
        sum += secondsOf(phase, model);
    return sum;
}

std::string imagesOf(const Study& study) {
    std::size_t count = 0;
    for (const ConditionRecord& condition : study.manifest.conditions)
        count += condition.images.size();
    return fmt::format("{}: {} images, each as the manifest vouches for",
                       study.manifest.folder.string(), count);
}

std::string orderOf(const Study& study, const DataFolder& folder, bool rehearsal) {
    const Ordering& ordering = study.protocol.ordering;
    const std::string scheme = orderSchemeNames()[static_cast<std::size_t>(ordering.scheme)];
    if (rehearsal)
        return scheme + ", as for slot 1; a rehearsal takes no slot";
    int next = 1, completed = 0, running = 0, returned = 0;
    for (const SlotRecord& record : Ledger(folder.ledger()).records()) {
        next = std::max(next, record.slot + 1);
        completed += record.state == SlotState::completed;
        running += record.state == SlotState::reserved;
        if (record.state == SlotState::returned && returned == 0)
            returned = record.slot; // the lowest is given out first
    }
    std::string words =
        fmt::format("{}, next slot {}; {} of {} planned are complete", scheme,
                    returned > 0 ? returned : next, completed, ordering.participants);
    if (running > 0)
        words += fmt::format(", {} begun and not ended", running);
    return words;
}

std::string monitorOf(const gl::Monitor& monitor, int number, int monitors) {
    return fmt::format("{} of {}: {}, {}x{}{}", number, monitors, monitor.name, monitor.width,
                       monitor.height,
                       monitor.refreshHz > 0 ? fmt::format(" at {} Hz", monitor.refreshHz) : "");
}

std::string timingOf(const StimulusDisplay& display) {
    const Refresh& refresh = display.refresh();
    if (refresh.source == "none")
        return fmt::format("not to be relied on: {}", refresh.doubt);
    return fmt::format("{:.2f} Hz, onsets by {}", refresh.hz, refresh.source);
}

std::string viewingOf(const Viewing& viewing) {
    const std::string words = inWords(viewing);
    return words.empty() ? "the screen's size is not known (obscura-experiment card measures it)"
                         : words;
}

} // namespace

double expectedSeconds(const Protocol& protocol) {
    const Simulation& model = protocol.simulation;
    return secondsOf(protocol.before, model) + meanOf(model.decision) +
           longest(protocol) * secondsOf(phasesOf(protocol.trial), model) +
           secondsOf(protocol.after, model);
}

StartFacts startFacts(const Study& study, const DataFolder& folder, bool rehearsal,
                      const StimulusDisplay& display, const Viewing& viewing, int monitor,
                      int monitors) {
    const Protocol& protocol = study.protocol;
    const double minutes = std::ceil(expectedSeconds(protocol) / 60);
    StartFacts start{(rehearsal ? "Rehearsal: " : "") + protocol.title, {}, monitors > 1};
    start.facts = {
        {"Protocol", protocol.path.string()},
        {"Stimuli", imagesOf(study)},
        {"Answers", folder.path().string()},
        {"Order", orderOf(study, folder, rehearsal)},
        {"Trials", fmt::format("{}{}, about {} min", longest(protocol),
                               adaptiveTrials(protocol.ordering) > 0 ? " at most" : "", minutes)},
        {"Monitor", monitorOf(display.monitor(), monitor, monitors)},
        {"Timing", timingOf(display)},
        {"Viewing", viewingOf(viewing)},
    };
    return start;
}

} // namespace obscura
