#pragma once

#include "image/image.h"

#include <span>
#include <string>

namespace obscura {

// Pictures of what the temporal measures measure: changes are shown `changeGain` times as strong.
constexpr float changeGain = 8;

// The change as it is shown.
Image amplified(Image change);

// Images of one channel and one size side by side, as code values.
Image8 strip(std::span<const Image> images);

// One technique in one frame of an animation.
struct AnimatedRow {
    std::string title;
    Image visibility, unreal; // |unreal change| (temporal_measures.h)
};

// Rows of visibility, the truth and the unreal change, with words; 3 channels. Small images are
// enlarged, pixel by pixel.
Image8 animationFrame(std::span<const AnimatedRow> rows, const Image& truth);

} // namespace obscura
