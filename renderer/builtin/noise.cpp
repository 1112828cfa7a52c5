#include "renderer/builtin/noise.h"

#include "base/random.h"

#include <numeric>
#include <vector>

namespace obscura::builtin {

Noise::Noise(std::string_view purpose) {
    Random random(0, purpose);
    std::vector<std::uint8_t> order(order_.size());
    std::iota(order.begin(), order.end(), std::uint8_t{0});
    random.shuffle(order);
    for (std::size_t i = 0; i < order.size(); ++i) {
        order_[i] = order[i];
        values_[i] = static_cast<float>(2 * random.uniform() - 1);
    }
}

float Noise::lattice(int x, int y, int z) const {
    const auto next = [&](unsigned seed, int i) {
        return (seed + static_cast<unsigned>(i)) & 255U;
    };
    return values_[next(order_[next(order_[next(0, x)], y)], z)];
}

float Noise::cell(int x, int y) const { return 0.5F + 0.5F * lattice(x, y, 17); }

namespace {

// Perlin, "Improving noise", SIGGRAPH 2002: no jump in the second derivative at lattice points.
template <typename T>
T fade(T t) {
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

// std::floor is a library call on x86-64's baseline, and a texture asks for tens of millions.
int floorOf(float x) {
    const int truncated = static_cast<int>(x);
    return truncated - (x < static_cast<float>(truncated) ? 1 : 0);
}

} // namespace

float Noise::value(glm::vec2 p, int period) const {
    const int x = floorOf(p.x), y = floorOf(p.y), mask = period - 1;
    const glm::vec2 t = fade(p - glm::vec2(x, y));
    // Each column of the lattice begins elsewhere in the table; each period, elsewhere again.
    const auto column = [&](int i) {
        return order_[static_cast<unsigned>((i & mask) + period) & 255U];
    };
    const int left = column(x), right = column(x + 1), low = y & mask, high = (y + 1) & mask;
    const auto at = [&](int i) { return values_[static_cast<unsigned>(i) & 255U]; };
    return glm::mix(glm::mix(at(left + low), at(right + low), t.x),
                    glm::mix(at(left + high), at(right + high), t.x), t.y);
}

float Noise::value(glm::vec3 p) const {
    const glm::ivec3 low(floorOf(p.x), floorOf(p.y), floorOf(p.z));
    const glm::vec3 t = fade(p - glm::vec3(low));
    std::array<float, 2> layers{};
    for (int k = 0; k < 2; ++k) {
        const auto row = [&](int j) {
            return glm::mix(lattice(low.x, low.y + j, low.z + k),
                            lattice(low.x + 1, low.y + j, low.z + k), t.x);
        };
        layers[static_cast<std::size_t>(k)] = glm::mix(row(0), row(1), t.y);
    }
    return glm::mix(layers[0], layers[1], t.z);
}

float Noise::clouds(glm::vec2 p, int period, int octaves) const {
    float sum = 0, height = 0.5F;
    for (int i = 0; i < octaves; ++i) {
        sum += height * value(p, period);
        p *= 2;
        period *= 2;
        height /= 2;
    }
    return sum;
}

} // namespace obscura::builtin
