#pragma once

#include "image/image.h"
#include "protocols/reader/study.h"

namespace obscura {

// The exposure, in stops, under which the geometric mean of a picture's luminance would be middle
// grey (.18 before the display curve), as a camera's meter sets it; in halves of a stop, -8 to 8.
// The picture (sRGB, 3 channels) was shown with `exposure` and `curve`; of what the curve has
// clipped it knows no more than that it is bright.
double meteredExposure(const Image8& picture, Curve curve, double exposure);

} // namespace obscura
