#pragma once

#include "protocols/reader/match.h"
#include "renderer/probe.h"
#include "renderer/reference/reference.h"

#include <functional>
#include <optional>
#include <vector>

namespace obscura {

// A scene that is ready to be drawn and to be traced.
struct FailureScene {
    explicit FailureScene(const Scene& scene) : subject(scene), tracer(scene) {}

    Subject subject;
    RayTracer tracer;
};

// What a pixel shows.
struct SeenPoint {
    bool shown = false;     // otherwise nothing
    glm::vec3 position{0};  // of the world
    float degrees = 0;      // between the face's normal and the direction to the camera
    float pixelsAcross = 0; // the point is this many pixels right of the image's middle,
    float pixelsUp = 0;     // and this many above it
    float distance = 0;     // from the camera
};

// low <= value < high.
bool between(float value, double low, double high);

// Which pixels a measure is about; rows from top to bottom.
using Selection = std::vector<bool>;

// What a camera sees of a scene: techniques can be run on it, and it knows the truth. The scene
// must live as long as this object.
class FailureView {
  public:
    FailureView(const FailureScene& scene, const Camera& camera, ImageSize size,
                Probe::StoredDepth storedDepth = {});

    const Probe& probe() const { return probe_; }
    const std::vector<SeenPoint>& points() const { return points_; } // rows from top to bottom
    // Pixels that show something for which the condition holds. None at all is an Error: the image
    // is too small for the test.
    Selection select(const std::function<bool(const SeenPoint&)>& condition) const;
    // Pixels that a radius of 1 m covers at the focus distance.
    double radiusPixels() const;
    // Visibility by ray tracing with a radius of 1 m; traced when first asked for.
    const Image& truth() const;
    // The scene lit by a lamp at the camera, so that people recognise what they see.
    Image lit() const;

  private:
    const FailureScene& scene_;
    Probe probe_;
    std::vector<SeenPoint> points_;
    mutable std::optional<Image> truth_;
};

// The image where it is selected, white elsewhere.
Image onlySelected(const Image& image, const Selection& selection);

// Measures of visibility over the selected pixels.
double meanOcclusion(const Image& visibility, const Selection& selection);
double largestOcclusion(const Image& visibility, const Selection& selection);
Difference difference(const Image& first, const Image& second, const Selection& selection);

} // namespace obscura
