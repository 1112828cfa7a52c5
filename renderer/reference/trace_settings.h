#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace obscura {

// Which integral over the hemisphere Omega around the normal n; V is 1 where nothing is met within
// the radius R, t the distance of the nearest thing met.
enum class Integral {
    cosine,  // 1/pi  int V (n.w) dw
    uniform, // 1/2pi int V dw
    falloff  // 1/pi  int min(t/R, 1) (n.w) dw: 1 - t/R of an occluder counts
};

// "cosine", "uniform", "falloff", in the order of the enumeration.
const std::vector<std::string>& integralNames();

struct TraceSettings {
    Integral integral = Integral::cosine;
    double radius = 0.5; // R, metres
    int rays = 256;      // per pixel; rounded up to a power of two, at least 2
    std::uint64_t seed = 1;
    int threads = 0; // 0: all cores. The result does not depend on it
    // The rays of all pixels leave their normals in the same directions. Errors then form not noise
    // but a pattern that stays on the surfaces when the camera moves. Many pixels may have the same
    // error, so `error` says nothing about means.
    bool sameRays = false;
};

} // namespace obscura
