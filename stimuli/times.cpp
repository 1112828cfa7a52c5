#include "stimuli/times.h"

#include "base/random.h"
#include "matching/anchor.h"

#include <algorithm>
#include <numeric>

namespace obscura {

namespace {

constexpr int leastRounds = 7, mostRounds = 30;
constexpr double secondsEach = 0.5; // of a technique on average, in all rounds

struct Runner {
    Settings settings;
    OcclusionPasses passes;
    std::vector<double> milliseconds;
};

double run(const Probe& probe, const Runner& runner, gl::Timer& timer) {
    timer.start();
    probe.run(runner.settings, runner.passes);
    timer.mark();
    return 1e3 * timer.pieces().front();
}

} // namespace

TechniqueTimes timesOf(const Probe& probe, std::span<const Settings> techniques, double radius,
                       gl::Timing timing, std::uint64_t seed) {
    std::vector<Settings> all(techniques.begin(), techniques.end());
    all.push_back(starcraftAnchor(radius));
    std::vector<Runner> runners;
    for (const Settings& settings : all)
        runners.push_back({settings, probe.passesFor(settings), {}});
    gl::Timer timer(timing);
    for (const Runner& runner : runners)
        if (!runner.settings.technique().passes.empty())
            run(probe, runner, timer); // compiled and warm
    Random random(seed, "timing order");
    std::vector<std::size_t> order(runners.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    double spent = 0;
    for (int round = 0;
         round < leastRounds ||
         (round < mostRounds && spent < 1e3 * secondsEach * static_cast<double>(runners.size()));
         ++round) {
        random.shuffle(order);
        for (const std::size_t i : order)
            if (!runners[i].settings.technique().passes.empty()) {
                runners[i].milliseconds.push_back(run(probe, runners[i], timer));
                spent += runners[i].milliseconds.back();
            }
    }
    TechniqueTimes times;
    for (const Runner& runner : runners)
        times.milliseconds.push_back(
            runner.milliseconds.empty() ? 0 : std::ranges::min(runner.milliseconds));
    times.starcraft = times.milliseconds.back();
    times.milliseconds.pop_back();
    return times;
}

} // namespace obscura
