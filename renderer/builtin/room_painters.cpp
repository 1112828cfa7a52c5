#include "renderer/builtin/noise.h"
#include "renderer/builtin/textures.h"

#include <cmath>

namespace obscura::builtin {

namespace {

// Wood at a place of one board: light and dark years bent round a knot here and there, and fibres.
struct Wood {
    float year, fibre; // about -1 ... 1
};
Wood woodAt(glm::vec2 uv, int board, const Noise& noise) {
    const float other = 40 * noise.cell(board, 3);
    const float bend = noise.clouds(uv * glm::vec2(2, 4) + other, 4, 3);
    const float year = noise.value(glm::vec2(uv.x * 2 + other, uv.y * 32 + 3.5F * bend), 32);
    const float fibre = noise.clouds(glm::vec2(uv.x * 8, uv.y * 256), 256, 2);
    return {year, fibre};
}

} // namespace

Painter grain(glm::vec3 dark, glm::vec3 light) {
    return [dark, light, noise = Noise("builtin/grain")](glm::vec2 uv) {
        const Wood wood = woodAt(uv, 0, noise);
        Texel texel;
        texel.colour = glm::mix(dark, light, 0.55F + 0.4F * wood.year) * (1 + 0.16F * wood.fibre);
        texel.height = 0.0002F * wood.year + 0.0003F * wood.fibre;
        texel.roughness = 0.55F - 0.1F * wood.year;
        return texel;
    };
}

Painter parquet() {
    return [noise = Noise("builtin/parquet")](glm::vec2 uv) {
        const int rows = 14; // boards of 0.14 m x 1 m
        const float across = uv.y * rows;
        const int row = static_cast<int>(across);
        const float shift = noise.cell(row, 11) * 2, along = std::fmod(uv.x * 2 + shift, 2.0F);
        const int name = 2 * row + static_cast<int>(along);
        const float edge = 0.143F * (0.5F - std::abs(glm::fract(across) - 0.5F));
        const float end = 0.5F - std::abs(glm::fract(along) - 0.5F);
        const float joint = ramp(0.0004F, 0.0022F, glm::min(edge, end));
        const Wood wood = woodAt(uv, name, noise);
        const float tone = noise.cell(name, 19) - 0.5F;
        Texel texel;
        texel.colour = glm::mix(glm::vec3(0.50F, 0.36F, 0.23F), glm::vec3(0.69F, 0.53F, 0.36F),
                                0.5F + 0.22F * wood.year + 0.5F * tone);
        texel.colour *= (1 + 0.12F * wood.fibre) * (0.42F + 0.58F * joint);
        texel.height = 0.0012F * joint + 0.0003F * wood.fibre;
        texel.roughness = 0.5F + 0.2F * noise.clouds(uv * 4.0F, 4, 3) + 0.3F * (1 - joint);
        return texel;
    };
}

Painter weave(float ribs) {
    return [ribs, noise = Noise("builtin/weave")](glm::vec2 uv) {
        const float across = glm::fract(uv.x * ribs), down = glm::fract(uv.y * ribs);
        const int i = static_cast<int>(uv.x * ribs), j = static_cast<int>(uv.y * ribs);
        // Over and under, as warp and weft take turns.
        const bool warp = (i + j) % 2 == 0;
        const float bulge = warp ? 4 * across * (1 - across) : 4 * down * (1 - down);
        const float thread = noise.cell(warp ? i : j, warp ? 3 : 80) - 0.5F;
        const float worn = noise.clouds(uv * 4.0F, 4, 4);
        Texel texel;
        texel.colour = glm::vec3(0.78F + 0.13F * bulge + 0.09F * thread + 0.10F * worn);
        texel.height = 0.0009F * bulge + 0.0004F * thread;
        return texel;
    };
}

Painter limewash(glm::vec3 colour) {
    return [colour, noise = Noise("builtin/limewash")](glm::vec2 uv) {
        const float brush = noise.clouds(uv * glm::vec2(16, 8) + 3.0F, 16, 4);
        const float roller = noise.clouds(uv * 128.0F, 128, 3);
        Texel texel;
        texel.colour = colour * (1 + 0.05F * brush + 0.02F * roller);
        texel.height = 0.0004F * roller + 0.0007F * brush;
        return texel;
    };
}

Painter rugPattern() {
    return [noise = Noise("builtin/rug")](glm::vec2 uv) {
        const glm::vec3 ground(0.52F, 0.17F, 0.14F), dark(0.14F, 0.17F, 0.25F),
            pale(0.82F, 0.73F, 0.57F), gold(0.70F, 0.50F, 0.24F);
        // Borders by the distance from the edge, in parts of the shorter side; the rug is 3 : 2.
        const glm::vec2 inside = 0.5F - glm::abs(uv - 0.5F);
        const float edge = glm::min(inside.x * 1.5F, inside.y);
        const auto band = [&](float from, float to) { return edge >= from && edge < to; };
        const glm::vec2 p = (uv - 0.5F) * glm::vec2(1.5F, 1);
        glm::vec3 colour = ground;
        const glm::vec2 tile = glm::abs(glm::fract(p * 9.0F) - 0.5F);
        if (std::abs(tile.x + tile.y - 0.5F) < 0.06F || tile.x + tile.y < 0.14F)
            colour = glm::mix(ground, pale, 0.75F);
        const float medal = std::abs(p.x) * 0.75F + std::abs(p.y);
        if (medal < 0.27F)
            colour = medal < 0.08F ? gold : (medal < 0.12F ? pale : (medal < 0.24F ? dark : pale));
        const float along = inside.x * 1.5F < inside.y ? p.y : p.x;
        if (band(0.015F, 0.13F)) {
            const float wave = std::abs(glm::fract(along * 12) - 0.5F) * 0.16F + 0.03F;
            colour = std::abs(edge - wave) < 0.009F ? gold : dark;
            const float stud =
                glm::length(glm::vec2((glm::fract(along * 12) - 0.5F) / 12, edge - 0.08F));
            if (stud < 0.016F)
                colour = pale;
        }
        if (band(0, 0.015F) || band(0.13F, 0.142F) || band(0.155F, 0.162F))
            colour = pale;
        const float knots = noise.value(uv * 256.0F, 256);
        const float worn = noise.clouds(uv * 4.0F, 4, 4);
        Texel texel;
        texel.colour = glm::mix(colour, pale, 0.12F + 0.14F * worn) * (1 + 0.14F * knots);
        texel.height = 0.0018F * knots;
        return texel;
    };
}

Painter painting() {
    return [noise = Noise("builtin/painting")](glm::vec2 uv) {
        // Hills in mist below an evening sky, each range nearer and darker.
        const float stroke = noise.clouds(uv * glm::vec2(32, 128), 128, 3);
        const float sky = 1 - uv.y;
        glm::vec3 colour = glm::mix(glm::vec3(0.90F, 0.72F, 0.52F), glm::vec3(0.45F, 0.55F, 0.63F),
                                    ramp(0.35F, 1.0F, sky + 0.1F * noise.clouds(uv * 4.0F, 4, 4)));
        const float sun = glm::length((uv - glm::vec2(0.66F, 0.42F)) * glm::vec2(1.3F, 1));
        colour = glm::mix(colour, glm::vec3(0.98F, 0.88F, 0.68F), ramp(0.075F, 0.065F, sun));
        for (int i = 0; i < 5; ++i) {
            const float line =
                0.46F + 0.11F * static_cast<float>(i) +
                0.12F * noise.clouds(glm::vec2(uv.x * 4, static_cast<float>(9 * i)), 4, 4);
            const glm::vec3 hill =
                glm::mix(glm::vec3(0.62F, 0.62F, 0.60F), glm::vec3(0.13F, 0.19F, 0.18F),
                         static_cast<float>(i) / 4);
            colour = glm::mix(colour, hill, ramp(line - 0.004F, line + 0.004F, uv.y));
        }
        Texel texel;
        texel.colour = colour * (1 + 0.10F * stroke);
        texel.height = 0.0006F * stroke;
        return texel;
    };
}

Painter speckle(glm::vec3 colour, float amount) {
    return [colour, amount, noise = Noise("builtin/speckle")](glm::vec2 uv) {
        const float cloud = noise.clouds(uv * 8.0F, 8, 4), fine = noise.value(uv * 128.0F, 128);
        Texel texel;
        texel.colour = colour * (1 + amount * (0.7F * cloud + 0.3F * fine));
        texel.height = 0.0004F * amount * (cloud + 0.5F * fine);
        return texel;
    };
}

} // namespace obscura::builtin
