#pragma once

#include "metrics/image_error.h"
#include "renderer/probe.h"
#include "renderer/reference/reference.h"

#include <vector>

namespace obscura {

// The least error, against the scene's reference, of one that knows everything that so many layers
// of depth show and nothing else: a ray is blocked if the first thing that blocks it is a point of
// one of the layers, on the screen or within the guard band.
struct LayersFloor {
    int layers = 1;       // each at least layerSeparation radii behind the one before
    double guardBand = 0; // of the image's height, beyond each border
    ImageError error;
};
// For one to three layers, without a guard band and with that of a tenth. A layer's points are not
// those of pixels but of the rays from the camera through what blocks, so no floor depends on the
// size of the image. `settings` of the integrals that ask whether a ray is blocked.
std::vector<LayersFloor> measureLayers(const Scene& scene, const Probe& probe,
                                       const TraceSettings& settings);

} // namespace obscura
