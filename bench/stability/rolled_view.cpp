#include "bench/stability/rolled_view.h"

#include "bench/stability/failure_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {

namespace {

constexpr float sameWithin = 0.02f; // metres

ImageSize sizeOf(const FailureView& view) {
    return {view.probe().surfaces().width, view.probe().surfaces().height};
}

} // namespace

RolledView::RolledView(const FailureScene& scene, const FailureView& level, const Camera& camera,
                       double degrees)
    : degrees_(degrees), size_(sizeOf(level)), view_(scene, rolled(camera, degrees), size_) {
    const float reach = static_cast<float>(std::min(size_.width, size_.height)) / 2 - 1;
    for (const SeenPoint& point : level.points()) {
        const std::array<Tap, 4> taps = tapsAt(point);
        glm::vec3 seen(0);
        for (const Tap& tap : taps)
            seen += tap.weight * view_.points()[tap.pixel].position;
        same_.push_back(point.shown && std::hypot(point.pixelsAcross, point.pixelsUp) < reach &&
                        glm::distance(seen, point.position) < sameWithin);
        taps_.push_back(taps);
    }
}

Image RolledView::turnedBack(const Image& image) const {
    Image result = image;
    for (std::size_t i = 0; i < taps_.size(); ++i) {
        result.pixels[i] = 0;
        for (const Tap& tap : taps_[i])
            result.pixels[i] += tap.weight * image.pixels[tap.pixel];
    }
    return result;
}

std::array<RolledView::Tap, 4> RolledView::tapsAt(const SeenPoint& point) const {
    const double radians = degrees_ * std::numbers::pi / 180;
    const auto sine = static_cast<float>(std::sin(radians));
    const auto cosine = static_cast<float>(std::cos(radians));
    const float across = cosine * point.pixelsAcross - sine * point.pixelsUp;
    const float up = sine * point.pixelsAcross + cosine * point.pixelsUp;
    const auto width = static_cast<float>(size_.width), height = static_cast<float>(size_.height);
    const float x = std::clamp(across + width / 2 - 0.5f, 0.0f, width - 1.001f);
    const float y = std::clamp(height / 2 - up - 0.5f, 0.0f, height - 1.001f);
    const float right = x - std::floor(x), below = y - std::floor(y);
    const auto pixel =
        static_cast<std::size_t>(static_cast<int>(y) * size_.width + static_cast<int>(x));
    const auto row = static_cast<std::size_t>(size_.width);
    return {Tap{pixel, (1 - right) * (1 - below)}, Tap{pixel + 1, right * (1 - below)},
            Tap{pixel + row, (1 - right) * below}, Tap{pixel + row + 1, right * below}};
}

} // namespace obscura
