#pragma once

#include "bench/motion/temporal_study.h"

#include <functional>

namespace obscura {

// Steadiness from frame to frame: one test per camera path (temporal_tests.h), measured as in
// temporal_measures.h. Noise is used as in a game without temporal filtering: it keeps to its
// pixels while the camera moves. Only in the test "still" does its seed change with every frame.
//
// The headline is reference-relative change, motion-compensated. Its plain form, pixel by pixel, is
// given too, but tells bias from truth and not flicker: `none` lies in the midst of all techniques,
// because a constant picture lacks the truth's change at every edge that passes a pixel.
//
// The truth is traced with rays that are the same for all pixels and frames, so that their error
// sticks to the surfaces. What is left of it can be read from a configuration of `ray_traced`,
// which has other rays, as many as its settings say; what is left of fetching bilinearly, from
// `none`: its unreal change is the truth's warped change. No technique can be told from perfect
// below those.

TemporalEffort fullTemporalEffort();
TemporalEffort quickTemporalEffort(); // smaller, fewer frames and rays, and two paths

// Told the share done, 0 ... 1, and the test at hand.
using TemporalProgress = std::function<void(double, const std::string&)>;

// A GL context must be current. Fewer frames than 3, an unknown test or a file that cannot be
// written is an Error.
std::vector<StabilityCell> measureTemporal(const TemporalStudy& study,
                                           const TemporalProgress& progress = {});

} // namespace obscura
