#pragma once

#include "base/random.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string_view>

namespace obscura::builtin {

// 0 at `from`, 1 at `to`, which may be the smaller; smooth between.
inline float ramp(float from, float to, float x) {
    const float t = glm::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

inline float between(Random& random, double low, double high) {
    return static_cast<float>(low + (high - low) * random.uniform());
}

// Smooth noise over a lattice of random values (value noise with Perlin's quintic fade). The same
// numbers on every machine: the lattice comes from Random, and the rest is arithmetic.
class Noise {
  public:
    explicit Noise(std::string_view purpose);

    float value(glm::vec3 p) const; // -1 ... 1
    // Repeats every `period`, a power of two, in both directions.
    float value(glm::vec2 p, int period) const;
    // `octaves` of the above, each half as high and twice as fine.
    float clouds(glm::vec2 p, int period, int octaves) const;
    float cell(int x, int y) const; // one lattice value, 0 ... 1

  private:
    float lattice(int x, int y, int z) const;

    std::array<std::uint8_t, 256> order_{};
    std::array<float, 256> values_{};
};

} // namespace obscura::builtin
