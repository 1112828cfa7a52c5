#include "bench/choose/stages.h"

#include <chrono>

namespace obscura {

MeasuredView& Stages::known(const View& view, bool training, std::size_t i) {
    std::unique_ptr<MeasuredView>& known = views_[{training, i}];
    if (!known) {
        Stage& stage = stageOf(view);
        const auto start = std::chrono::steady_clock::now();
        known = std::make_unique<MeasuredView>(
            stage.subject, stage.tracer, study_, view,
            training ? study_.match.training : study_.sizes.front(), false, folders_,
            hashes_.of(view), plan_.cache, [&](double, const std::string& note) { tell_(note); });
        references_ +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    return *known;
}

Stages::Stage& Stages::stageOf(const View& view) {
    std::unique_ptr<Stage>& known = stages_[sceneOf(view)];
    if (!known)
        known = std::make_unique<Stage>(loadSceneOf(view, folders_));
    return *known;
}

} // namespace obscura
