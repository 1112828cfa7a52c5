#pragma once

#include "bench/sweep/row.h"
#include "matching/truths.h"
#include "protocols/reader/sweep.h"
#include "renderer/lit_view.h"
#include "renderer/render.h"

#include <map>
#include <optional>

namespace obscura {

// A technique's settings as a study has them, and what matching fitted.
struct Configuration {
    TechniqueSetting setting;
    std::map<std::string, double> fitted;
};
Settings settingsAt(const Configuration& configuration, double radius, bool matched);

std::string sceneOf(const View& view); // file or built-in name
// A view of the built-in scene of that name, or else of that file, whose camera is still to be set.
View viewOfScene(const std::string& scene);

// Called while a truth is made: how many of the seconds that truthCost() names are over, and which
// truth it is.
using TruthProgress = std::function<void(double seconds, const std::string& note)>;

struct ViewErrors {
    PictureError full, depth, lit; // depth and lit: NaN where the view has no such truth
};

// One view at one size with all that techniques are compared with there.
class MeasuredView {
  public:
    // `withDepth`: the depth-buffer reference too. `folders` and `sceneSha256` are the view's.
    MeasuredView(const Subject& subject, LazyTracer& tracer, const SweepStudy& study,
                 const View& view, const ImageSize& size, bool withDepth, const Folders& folders,
                 const std::string& sceneSha256, const std::filesystem::path& cache,
                 const TruthProgress& progress);

    const View& view() const { return view_; }
    const ImageSize& size() const { return size_; }
    const Probe& probe() const { return probe_; }
    const Image& truth() const { return truth_; }

    ViewErrors errorsOf(const Image& visibility);

  private:
    View view_;
    ImageSize size_;
    Probe probe_;
    Image truth_;
    std::optional<Image> depthTruth_;
    std::optional<LitView> lit_;
    Image8 litTruth_;
    Display display_;
};

} // namespace obscura
