#pragma once

#include "bench/measure/measured_view.h"
#include "bench/measure/timing.h"
#include "bench/sweep/results.h"
#include "bench/sweep/units.h"
#include "matching/fitting.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace obscura {

// Called now and then within a unit: how much of its cost is spent, and what is at hand.
using UnitProgress = std::function<void(double spent, const std::string& note)>;

// Does units of a sweep, and keeps between them what is slow to make: the scene, the view and its
// references, shaders.
class SweepWorker {
  public:
    // All must outlive it. References come from `cache`; thumbnails go into `folder`.
    SweepWorker(const SweepStudy& study, const Folders& folders,
                const std::filesystem::path& folder, const std::filesystem::path& cache,
                const TimedOn& machine, gl::Timing timing, const UnitProgress& progress);
    ~SweepWorker();

    // The result (results.h) of a unit of any kind but `files`. `units` has the fits of all
    // configurations, and the references of views, which are made here unless somebody did.
    std::string work(const SweepUnit& unit, Units& units);

  private:
    struct Stage;

    Fitting& fitting();
    std::string fit(const SweepUnit& unit);
    Stage& stageOf(const View& view);
    void see(const SweepUnit& unit);
    std::string errors(const SweepUnit& unit, Units& units);
    std::string times(const SweepUnit& unit, Units& units);
    std::string growth();
    const Configuration& configuration(std::size_t i, const Units& units);
    TimingPlan timingPlan() const;

    const SweepStudy& study_;
    const Folders& folders_;
    const std::filesystem::path &folder_, &cache_;
    const TimedOn& machine_;
    const gl::Timing timing_;
    const UnitProgress& progress_;
    SceneHashes hashes_;

    MatchStudy trained_; // the training views alone
    double spentOnFits_ = 0, spentBefore_ = 0;
    const Effort::Progress fitProgress_;
    Effort effort_;
    std::unique_ptr<Fitting> fitting_;

    std::unique_ptr<Stage> stage_;
    std::string place_; // group of the unit whose view is seen or timed
    std::optional<MeasuredView> seen_;
    std::optional<Probe> timed_;
    std::map<std::size_t, Configuration> configurations_; // as far as known, by place in the study
};

} // namespace obscura
