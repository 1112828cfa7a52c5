#pragma once

#include "bench/stability/failure_view.h"

#include <array>
#include <vector>

namespace obscura {

// What a camera sees after it has been turned about its line of sight; pictures can be turned back
// to the level view.
class RolledView {
  public:
    // `camera` is that of the level view, before it is turned (failure_scenes.h, rolled()).
    RolledView(const FailureScene& scene, const FailureView& level, const Camera& camera,
               double degrees);

    double degrees() const { return degrees_; }
    const FailureView& view() const { return view_; }
    // Pixels that show the same place in both; rows as the level view has them.
    const Selection& same() const { return same_; }
    // Linear between the rolled image's pixels. What lies outside it takes those at its border.
    Image turnedBack(const Image& image) const;

  private:
    struct Tap {
        std::size_t pixel;
        float weight;
    };
    std::array<Tap, 4> tapsAt(const SeenPoint& point) const;

    double degrees_;
    ImageSize size_;
    FailureView view_;
    Selection same_;
    std::vector<std::array<Tap, 4>> taps_;
};

} // namespace obscura
