#include "renderer/builtin/noise.h"
#include "renderer/builtin/textures.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace obscura::builtin {

Painter bark() {
    return [noise = Noise("builtin/bark")](glm::vec2 uv) {
        const float bent = noise.clouds(uv * 8.0F, 8, 3);
        const float crack =
            std::abs(noise.clouds(glm::vec2(uv.x * 8, uv.y * 32 + 3 * bent), 32, 3));
        const float ridge = ramp(0.02F, 0.22F, crack);
        const float moss = ramp(0.1F, 0.4F, noise.clouds(uv * 4.0F + 3.0F, 4, 4));
        Texel texel;
        texel.colour =
            glm::mix(glm::vec3(0.22F, 0.18F, 0.15F), glm::vec3(0.50F, 0.44F, 0.37F), ridge);
        texel.colour = glm::mix(texel.colour, glm::vec3(0.38F, 0.42F, 0.28F), 0.4F * moss);
        texel.height = 0.008F * ridge;
        return texel;
    };
}

Painter earth() {
    return [noise = Noise("builtin/earth")](glm::vec2 uv) {
        const float clod = noise.clouds(uv * 32.0F, 32, 4), cloud = noise.clouds(uv * 4.0F, 4, 3);
        const float pebble = ramp(0.55F, 0.7F, noise.value(uv * 64.0F, 64));
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.20F, 0.15F, 0.11F), glm::vec3(0.38F, 0.30F, 0.22F),
                                0.5F + 0.7F * clod + 0.3F * cloud);
        texel.colour = glm::mix(texel.colour, glm::vec3(0.52F, 0.48F, 0.42F), 0.7F * pebble);
        texel.height = 0.02F * clod + 0.006F * pebble;
        return texel;
    };
}

Painter turf() {
    return [noise = Noise("builtin/turf")](glm::vec2 uv) {
        const float blades = noise.clouds(uv * 128.0F, 128, 2),
                    cloud = noise.clouds(uv * 4.0F, 4, 4);
        const float bare = ramp(0.15F, 0.45F, noise.clouds(uv * 16.0F + 5.0F, 16, 3));
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.16F, 0.24F, 0.08F), glm::vec3(0.38F, 0.45F, 0.18F),
                                0.45F + 0.5F * blades + 0.3F * cloud);
        texel.colour = glm::mix(texel.colour, glm::vec3(0.32F, 0.26F, 0.18F), 0.6F * bare);
        texel.height = 0.006F * blades;
        return texel;
    };
}

namespace {

// One leaf from `foot` along the unit vector `axis`.
struct PaintedLeaf {
    glm::vec2 foot, axis;
    float length, width; // width: half of it, at the widest
};

// How far inside a leaf, 0 at its edge and 1 on its rib; less than 0 outside.
float insideLeaf(const PaintedLeaf& leaf, glm::vec2 p) {
    const glm::vec2 away = p - leaf.foot;
    const float t = glm::dot(away, leaf.axis) / leaf.length;
    if (t <= 0 || t >= 1)
        return -1;
    const float side = std::abs(leaf.axis.x * away.y - leaf.axis.y * away.x);
    const float half = leaf.width * std::pow(std::sin(glm::pi<float>() * std::pow(t, 0.8F)), 0.8F);
    return 1 - side / glm::max(half, 1e-5F);
}

} // namespace

Painter twig(int pairs, float width, glm::vec3 dark, glm::vec3 light) {
    return [=, noise = Noise("builtin/twig")](glm::vec2 uv) {
        const glm::vec2 p = uv - glm::vec2(0.5F, 0);
        const float tone = noise.clouds(uv * 8.0F, 8, 3);
        Texel texel;
        texel.colour = dark;
        texel.alpha = 0;
        if (std::abs(p.x) < 0.012F && uv.y < 0.8F) {
            texel.colour = glm::vec3(0.34F, 0.29F, 0.18F);
            texel.alpha = 1;
        }
        for (int i = 0; i <= 2 * pairs; ++i) { // the one at the tip last, over the others
            const bool tip = i == 2 * pairs;
            const float side = tip ? 0.0F : (i % 2 == 0 ? -1.0F : 1.0F);
            const float t = (static_cast<float>(i) + 0.4F) / static_cast<float>(2 * pairs + 1);
            const float length = tip ? 0.34F : 0.40F - 0.06F * t;
            const float open = side * (1.05F - 0.35F * t + 0.2F * (noise.cell(i, 5) - 0.5F));
            const PaintedLeaf leaf{{0, tip ? 0.62F : 0.04F + 0.66F * t},
                                   {std::sin(open), std::cos(open)},
                                   length,
                                   width * length};
            const float inside = insideLeaf(leaf, p);
            if (inside < 0)
                continue;
            const float vein = inside > 0.9F ? 1.0F : 0.0F;
            texel.colour = glm::mix(dark, light,
                                    0.25F + 0.5F * noise.cell(i, 7) + 0.4F * tone + 0.25F * vein) *
                           (0.85F + 0.15F * inside);
            texel.alpha = 1;
        }
        return texel;
    };
}

Painter ivy() {
    return [noise = Noise("builtin/ivy")](glm::vec2 uv) {
        const glm::vec2 p = uv - glm::vec2(0.5F, 0.42F);
        const float angle = std::atan2(p.x, p.y), lobes = 0.5F + 0.5F * std::cos(5 * angle);
        const float notch = ramp(0.5F, 0.0F, glm::pi<float>() - std::abs(angle));
        const float edge = (0.29F + 0.17F * lobes * (1 - 0.4F * std::abs(std::sin(angle / 2)))) *
                               (1 - 0.6F * notch) +
                           0.10F * ramp(0.6F, 0, std::abs(angle));
        const float r = glm::length(p);
        const bool stalk = std::abs(p.x) < 0.015F && p.y < 0;
        const float vein = lobes > 0.93F ? 1.0F : 0.0F;
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.10F, 0.22F, 0.09F), glm::vec3(0.26F, 0.40F, 0.16F),
                                0.4F + 0.6F * noise.clouds(uv * 4.0F, 4, 3) + 0.45F * vein);
        texel.alpha = r < edge || stalk ? 1 : 0;
        return texel;
    };
}

Painter lavender() {
    return [noise = Noise("builtin/lavender")](glm::vec2 uv) {
        const float x = std::abs(uv.x - 0.5F), tone = noise.clouds(uv * 16.0F, 16, 3);
        Texel texel;
        texel.colour = glm::vec3(0.42F, 0.50F, 0.32F) * (1 + 0.3F * tone);
        texel.alpha = x < 0.035F ? 1 : 0;
        if (uv.y > 0.62F && uv.y < 0.985F) { // whorls of flowers, smaller upwards
            const float t = (uv.y - 0.62F) / 0.365F;
            const float whorl = std::abs(std::sin(glm::pi<float>() * 5 * t));
            if (x < (0.05F + 0.17F * whorl) * (1.1F - 0.6F * t)) {
                texel.colour = glm::mix(glm::vec3(0.33F, 0.24F, 0.50F),
                                        glm::vec3(0.62F, 0.50F, 0.78F), 0.45F + tone);
                texel.alpha = 1;
            }
        } else if (uv.y < 0.4F) { // narrow leaves
            const float row = glm::fract(uv.y * 9 - 2.4F * x);
            if (std::abs(row - 0.5F) < 0.22F &&
                x < 0.36F * ramp(0.0F, 0.1F, uv.y) * ramp(0.42F, 0.2F, uv.y)) {
                texel.colour = glm::mix(glm::vec3(0.36F, 0.44F, 0.33F),
                                        glm::vec3(0.56F, 0.62F, 0.48F), 0.5F + tone);
                texel.alpha = 1;
            }
        }
        return texel;
    };
}

Painter reed() {
    return [noise = Noise("builtin/reed")](glm::vec2 uv) {
        const float tone = noise.clouds(uv * glm::vec2(32, 2), 32, 3);
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.30F, 0.38F, 0.16F), glm::vec3(0.70F, 0.66F, 0.40F),
                                0.25F + 0.5F * uv.y + tone);
        // Three blades that leave one another.
        texel.alpha = 0;
        for (int i = -1; i <= 1; ++i) {
            const float t = uv.y / (1 - 0.12F * std::abs(static_cast<float>(i)));
            const float middle = 0.5F + 0.36F * static_cast<float>(i) * t * t;
            if (t < 1 && std::abs(uv.x - middle) < 0.075F * std::pow(1 - t, 0.6F))
                texel.alpha = 1;
        }
        return texel;
    };
}

} // namespace obscura::builtin
