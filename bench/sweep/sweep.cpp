#include "bench/sweep/sweep.h"

#include "base/error.h"
#include "base/files.h"
#include "bench/measure/machine.h"
#include "bench/measure/timing_turn.h"
#include "bench/sweep/assemble.h"
#include "bench/sweep/figures.h"
#include "bench/sweep/files.h"
#include "bench/sweep/merge.h"
#include "bench/sweep/page.h"
#include "bench/sweep/worker.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>

namespace obscura {

namespace fs = std::filesystem;

namespace {

using Kind = SweepUnit::Kind;

constexpr auto lookEvery = std::chrono::seconds(5); // at what the other workers have done

std::vector<WorkUnit> unitsOf(const std::vector<SweepUnit>& plan) {
    std::vector<WorkUnit> units;
    for (const SweepUnit& each : plan)
        units.push_back(each.unit);
    return units;
}

// A folder in which processes share this sweep, or a new one.
const SweepPlan& requireShared(const SweepPlan& plan) {
    if (fs::exists(plan.folder / "sweep.json") && !fs::exists(plan.folder / "units"))
        throw Error({(plan.folder / "sweep.json").string(), 0, 0, {}},
                    "expected a folder of a sweep that can go on, or a new one, found a sweep that "
                    "was merged or that an earlier obscura-bench wrote; --out names another");
    return plan;
}

// On a machine that times nothing else of this folder meanwhile.
gl::TimingChoice timingOf(const SweepPlan& plan) {
    if (plan.share.measured == Measured::errors)
        return {};
    const TimingTurn turn(plan.folder, [] {});
    return gl::honestTiming();
}

// What results depend on: not the machine, for times name theirs, nor the commit.
std::string aboutOf(const SweepMachine& machine) {
    const std::size_t code = machine.program.find("code ");
    return fmt::format("a sweep of the study {}, by {}", machine.study,
                       machine.program.substr(code == machine.program.npos ? 0 : code));
}

bool measures(const std::string& unit) { return !unit.starts_with("files"); }

class Sweeping {
  public:
    Sweeping(const SweepStudy& study, const Folders& folders, const SweepPlan& plan,
             const gl::Driver& driver, const SweepProgress& progress)
        : study_(study), plan_(requireShared(plan)), progress_(progress), hashes_(folders),
          timing_(timingOf(plan)), machine_(machineOf(driver, timing_, identityOf(study, hashes_))),
          all_(sweepUnits(study, plan.share, kindOf(machine_))),
          units_(plan.folder, aboutOf(machine_), unitsOf(all_)),
          worker_(study, folders, plan.folder, plan.cache, machine_, timing_.timing,
                  unitProgress_) {
        for (const SweepUnit& each : all_)
            byName_[each.unit.name] = &each;
    }

    Sweep run();

  private:
    using Clock = std::chrono::steady_clock;

    void requireReferences() const;
    bool finishNext(int stage, std::string& group);
    std::string workOn(const SweepUnit& unit);
    std::string writeFiles();
    void tell(double spent, const std::string& note);

    const SweepStudy& study_;
    const SweepPlan& plan_;
    const SweepProgress& progress_;
    SceneHashes hashes_;
    const gl::TimingChoice timing_;
    const SweepMachine machine_; // this one
    const std::vector<SweepUnit> all_;
    std::map<std::string, const SweepUnit*> byName_;
    Units units_;
    const UnitProgress unitProgress_ = [this](double spent, const std::string& note) {
        tell(spent, note);
    };
    SweepWorker worker_;
    UnitsState state_; // of all workers, when last looked at
    Clock::time_point looked_{};
};

void Sweeping::tell(double spent, const std::string& note) {
    if (const auto now = Clock::now(); now - looked_ > lookEvery) {
        state_ = units_.state();
        looked_ = now;
    }
    const std::string workers =
        state_.held.size() > 1 ? fmt::format("{} workers; ", state_.held.size()) : "";
    progress_(std::min(state_.costDone + spent, state_.cost), state_.cost, workers + note);
}

// What references will take, before the first of them.
void Sweeping::requireReferences() const {
    double seconds = 0;
    for (const SweepUnit& each : all_)
        if (each.kind == Kind::references && !units_.isDone(each.unit.name))
            seconds += each.unit.cost;
    requireMeasurable(study_, seconds, plan_.hours);
}

std::string Sweeping::writeFiles() {
    SweepMachine about;
    about.program = machine_.program;
    about.study = machine_.study;
    about.display = inWords(study_.display);
    about.rows = static_cast<int>(study_.match.techniques.size() * study_.match.test.size() *
                                  study_.sizes.size());
    for (;;) {
        tell(0, "writing");
        const std::size_t before = unitsState(plan_.folder).done;
        const Sweep sweep = assembled(study_, plan_.folder, units_, about);
        writeSweep(plan_.folder, sweep);
        writeFile(plan_.folder / "sweep.html", sweepPage(sweep, plan_.folder));
        writeFigures(plan_.folder / "figures", sweepFigures(sweep));
        // Another process may have finished something meanwhile, and have written its files before
        // ours replaced them. Who is still measuring will write again.
        const UnitsState now = unitsState(plan_.folder);
        if (now.done == before || std::any_of(now.held.begin(), now.held.end(),
                                              [](const auto& held) { return measures(held.name); }))
            return "written";
    }
}

std::string Sweeping::workOn(const SweepUnit& unit) {
    std::optional<TimingTurn> turn;
    if (unit.kind == Kind::times || unit.kind == Kind::growth)
        turn.emplace(plan_.folder, [&] { tell(0, "waiting for its turn to time"); });
    return unit.kind == Kind::files ? writeFiles() : worker_.work(unit, units_);
}

bool Sweeping::finishNext(int stage, std::string& group) {
    const auto waiting = [&] { tell(0, "waiting for other workers"); };
    const auto name = units_.claimNext(group, waiting, [&](const WorkUnit& unit) {
        return byName_.at(unit.name)->stage == stage;
    });
    if (!name)
        return false;
    const SweepUnit& unit = *byName_.at(*name);
    group = unit.unit.group;
    units_.finish(*name, workOn(unit));
    state_.costDone += unit.unit.cost; // until it is looked at again
    return true;
}

Sweep Sweeping::run() {
    requireReferences();
    removeUnfinishedFiles(plan_.folder);
    removeUnfinishedFiles(plan_.folder / "thumbnails");
    if (plan_.share.measured != Measured::errors)
        addKind(plan_.folder, kindOf(machine_));
    std::string group;
    for (int stage = 0; stage <= all_.back().stage; ++stage)
        while (finishNext(stage, group)) {
        }
    looked_ = {};
    tell(0, "");
    if (!fs::exists(plan_.folder / "sweep.json"))
        writeFiles(); // somebody removed it
    return readSweep(plan_.folder);
}

} // namespace

std::string identityOf(const SweepStudy& study, SceneHashes& hashes) {
    std::string text = fmt::format("{}\n{} {:g} {}\n", study.match.sha256, study.frames,
                                   study.seconds, study.match.rays);
    const auto add = [&](const ImageSize& size) {
        text += fmt::format("{}x{} ", size.width, size.height);
    };
    add(study.match.training);
    for (const auto* views : {&study.match.train, &study.match.test})
        for (const View& view : *views)
            text += fmt::format("\n{} {:g} {}", view.name, view.radius, hashes.of(view));
    std::for_each(study.sizes.begin(), study.sizes.end(), add);
    text += "\n" + inWords(study.display);
    if (study.light && !study.light->environment.empty())
        text += "\n" + sha256(readFile(hashes.folders().protocol / study.light->environment));
    if (study.growth) {
        std::for_each(study.growth->sizes.begin(), study.growth->sizes.end(), add);
        text += fmt::format("\n{}", fmt::join(study.growth->radii, " "));
    }
    return sha256(text);
}

void requireMeasurable(const SweepStudy& study, double referenceSeconds, double hours) {
    for (const TechniqueSetting& each : study.match.techniques)
        if (settingsOf(each, 1).technique().reads & rays)
            throw Error(each.place, "expected a technique that runs on the GPU, found one that "
                                    "traces rays: it is the reference");
    for (std::size_t i = 0; i < study.match.train.size(); ++i)
        referenceSeconds += truthCost(study.match.training, study.match.rays);
    if (referenceSeconds > hours * 3600)
        throw Error(fmt::format(
            "expected references of at most {:g} h, found views, sizes and rays "
            "that take about {:.1f} h, less those in the cache; ask for fewer, or allow it "
            "by --hours",
            hours, referenceSeconds / 3600));
}

Sweep sweep(const SweepStudy& study, const Folders& folders, const SweepPlan& plan,
            const gl::Driver& driver, const SweepProgress& progress) {
    return Sweeping(study, folders, plan, driver, progress).run();
}

} // namespace obscura
