#include "bench/stability/failure_view.h"

#include "base/error.h"

#include <algorithm>
#include <numbers>

namespace obscura {

namespace {

constexpr int truthRays = 64; // for pictures, and for means over many pixels

SeenPoint seenPoint(const Surfaces& surfaces, int x, int y) {
    const std::size_t i = surfaces.index(x, y);
    if (surfaces.empty(i))
        return {};
    const glm::vec3 inView =
        surfaces.position(static_cast<float>(x), static_cast<float>(y), surfaces.depth[i]);
    const float cosine = glm::dot(surfaces.faceNormal[i], glm::normalize(-inView));
    return {true,
            glm::vec3(surfaces.frame.worldFromView * glm::vec4(inView, 1)),
            glm::degrees(std::acos(std::clamp(cosine, -1.0f, 1.0f))),
            static_cast<float>(x) + 0.5f - static_cast<float>(surfaces.width) / 2,
            static_cast<float>(y) + 0.5f - static_cast<float>(surfaces.height) / 2,
            glm::length(inView)};
}

// The selected pixels alone, in a row.
Image selected(const Image& image, const Selection& selection) {
    Image row{0, 1, 1, {}};
    for (std::size_t i = 0; i < selection.size(); ++i)
        if (selection[i])
            row.pixels.push_back(image.pixels[i]);
    row.width = static_cast<int>(row.pixels.size());
    return row;
}

} // namespace

bool between(float value, double low, double high) {
    return low <= static_cast<double>(value) && static_cast<double>(value) < high;
}

FailureView::FailureView(const FailureScene& scene, const Camera& camera, ImageSize size,
                         Probe::StoredDepth storedDepth)
    : scene_(scene), probe_(scene.subject, camera, size.width, size.height, Normals::smooth, 1,
                            std::move(storedDepth)) {
    for (int y = size.height - 1; y >= 0; --y)
        for (int x = 0; x < size.width; ++x)
            points_.push_back(seenPoint(probe_.surfaces(), x, y));
}

Selection FailureView::select(const std::function<bool(const SeenPoint&)>& condition) const {
    Selection selection;
    for (const SeenPoint& point : points_)
        selection.push_back(point.shown && condition(point));
    if (std::find(selection.begin(), selection.end(), true) == selection.end())
        throw Error("the images are too small for the stability tests; 72 lines will do");
    return selection;
}

double FailureView::radiusPixels() const {
    const Frame& frame = probe_.surfaces().frame;
    return static_cast<double>(frame.depth.w * frame.size.y / frame.depth.z);
}

const Image& FailureView::truth() const {
    if (!truth_) {
        TraceSettings settings;
        settings.radius = 1;
        settings.rays = truthRays;
        truth_ = scene_.tracer.trace(probe_.surfaces(), settings).visibility;
    }
    return *truth_;
}

Image FailureView::lit() const {
    const Surfaces& surfaces = probe_.surfaces();
    Image image{surfaces.width, surfaces.height, 1, {}};
    for (const SeenPoint& point : points_) {
        const float light = std::cos(glm::radians(point.degrees)) * surfaces.frame.depth.z;
        image.pixels.push_back(
            point.shown ? srgbFromLinear(std::min(0.8f * light / point.distance, 1.0f)) : 1);
    }
    return image;
}

Image onlySelected(const Image& image, const Selection& selection) {
    Image result = image;
    for (std::size_t i = 0; i < selection.size(); ++i)
        result.pixels[i] = selection[i] ? image.pixels[i] : 1;
    return result;
}

double meanOcclusion(const Image& visibility, const Selection& selection) {
    const Image open{visibility.width, visibility.height, 1,
                     std::vector<float>(visibility.pixels.size(), 1.0f)};
    return difference(visibility, open, selection).mean;
}

double largestOcclusion(const Image& visibility, const Selection& selection) {
    const Image row = selected(visibility, selection);
    return 1 - static_cast<double>(*std::min_element(row.pixels.begin(), row.pixels.end()));
}

Difference difference(const Image& first, const Image& second, const Selection& selection) {
    return compare(selected(first, selection), selected(second, selection));
}

} // namespace obscura
