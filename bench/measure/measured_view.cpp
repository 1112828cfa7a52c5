#include "bench/measure/measured_view.h"

#include "bench/measure/picture_error.h"
#include "renderer/builtin/builtin.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

Settings settingsAt(const Configuration& configuration, double radius, bool matched) {
    Settings settings = settingsOf(configuration.setting, radius);
    if (matched)
        for (const auto& [name, value] : configuration.fitted)
            settings.set(name, value);
    return settings;
}

std::string sceneOf(const View& view) { return view.file.empty() ? view.builtin : view.file; }

View viewOfScene(const std::string& scene) {
    View view;
    const auto builtins = builtinSceneNames();
    const bool builtin = std::find(builtins.begin(), builtins.end(), scene) != builtins.end();
    (builtin ? view.builtin : view.file) = scene;
    return view;
}

MeasuredView::MeasuredView(const Subject& subject, LazyTracer& tracer, const SweepStudy& study,
                           const View& view, const ImageSize& size, bool withDepth,
                           const Folders& folders, const std::string& sceneSha256,
                           const std::filesystem::path& cache, const TruthProgress& progress)
    : view_(view), size_(size),
      probe_(subject, view.camera, size.width, size.height, study.match.normals, study.match.seed),
      display_(study.display) {
    const double cost = truthCost(size, study.match.rays);
    double before = 0;
    const auto truth = [&](Truth kind) {
        const std::string note = fmt::format("{} reference of {}", nameOf(kind), view.name);
        Image image =
            truthOf(kind, {view, size, study.match.rays, study.match.normals, study.match.seed},
                    probe_, tracer, sceneSha256, cache,
                    [&](double share) { progress(before + share * cost, note); });
        progress(before += cost, note);
        return image;
    };
    truth_ = truth(study.match.truth);
    if (withDepth)
        depthTruth_ = truth(Truth::depth);
    if (study.light) {
        lit_.emplace(subject, view, *study.light, folders.protocol, size.width, size.height,
                     study.match.seed);
        litTruth_ = lit_->image(truth_);
    }
}

ViewErrors MeasuredView::errorsOf(const Image& visibility) {
    ViewErrors errors{visibilityError(visibility, truth_, probe_.shown()), {}, {}};
    if (depthTruth_)
        errors.depth = visibilityError(visibility, *depthTruth_, probe_.shown());
    if (lit_)
        errors.lit = litError(lit_->image(visibility), litTruth_, probe_.shown(), display_);
    return errors;
}

} // namespace obscura
