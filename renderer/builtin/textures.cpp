#include "renderer/builtin/textures.h"

#include "base/parallel.h"
#include "renderer/builtin/shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace obscura::builtin {

namespace {

std::uint8_t code(float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

void setTexel(Image8& image, std::size_t pixel, glm::vec4 values) {
    for (std::size_t channel = 0; channel < 4; ++channel)
        image.pixels[4 * pixel + channel] = code(values[static_cast<int>(channel)]);
}

Texture blank(int size, bool srgb) {
    const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    Texture texture;
    texture.image = {size, size, 4, std::vector<std::uint8_t>(4 * pixels)};
    texture.srgb = srgb;
    return texture;
}

// The slope of a height field that repeats, as glTF stores it: green points up in the image, that
// is, against v.
Texture normalsOf(const std::vector<float>& heights, const Canvas& canvas) {
    Texture texture = blank(canvas.size, false);
    const int mask = canvas.size - 1;
    const auto height = [&](int x, int y) {
        return heights[static_cast<std::size_t>((y & mask) * canvas.size + (x & mask))];
    };
    const float scale = part(canvas.size, 2) / canvas.metres;
    for (int y = 0; y < canvas.size; ++y)
        for (int x = 0; x < canvas.size; ++x) {
            const float du = (height(x + 1, y) - height(x - 1, y)) * scale;
            const float dv = (height(x, y + 1) - height(x, y - 1)) * scale;
            const glm::vec3 normal = glm::normalize(glm::vec3(-du, dv, 1));
            setTexel(texture.image, static_cast<std::size_t>(y * canvas.size + x),
                     glm::vec4(normal * 0.5F + 0.5F, 1));
        }
    return texture;
}

int keep(Scene& scene, Texture texture) {
    scene.textures.push_back(std::move(texture));
    return static_cast<int>(scene.textures.size()) - 1;
}

} // namespace

int addColourTexture(Scene& scene, Image8 image) {
    return keep(scene, {std::move(image), true, Wrap::clamp, Wrap::clamp});
}

int addMaterial(Scene& scene, Material material, const Canvas& canvas, const Painter& painter) {
    Texture colour = blank(canvas.size, true), gloss = blank(canvas.size, false);
    std::vector<float> heights(gloss.image.pixels.size() / 4);
    forEachInParallel(heights.size(), [&](std::size_t pixel) {
        const int index = static_cast<int>(pixel);
        const glm::vec2 place(index % canvas.size, index / canvas.size);
        const Texel texel = painter((place + 0.5F) / part(canvas.size, 1));
        setTexel(colour.image, pixel, {texel.colour, texel.alpha});
        setTexel(gloss.image, pixel, {1, texel.roughness, 0, 1});
        heights[pixel] = texel.height;
    });
    if (material.alphaCutoff > 0)
        colour.wrapU = colour.wrapV = Wrap::clamp;
    material.baseColourTexture.texture = keep(scene, std::move(colour));
    if (canvas.relief)
        material.normalTexture.texture = keep(scene, normalsOf(heights, canvas));
    if (canvas.gloss)
        material.metallicRoughnessTexture.texture = keep(scene, std::move(gloss));
    scene.materials.push_back(std::move(material));
    return static_cast<int>(scene.materials.size()) - 1;
}

int addCutOut(Scene& scene, const char* name, int size, const Painter& painter) {
    const Material leaf{.name = name, .alphaCutoff = 0.5F, .doubleSided = true};
    const int material = addMaterial(scene, leaf, {size, 1, false}, painter);
    const Material& added = scene.materials[static_cast<std::size_t>(material)];
    scene.textures[static_cast<std::size_t>(added.baseColourTexture.texture)].minified =
        Minified::linear;
    return material;
}

} // namespace obscura::builtin
