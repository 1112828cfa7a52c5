#include "renderer/builtin_noise.h"

#include "protocols/random.h"

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
    const auto next = [&](unsigned seed, int coordinate) {
        return order_[(seed + static_cast<unsigned>(coordinate)) & 255U];
    };
    return values_[next(next(next(0, x), y), z)];
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
    const int x0 = x & mask, x1 = (x + 1) & mask, y0 = y & mask, y1 = (y + 1) & mask;
    return glm::mix(glm::mix(lattice(x0, y0, period), lattice(x1, y0, period), t.x),
                    glm::mix(lattice(x0, y1, period), lattice(x1, y1, period), t.x), t.y);
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
