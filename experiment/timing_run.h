#pragma once

#include "experiment/display.h"

#include <functional>
#include <string>
#include <vector>

namespace obscura {

// How one mask was held.
struct MaskTiming {
    double seconds = 0; // from its onset to that of the image after it
    int refreshes = 0;
    int missed = 0; // intervals between its refreshes above 1.2 of one
};

// Masks held one after the other, and on what.
struct TimingRun {
    double seconds = 2; // asked for
    Refresh refresh;
    int planned = 0; // refreshes of each
    std::vector<MaskTiming> masks;
    std::string ended; // why before the last mask; "" when it was reached

    // Masks of another number of refreshes than planned, or off by half of one or more.
    int wrong() const;
    int missed() const;
};

// Shows so many grey masks, each between two images, swapping at every refresh as a trial does.
// `progress` is told after each mask how many are done, while an image is on view. Ends early, in
// order, by a signal or by Escape: what was measured until then is in `run`. A signal is thrown on.
void holdMasks(StimulusDisplay& display, int masks, TimingRun& run,
               const std::function<void(int)>& progress);

} // namespace obscura
