#pragma once

#include "bench/measure/timing.h"
#include "bench/sweep/row.h"
#include "protocols/reader/sweep.h"

#include <functional>
#include <vector>

namespace obscura {

// How cost grows, one thing at a time: with samples, radius, pixels, and silhouettes.

// A wall 10 m away and `poles` thin upright poles scattered before it; a scene of more poles has
// all poles of a scene of fewer. The more poles, the more depth edges. `poleFieldCamera` sees it
// from the origin.
Scene poleField(int poles);
Camera poleFieldCamera();

// The share of pixels whose depth differs by more than a twentieth from that of the pixel to the
// right or above.
double silhouettes(const Surfaces& surfaces);

// How many groups of techniques costGrowth() times, which is what its progress counts.
int growthSteps(const GrowthPlan& plan);
std::vector<GrowthRow> costGrowth(const GrowthPlan& plan, const View& view, const Subject& subject,
                                  Normals normals, const TimingPlan& timing,
                                  const std::function<void()>& stepDone);

} // namespace obscura
