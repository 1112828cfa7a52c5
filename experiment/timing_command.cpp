#include "experiment/timing_command.h"

#include "base/files.h"
#include "base/progress.h"
#include "experiment/signals.h"
#include "experiment/timing_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace obscura {

namespace {

Image8 greyScreen(int width, int height) {
    const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
    return {width, height, 3, std::vector<std::uint8_t>(size, 128)};
}

} // namespace

int runTiming(const DisplayOptions& options, int masks, double seconds, bool json,
              const std::filesystem::path& out) {
    Display display(options, greyScreen);
    fmt::print(stderr, "obscura-experiment: the display: {}\n", display.inWords());
    TimingRun timing;
    timing.seconds = seconds;
    int status = 0;
    try {
        Progress progress("masks", masks);
        holdMasks(display, masks, timing, [&](int done) { progress.update(done); });
    } catch (const EndedBySignal& ended) {
        timing.ended = "ended by " + ended.name();
        status = ended.exitStatus();
    }
    nlohmann::ordered_json spelt = spell(timing);
    display.describe(spelt);
    fmt::print("{}", json ? spelt.dump(2) + "\n" : inWords(timing));
    if (!out.empty()) {
        writeFile(out / "timing.json", spelt.dump(2) + "\n");
        writeFile(out / "masks.csv", csv(timing));
    }
    return status;
}

} // namespace obscura
