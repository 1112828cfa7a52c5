#pragma once

#include "renderer/reference/reference.h"

#include <array>

namespace obscura {

// What the choice of normal does to one view's visibility, over the pixels that show a surface.
struct NormalsEffect {
    std::array<double, 3> mean{}; // visibility with face, smooth, mapped normals
    // Root mean square of the difference between two kinds, the rays' own noise taken out.
    double faceSmooth = 0, smoothMapped = 0, faceMapped = 0;
    double noise = 0; // root mean square of the standard errors
};
NormalsEffect measureNormals(const Scene& scene, const Camera& camera, int width, int height,
                             const TraceSettings& settings);

} // namespace obscura
