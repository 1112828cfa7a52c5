#include "experiment/timing_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace obscura {

namespace {

// How others hold a mask of 2 s: measured for this project (docs/measurement.md) under Xvfb at
// 1280x800 on 2 virtual cores, by each program's own clock.
struct Peer {
    const char* name;
    int masks;
    double mean, deviation, least, most; // ms
    const char* wrong;                   // masks of a wrong number of frames
};
constexpr Peer peers[] = {
    {"jsPsych 8.3.0, Chromium 156, time_elapsed", 50, 2001.06, 0.68, 2000, 2004, "?"},
    {"  the same, animation-frame stamps", 49, 2001.30, 4.62, 1999.8, 2016.7, "4"},
    {"page that counts 120 animation frames", 50, 1999.94, 0.06, 1999.8, 2000.0, "0"},
    {"Psychtoolbox 3.0.18, Flip half a frame ahead", 50, 1992.77, 0.68, 1992.25, 1996.51, "?"},
    {"Psychtoolbox 3.0.18, wait, then Flip", 50, 2009.53, 2.14, 2005.80, 2014.13, "?"},
};

IntervalSummary durations(const TimingRun& run) {
    std::vector<double> seconds;
    for (const MaskTiming& mask : run.masks)
        seconds.push_back(mask.seconds);
    return summarise(seconds, run.refresh.hz);
}

std::string line(const std::string& name, int masks, const IntervalSummary& ms,
                 const std::string& wrong) {
    return fmt::format("{:<44} {:>5} {:>9.3f} {:>7.3f} {:>9.3f} {:>9.3f} {:>6}\n", name, masks,
                       ms.mean, ms.deviation, ms.least, ms.most, wrong);
}

std::string table(const TimingRun& run) {
    const IntervalSummary summary = durations(run);
    std::string text = fmt::format("{:<44} {:>5} {:>9} {:>7} {:>9} {:>9} {:>6}\n", "", "masks",
                                   "mean ms", "sd", "min", "max", "wrong") +
                       line("Obscura, this run", summary.count,
                            {0,
                             1000 * summary.mean,
                             1000 * summary.deviation,
                             1000 * summary.least,
                             1000 * summary.most,
                             {}},
                            fmt::format("{}", run.wrong()));
    if (run.seconds != 2)
        return text;
    for (const Peer& peer : peers)
        text += line(peer.name, peer.masks,
                     {0, peer.mean, peer.deviation, peer.least, peer.most, {}}, peer.wrong);
    return text + "wrong: masks of a wrong number of frames (?: its own stamps do not tell). The "
                  "others: measured under\nXvfb on 2 virtual cores by their own clocks "
                  "(docs/measurement.md, \"The mask\").\n";
}

// Of the differences from what was planned, in steps of 0.05 ms; all beyond half a millisecond in
// one line at either end.
std::string histogram(const TimingRun& run) {
    constexpr double step = 0.05; // ms
    constexpr int outermost = 10, longest = 50;
    const double planned = run.planned / run.refresh.hz;
    std::map<int, int> counts;
    for (const MaskTiming& mask : run.masks)
        ++counts[std::clamp(static_cast<int>(std::lround(1000 * (mask.seconds - planned) / step)),
                            -outermost, outermost)];
    if (counts.empty())
        return "";
    int most = 0;
    for (const auto& [bin, count] : counts)
        most = std::max(most, count);
    std::string text =
        fmt::format("Milliseconds longer than {} refreshes ({:.3f} ms), and how many masks:\n",
                    run.planned, 1000 * planned);
    for (int bin = counts.begin()->first; bin <= counts.rbegin()->first; ++bin) {
        const int count = counts[bin];
        const int marks = (count * longest + most - 1) / most; // one at least
        text += fmt::format("{} {:+.2f} {:>5} {}\n",
                            bin == -outermost  ? "<="
                            : bin == outermost ? ">="
                                               : "  ",
                            bin * step, count, std::string(static_cast<std::size_t>(marks), '#'));
    }
    return text;
}

} // namespace

std::string inWords(const TimingRun& run) {
    std::string text =
        run.masks.empty()
            ? "No mask was held.\n"
            : table(run) +
                  fmt::format("\n{} of {} refreshes at {:.4f} Hz, timestamps: {}; {} intervals "
                              "above 1.2 refreshes\n\n",
                              run.masks.size(), run.planned, run.refresh.hz, run.refresh.source,
                              run.missed()) +
                  histogram(run);
    return run.ended.empty() ? text
                             : text + fmt::format("It was {} before the last mask.\n", run.ended);
}

nlohmann::ordered_json spell(const TimingRun& run) {
    const IntervalSummary summary = durations(run);
    const auto ms = [&](double seconds) {
        return run.masks.empty() ? nlohmann::ordered_json()
                                 : nlohmann::ordered_json(1000 * seconds);
    };
    return {{"masks", summary.count},
            {"mean_ms", ms(summary.mean)},
            {"sd_ms", ms(summary.deviation)},
            {"min_ms", ms(summary.least)},
            {"max_ms", ms(summary.most)},
            {"wrong_frames", run.wrong()},
            {"missed_intervals", run.missed()},
            {"asked_s", run.seconds},
            {"planned_refreshes", run.planned},
            {"refresh_hz", run.refresh.hz},
            {"timestamp_source", run.refresh.source},
            {"timing_doubt", run.refresh.doubt},
            {"ended", run.ended}};
}

std::string csv(const TimingRun& run) {
    std::string text = "mask,ms,refreshes,missed_intervals\n";
    for (std::size_t i = 0; i < run.masks.size(); ++i)
        text += fmt::format("{},{:.6f},{},{}\n", i + 1, 1000 * run.masks[i].seconds,
                            run.masks[i].refreshes, run.masks[i].missed);
    return text;
}

} // namespace obscura
