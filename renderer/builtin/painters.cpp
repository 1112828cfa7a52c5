#include "renderer/builtin/noise.h"
#include "renderer/builtin/textures.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace obscura::builtin {

namespace {

// One stone of a wall or floor: which one, and how far inside its edge (metres).
struct Stone {
    float tone; // 0 ... 1, the stone's own
    float inside;
    glm::vec2 slope; // of its surface: no two lie quite level
    glm::vec2 local; // -0.5 ... 0.5
};

// Courses of equal height, each cut into stones of about `width` and shifted against the next.
Stone stoneAt(glm::vec2 metres, float period, glm::vec2 size, const Noise& noise) {
    const int courses = static_cast<int>(std::lround(period / size.y));
    const int stones = static_cast<int>(std::lround(period / size.x));
    const int course = static_cast<int>(std::floor(metres.y / size.y)) % courses;
    const float shift = noise.cell(course, 91) + (course % 2 == 0 ? 0.0F : 0.5F);
    const auto joint = [&](int i) { // the left edge of stone i, in stones
        return static_cast<float>(i) + 0.3F * (noise.cell((i + stones) % stones, course) - 0.5F);
    };
    const float across = std::fmod(metres.x / size.x + shift, static_cast<float>(stones));
    int i = static_cast<int>(std::floor(across));
    i += across < joint(i) ? -1 : (across >= joint(i + 1) ? 1 : 0);
    const int name = (i + stones) % stones;
    const float y = metres.y / size.y - std::floor(metres.y / size.y);
    const float left = (across - joint(i)) * size.x, right = (joint(i + 1) - across) * size.x;
    const float inside = glm::min(glm::min(left, right), glm::min(y, 1 - y) * size.y);
    return {noise.cell(name + 40, course + 7),
            inside,
            glm::vec2(noise.cell(name, course + 60), noise.cell(name, course + 90)) - 0.5F,
            {left / (left + right) - 0.5F, y - 0.5F}};
}

} // namespace

Painter ashlar() {
    return [noise = Noise("builtin/ashlar")](glm::vec2 uv) {
        const glm::vec2 ragged(noise.value(uv * 128.0F, 128),
                               noise.value(uv * 128.0F + 31.0F, 128));
        const glm::vec2 metres = 4.0F * glm::fract(uv + 0.0005F * ragged);
        const Stone stone = stoneAt(metres, 4, {0.8F, 0.4F}, noise);
        const float cloud = noise.clouds(uv * 8.0F, 8, 4);
        const float grain = noise.clouds(uv * 256.0F, 256, 2);
        const float face = ramp(0.003F, 0.016F, stone.inside);
        const float stain = ramp(0.05F, 0.6F, noise.clouds(uv * glm::vec2(8, 4) + 9.0F, 8, 3));
        glm::vec3 colour = glm::mix(glm::vec3(0.70F, 0.60F, 0.46F), glm::vec3(0.84F, 0.75F, 0.60F),
                                    0.65F * stone.tone + 0.6F * cloud + 0.2F);
        colour *= 1 + 0.10F * grain - 0.16F * stain;
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.50F, 0.43F, 0.34F), colour, 0.25F + 0.75F * face);
        texel.height = 0.006F * face + 0.004F * cloud + 0.0012F * grain +
                       0.008F * face * glm::dot(stone.slope, stone.local);
        return texel;
    };
}

Painter bricks() {
    return [noise = Noise("builtin/bricks")](glm::vec2 uv) {
        const glm::vec2 ragged{noise.value(uv * 128.0F, 128),
                               noise.value(uv * 128.0F + 21.0F, 128)};
        const glm::vec2 metres = 2.0F * glm::fract(uv + 0.0008F * ragged);
        const Stone brick = stoneAt(metres, 2, {0.222F, 0.0769F}, noise);
        const float cloud = noise.clouds(uv * 16.0F, 16, 4);
        const float grain = noise.clouds(uv * 256.0F, 256, 2);
        const float face = ramp(0.003F, 0.009F, brick.inside);
        glm::vec3 colour = glm::mix(glm::vec3(0.44F, 0.22F, 0.16F), glm::vec3(0.66F, 0.38F, 0.27F),
                                    brick.tone + 0.4F * cloud);
        colour *= 1 + 0.16F * grain + 0.2F * cloud;
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.62F, 0.57F, 0.50F) * (1 + 0.2F * grain), colour, face);
        texel.height = 0.006F * face + 0.0015F * grain + 0.002F * cloud +
                       0.01F * face * glm::dot(brick.slope, brick.local);
        return texel;
    };
}

Painter limestone() {
    return [noise = Noise("builtin/limestone")](glm::vec2 uv) {
        const float cloud = noise.clouds(uv * 8.0F, 8, 4);
        const float bent = noise.clouds(uv * 4.0F + 3.0F, 4, 3);
        const float vein = ramp(0.06F, 0, std::abs(noise.clouds(uv * 4.0F + 2.0F * bent, 4, 3)));
        const float pit = ramp(0.42F, 0.62F, noise.clouds(uv * 128.0F, 128, 2));
        Texel texel;
        texel.colour =
            glm::mix(glm::vec3(0.72F, 0.66F, 0.56F), glm::vec3(0.86F, 0.81F, 0.72F), 0.5F + cloud);
        texel.colour *= 1 - 0.07F * vein - 0.18F * pit;
        texel.height = 0.002F * cloud - 0.002F * pit;
        return texel;
    };
}

namespace {

// Lines and fields of the painted wall, by height in a bay of 3 m x 4.5 m.
glm::vec3 frescoColour(glm::vec2 metres) {
    const glm::vec3 red(0.47F, 0.17F, 0.12F), ochre(0.83F, 0.62F, 0.33F);
    const glm::vec3 cream(0.89F, 0.83F, 0.70F), dark(0.20F, 0.16F, 0.15F),
        green(0.25F, 0.36F, 0.30F);
    const float x = std::abs(metres.x - 1.5F), y = metres.y;
    const auto line = [](float distance, float halfWidth) {
        return ramp(halfWidth + 0.004F, halfWidth, std::abs(distance));
    };
    if (y < 0.98F) {
        const float frame = glm::max(std::abs(metres.x - 1.5F) - 1.1F, std::abs(y - 0.5F) - 0.3F);
        const glm::vec3 field = glm::mix(red, dark, 0.55F * ramp(0.002F, -0.004F, frame));
        return glm::mix(field, cream, 0.8F * line(frame - 0.05F, 0.006F));
    }
    if (y < 1.10F)
        return glm::mix(glm::mix(green, dark, line(y - 1.04F, 0.02F)), cream,
                        glm::max(line(y - 0.995F, 0.008F), line(y - 1.085F, 0.008F)));
    if (y > 3.05F) { // a frieze of lozenges below a plain cream wall
        const float lozenge =
            std::abs(glm::fract(metres.x / 0.25F) - 0.5F) * 0.25F + std::abs(y - 3.16F);
        const glm::vec3 frieze = glm::mix(red, ochre, ramp(0.075F, 0.068F, lozenge));
        return glm::mix(frieze, cream, ramp(3.262F, 3.268F, y) + line(y - 3.06F, 0.012F));
    }
    const float frame = glm::max(x - 1.22F, std::abs(y - 2.05F) - 0.83F);
    return glm::mix(glm::mix(ochre, red, ramp(-0.002F, 0.002F, frame)), cream,
                    line(frame + 0.05F, 0.007F));
}

} // namespace

Painter fresco() {
    return [noise = Noise("builtin/fresco")](glm::vec2 uv) {
        // v runs down from the wall's top.
        const glm::vec2 metres(3 * uv.x, 4.5F * (1 - uv.y));
        const float cloud = noise.clouds(uv * 4.0F, 4, 4);
        const float trowel = noise.clouds(uv * glm::vec2(32, 64), 32, 3);
        const float worn =
            ramp(0.10F, 0.30F, noise.clouds(uv * 8.0F + 5.0F, 8, 4) + 0.12F * trowel);
        const float damp = ramp(0.5F, 0, metres.y + 0.35F * cloud);
        glm::vec3 colour = frescoColour(metres);
        colour = glm::mix(colour, glm::vec3(0.84F, 0.77F, 0.66F), 0.30F * worn);
        colour *= 1 + 0.22F * cloud + 0.08F * trowel - 0.25F * damp;
        Texel texel;
        texel.colour = colour;
        texel.height = 0.004F * cloud + 0.002F * trowel - 0.0015F * worn;
        return texel;
    };
}

Painter plaster() {
    return [noise = Noise("builtin/plaster")](glm::vec2 uv) {
        const float cloud = noise.clouds(uv * 4.0F, 4, 4);
        const float trowel = noise.clouds(uv * glm::vec2(32, 64), 32, 3);
        const float stain = ramp(0.05F, 0.5F, noise.clouds(uv * 4.0F + 7.0F, 4, 4));
        Texel texel;
        texel.colour = glm::vec3(0.86F, 0.78F, 0.64F) * (1 + 0.14F * cloud + 0.06F * trowel);
        texel.colour *= 1.0F - glm::vec3(0.14F, 0.17F, 0.20F) * stain;
        texel.height = 0.004F * cloud + 0.0025F * trowel;
        return texel;
    };
}

Painter flagstones() {
    return [noise = Noise("builtin/flagstones")](glm::vec2 uv) {
        const glm::vec2 ragged(noise.value(uv * 64.0F, 64), noise.value(uv * 64.0F + 21.0F, 64));
        const glm::vec2 metres = 4.0F * glm::fract(uv + 0.001F * ragged);
        const Stone stone = stoneAt(metres, 4, {0.8F, 0.5F}, noise);
        const float cloud = noise.clouds(uv * 8.0F, 8, 4);
        const float grain = noise.clouds(uv * 256.0F, 256, 2);
        const float face = ramp(0.004F, 0.022F, stone.inside);
        const glm::vec3 warm =
            glm::mix(glm::vec3(0.62F, 0.56F, 0.48F), glm::vec3(0.76F, 0.71F, 0.62F), stone.tone);
        const glm::vec3 cool(0.60F, 0.58F, 0.53F);
        glm::vec3 colour = glm::mix(
            warm, cool, ramp(0.7F, 0.8F, noise.cell(static_cast<int>(stone.tone * 255), 5)));
        colour *= 1 + 0.28F * cloud + 0.10F * grain;
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.36F, 0.33F, 0.28F), colour, face);
        texel.height = 0.009F * face + 0.004F * cloud + 0.001F * grain +
                       0.010F * face * glm::dot(stone.slope, stone.local);
        texel.roughness = 0.9F - 0.35F * face * ramp(-0.2F, 0.4F, cloud);
        return texel;
    };
}

Painter marbleFloor() {
    return [noise = Noise("builtin/marble")](glm::vec2 uv) {
        const glm::vec2 tile = uv * 4.0F; // 0.75 m
        const glm::vec2 local = glm::abs(glm::fract(tile) - 0.5F);
        const float lozenge = local.x + local.y;
        const bool dark = lozenge < 0.46F;
        const bool stud = lozenge > 0.84F;
        const float joint =
            glm::min(glm::min(0.5F - glm::max(local.x, local.y), std::abs(lozenge - 0.46F)),
                     std::abs(lozenge - 0.84F)) *
            0.75F;
        const float bent = noise.clouds(uv * 8.0F + 2.0F, 8, 3);
        const float vein = ramp(0.10F, 0, std::abs(noise.clouds(uv * 8.0F + 0.8F * bent, 8, 4)));
        const float cloud = noise.clouds(uv * 16.0F, 16, 3);
        const glm::vec3 pale =
            glm::mix(glm::vec3(0.86F, 0.82F, 0.74F), glm::vec3(0.66F, 0.60F, 0.52F), 0.7F * vein);
        const glm::vec3 green =
            glm::mix(glm::vec3(0.20F, 0.27F, 0.24F), glm::vec3(0.47F, 0.53F, 0.47F), 0.35F * vein);
        const glm::vec3 red(0.48F, 0.25F, 0.19F);
        const float face = ramp(0.001F, 0.005F, joint);
        Texel texel;
        texel.colour = (stud   ? red
                        : dark ? green
                               : pale) *
                       (1 + 0.25F * cloud) * (0.55F + 0.45F * face);
        texel.height = 0.001F * face + 0.0006F * cloud;
        texel.roughness = glm::mix(0.9F, 0.32F + 0.3F * ramp(-0.1F, 0.4F, cloud), face);
        return texel;
    };
}

Painter timber() {
    return [noise = Noise("builtin/timber")](glm::vec2 uv) {
        const float plank = uv.y * 8; // 0.25 m
        const int name = static_cast<int>(plank);
        const float edge = 0.5F - std::abs(glm::fract(plank) - 0.5F);
        const glm::vec2 stretched(uv.x * 4, uv.y * 64);
        const float bend = noise.clouds(uv * glm::vec2(4, 8) + noise.cell(name, 3) * 50.0F, 4, 2);
        const float ring = noise.value(stretched + glm::vec2(0, 5 * bend), 64);
        const float fibre = noise.clouds(glm::vec2(uv.x * 16, uv.y * 256), 256, 2);
        const float face = ramp(0.01F, 0.05F, edge);
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.27F, 0.17F, 0.10F), glm::vec3(0.46F, 0.31F, 0.19F),
                                0.5F + 0.35F * ring + 0.4F * (noise.cell(name, 9) - 0.5F));
        texel.colour *= (1 + 0.2F * fibre) * (0.45F + 0.55F * face);
        texel.height = 0.006F * face + 0.0015F * ring + 0.001F * fibre;
        return texel;
    };
}

Painter cloth(glm::vec3 colour, glm::vec3 trim) {
    return [colour, trim, noise = Noise("builtin/cloth")](glm::vec2 uv) {
        // v runs from the rail to the hem; the figure is a net of lozenges with a star in each.
        const glm::vec2 tile = glm::abs(glm::fract(uv * glm::vec2(6, 12)) - 0.5F);
        const float net = ramp(0.05F, 0.03F, std::abs(tile.x + tile.y - 0.5F));
        const float star = ramp(
            0.17F, 0.15F, std::sqrt(tile.x) * std::sqrt(tile.y) * 2 + glm::length(tile) * 0.6F);
        const float figure = glm::max(net, star);
        const float hem = glm::max(ramp(0.018F, 0.014F, std::abs(uv.y - 0.955F)),
                                   ramp(0.006F, 0.004F, std::abs(uv.y - 0.915F)));
        const float thread =
            noise.value(uv * glm::vec2(256, 16), 256) + noise.value(uv * glm::vec2(16, 256), 256);
        const float fade = noise.clouds(uv * 4.0F, 4, 4);
        Texel texel;
        texel.colour = glm::mix(glm::mix(colour, trim, 0.28F * figure), trim, hem);
        texel.colour *= 1 + 0.07F * thread + 0.15F * fade;
        texel.height = 0.0006F * thread + 0.001F * hem + 0.0006F * figure;
        return texel;
    };
}

Painter glaze(glm::vec3 colour) {
    return [colour, noise = Noise("builtin/glaze")](glm::vec2 uv) {
        const float cloud = noise.clouds(uv * 4.0F, 4, 4);
        const float drip = ramp(-0.1F, 0.3F, noise.clouds(uv * glm::vec2(8, 2) + 4.0F, 8, 3));
        const float crackle = ramp(0.02F, 0, std::abs(noise.clouds(uv * 32.0F, 32, 2)));
        Texel texel;
        texel.colour = colour * (0.85F + 0.5F * cloud + 0.12F * drip) * (1 - 0.25F * crackle);
        texel.height = 0.0008F * cloud;
        texel.roughness = 0.28F + 0.15F * drip + 0.4F * crackle;
        return texel;
    };
}

Painter frond() {
    return [noise = Noise("builtin/frond")](glm::vec2 uv) {
        // Leaflets slant upwards from the rib, and shorten towards both ends.
        const float side = std::abs(2 * uv.x - 1), along = uv.y;
        const float row = along * 15 - 2.2F * side + (uv.x > 0.5F ? 0.5F : 0.0F);
        const float reach = 0.97F * ramp(0, 0.22F, along) * std::sqrt(ramp(1.02F, 0.45F, along));
        const float width = 0.42F * std::sqrt(glm::max(0.0F, 1 - side / glm::max(reach, 0.01F)));
        const float off = std::abs(glm::fract(row) - 0.5F);
        const bool rib = side < 0.05F * (1 - along);
        const float tone = noise.clouds(uv * 8.0F, 8, 4);
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.16F, 0.30F, 0.11F), glm::vec3(0.36F, 0.49F, 0.18F),
                                0.4F + tone + 0.5F * (0.5F - off));
        if (rib || off < 0.05F)
            texel.colour = glm::vec3(0.47F, 0.52F, 0.25F);
        texel.height = 0.004F * (0.5F - off);
        texel.alpha = rib || off < width ? 1 : 0;
        return texel;
    };
}

} // namespace obscura::builtin
