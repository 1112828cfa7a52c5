#include "experiment/timing_command.h"

#include "base/files.h"
#include "base/progress.h"
#include "experiment/signals.h"
#include "experiment/timing_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace obscura {

namespace {

Image8 greyScreen(int width, int height) {
    const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
    return {width, height, 3, std::vector<std::uint8_t>(size, 128)};
}

void report(const TimingArguments& arguments, const TimingRun& timing,
            const StimulusDisplay& display) {
    nlohmann::ordered_json json = spell(timing);
    display.describe(json);
    fmt::print("{}", arguments.json ? json.dump(2) + "\n" : inWords(timing));
    if (arguments.out.empty())
        return;
    writeFile(arguments.out / "timing.json", json.dump(2) + "\n");
    writeFile(arguments.out / "masks.csv", csv(timing));
}

} // namespace

int holdAndReport(const DisplayOptions& options, const TimingArguments& arguments) {
    StimulusDisplay display(options, greyScreen);
    fmt::print(stderr, "obscura-experiment: the display: {}\n", display.inWords());
    TimingRun timing;
    timing.seconds = arguments.seconds;
    int status = 0;
    try {
        Progress progress("masks", arguments.masks);
        holdMasks(display, arguments.masks, timing, [&](int done) { progress.update(done); });
    } catch (const EndedBySignal& ended) {
        timing.ended = "ended by " + ended.name();
        status = ended.exitStatus();
    }
    report(arguments, timing, display);
    return status;
}

} // namespace obscura
