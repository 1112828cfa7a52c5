#include "bench/measure/timing.h"

#include "base/percentile.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

namespace obscura {

namespace {

// One technique of a group, with the times of its frames so far.
struct Runner {
    const Settings& settings;
    OcclusionPasses passes;
    std::vector<const Pass*> order;          // of the passes, as they were issued
    std::vector<std::vector<double>> pieces; // by frame, milliseconds of each pass
    double spent = 0;                        // seconds

    double total(std::size_t frame) const {
        return std::accumulate(pieces[frame].begin(), pieces[frame].end(), 0.0);
    }
};

void runOnce(const Probe& probe, Runner& runner, gl::Timer& timer, bool keep) {
    runner.order.clear();
    timer.start();
    probe.run(runner.settings, runner.passes, 0, [&](const Pass& pass) {
        timer.mark();
        runner.order.push_back(&pass);
    });
    std::vector<double> pieces = timer.pieces();
    for (double& piece : pieces) {
        runner.spent += keep ? piece : 0;
        piece *= 1e3;
    }
    if (keep)
        runner.pieces.push_back(std::move(pieces));
}

bool wantsMore(const Runner& runner, const TimingPlan& plan) {
    const std::size_t frames = runner.pieces.size();
    if (runner.settings.technique().passes.empty()) // takes no time, however often
        return frames < 3;
    return frames < 3 ||
           (frames < static_cast<std::size_t>(plan.frames) && runner.spent < plan.seconds);
}

// A permutation of 0 ... count - 1.
std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    random.shuffle(order);
    return order;
}

// The technique's own textures reach as far as its guard band.
double paddedBytes(const Settings& settings, int width, int height) {
    const int guard = guardPixels(settings, height);
    return occlusionBytes(settings, width + 2 * guard, height + 2 * guard);
}

constexpr double gbufferBytes = 4 + 4 + 8; // per pixel: albedo, linear depth, normal

std::vector<double> totalsOf(const Runner& runner, std::size_t frames) {
    std::vector<double> totals;
    for (std::size_t frame = 0; frame < frames; ++frame)
        totals.push_back(runner.total(frame));
    return totals;
}

// How well a median repeats: what differs between two halves of the same rounds is noise.
double oddToEven(const std::vector<double>& times) {
    std::vector<double> halves[2];
    for (std::size_t round = 0; round < times.size(); ++round)
        halves[round % 2].push_back(times[round]);
    return summaryOf(std::move(halves[1])).median / summaryOf(std::move(halves[0])).median;
}

TechniqueTime timeOf(const Runner& runner) {
    TechniqueTime time;
    time.frames = static_cast<int>(runner.pieces.size());
    time.total = summaryOf(totalsOf(runner, runner.pieces.size()));
    for (std::size_t i = 0; i < runner.order.size(); ++i) {
        std::vector<double> own;
        for (const std::vector<double>& frame : runner.pieces)
            own.push_back(frame[i]);
        time.passes.push_back({std::string(runner.order[i]->name),
                               static_cast<int>(runner.order[i]->work), summaryOf(own).median});
    }
    return time;
}

// A guard band is drawn by a larger G-buffer pass, which is the technique's cost.
void addGuard(TechniqueTime& time, const Settings& settings, int width, int height) {
    const double share = guardShare(settings, width, height);
    if (share <= 0)
        return;
    const double extra = share * time.gbuffer;
    for (double* value : {&time.total.median, &time.total.low, &time.total.high})
        *value += extra;
    time.passes.insert(time.passes.begin(), {"guard band", static_cast<int>(Work::prepare), extra});
}

// Times one group whose textures fit into memory together.
class Group {
  public:
    Group(const Probe& probe, const TimingPlan& plan, Random& random)
        : probe_(probe), plan_(plan), random_(random), timer_(plan.timing) {}

    void add(const Settings& settings) {
        runners_.push_back({settings, probe_.passesFor(settings), {}, {}, 0});
    }
    // The first runner is an anchor that runs in every round.
    std::vector<TechniqueTime> run(const std::function<void()>& frameDone) {
        for (Runner& runner : runners_)
            for (int warm = 0; warm < 2; ++warm)
                runOnce(probe_, runner, timer_, false);
        drawGBuffer(false);
        const auto unfinished = [&](const Runner& runner) { return wantsMore(runner, plan_); };
        while (std::any_of(runners_.begin(), runners_.end(), unfinished)) {
            drawGBuffer(true);
            for (const std::size_t i : shuffled(runners_.size(), random_))
                if (i == 0 || unfinished(runners_[i])) {
                    runOnce(probe_, runners_[i], timer_, true);
                    frameDone();
                }
        }
        // A runner ran in the first rounds until it had finished; what it is compared with is taken
        // from the same rounds.
        std::vector<TechniqueTime> times;
        for (const Runner& runner : runners_) {
            const std::size_t rounds = runner.pieces.size();
            times.push_back(timeOf(runner));
            times.back().gbuffer =
                summaryOf(
                    {gbuffer_.begin(), gbuffer_.begin() + static_cast<std::ptrdiff_t>(rounds)})
                    .median;
            times.back().starcraft = summaryOf(totalsOf(runners_.front(), rounds)).median;
            times.back().starcraftRepeat = oddToEven(totalsOf(runners_.front(), rounds));
        }
        return times;
    }

    // The share done, 0 ... 1: the mean over the runners.
    double share() const {
        double sum = 0;
        for (const Runner& runner : runners_)
            sum +=
                std::min(1.0, std::max(runner.spent / plan_.seconds,
                                       static_cast<double>(runner.pieces.size()) / plan_.frames));
        return sum / static_cast<double>(runners_.size());
    }

  private:
    void drawGBuffer(bool keep) {
        timer_.start();
        probe_.drawGBuffer();
        timer_.mark();
        const double time = timer_.pieces().front() * 1e3;
        if (keep)
            gbuffer_.push_back(time);
    }

    const Probe& probe_;
    const TimingPlan& plan_;
    Random& random_;
    gl::Timer timer_;
    std::vector<Runner> runners_;
    std::vector<double> gbuffer_;
};

// Groups of techniques, in random order, that fit into memory with the anchor.
std::vector<std::vector<std::size_t>> groupsOf(const Probe& probe,
                                               std::span<const Settings> techniques,
                                               const TimingPlan& plan, Random& random) {
    std::vector<std::vector<std::size_t>> groups(1);
    double bytes = 0;
    for (const std::size_t i : shuffled(techniques.size(), random)) {
        const double own = paddedBytes(techniques[i], probe.width(), probe.height());
        if (bytes + own > plan.bytes && !groups.back().empty()) {
            groups.emplace_back();
            bytes = 0;
        }
        groups.back().push_back(i);
        bytes += own;
    }
    return groups;
}

} // namespace

double guardShare(const Settings& settings, int width, int height) {
    const int guard = guardPixels(settings, height);
    return (width + 2.0 * guard) * (height + 2.0 * guard) / (1.0 * width * height) - 1;
}

double addedBytes(const Settings& settings, int width, int height) {
    return paddedBytes(settings, width, height) +
           std::max(guardShare(settings, width, height), 0.0) * gbufferBytes * width * height;
}

Milliseconds summaryOf(std::vector<double> milliseconds) {
    if (milliseconds.empty())
        return {};
    return {percentile(milliseconds, 0.5), percentile(milliseconds, 0.05),
            percentile(milliseconds, 0.95)};
}

std::vector<TechniqueTime> timeTechniques(const Probe& probe, std::span<const Settings> techniques,
                                          double radius, const TimingPlan& plan,
                                          const TimingProgress& progress) {
    Random random(plan.seed, "timing order");
    const Settings anchor = starcraftAnchor(radius);
    const auto groups = groupsOf(probe, techniques, plan, random);
    std::vector<TechniqueTime> times(techniques.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        Group group(probe, plan, random);
        group.add(anchor);
        for (const std::size_t i : groups[g])
            group.add(techniques[i]);
        const std::vector<TechniqueTime> own = group.run([&] {
            if (progress)
                progress((static_cast<double>(g) + group.share()) /
                         static_cast<double>(groups.size()));
        });
        for (std::size_t i = 0; i < groups[g].size(); ++i) {
            TechniqueTime& time = times[groups[g][i]] = own[i + 1];
            const Settings& settings = techniques[groups[g][i]];
            time.bytes = addedBytes(settings, probe.width(), probe.height());
            addGuard(time, settings, probe.width(), probe.height());
        }
    }
    return times;
}

} // namespace obscura
