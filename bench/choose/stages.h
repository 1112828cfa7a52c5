#pragma once

#include "bench/measure/measured_view.h"
#include "bench/sweep/sweep.h"

#include <functional>
#include <map>
#include <memory>

namespace obscura {

// The views of a study, the training ones at their size and the held-out ones at the first of the
// sizes to measure, each loaded and traced when first asked for.
class Stages {
  public:
    // All must outlive it. `tell`: called while a reference is made.
    Stages(const SweepStudy& study, const Folders& folders, const SweepPlan& plan,
           const std::function<void(const std::string&)>& tell)
        : study_(study), folders_(folders), plan_(plan), tell_(tell), hashes_(folders) {}

    MeasuredView& view(std::size_t i) { return known(study_.match.test[i], false, i); }
    MeasuredView& trainingView(std::size_t i) { return known(study_.match.train[i], true, i); }
    const Scene& scene(std::size_t i) { return stageOf(study_.match.test[i]).scene; }
    std::size_t count() const { return study_.match.test.size(); }
    double secondsForReferences() const { return references_; }

  private:
    struct Stage {
        explicit Stage(Scene loaded) : scene(std::move(loaded)), tracer(scene), subject(scene) {}
        Scene scene;
        LazyTracer tracer;
        Subject subject;
    };
    Stage& stageOf(const View& view);
    MeasuredView& known(const View& view, bool training, std::size_t i);

    const SweepStudy& study_;
    const Folders& folders_;
    const SweepPlan& plan_;
    const std::function<void(const std::string&)>& tell_;
    SceneHashes hashes_;
    std::map<std::string, std::unique_ptr<Stage>> stages_;
    std::map<std::pair<bool, std::size_t>, std::unique_ptr<MeasuredView>> views_;
    double references_ = 0;
};

} // namespace obscura
