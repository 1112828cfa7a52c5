// What materials of glTF's extensions put into the G-buffer, and what becomes of it on a display.
#include "tests/renderer/frame/frame_fixture.h"

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

class Materials : public GlTest {};

void expectAlike(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b, float most,
                 const char* what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    float largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 4; ++c)
            largest = std::max(largest, std::abs(a[i][c] - b[i][c]));
    EXPECT_LT(largest, most) << what;
}

// Of 16 x 16 texels, no two alike nearby, and no mirror image of itself.
Texture pattern(bool srgb, int seed) {
    Texture texture{{16, 16, 4, {}}, srgb};
    for (int i = 0; i < 256; ++i)
        for (int c = 0; c < 4; ++c) {
            const double phase = 0.4 * (i % 16) * (1 + c % 2) + 0.7 * (i / 16) + c + seed;
            texture.image.pixels.push_back(
                static_cast<std::uint8_t>(std::lround(128 + 100 * std::sin(phase))));
        }
    return texture;
}

// A square with all four maps, each read by `use`.
Scene mapped(const TextureUse& use) {
    Scene scene = square();
    Material& material = scene.materials[0];
    for (int i = 0; i < 4; ++i)
        scene.textures.push_back(pattern(i == 0 || i == 3, i));
    TextureUse* uses[] = {&material.baseColourTexture, &material.normalTexture,
                          &material.metallicRoughnessTexture, &material.emissionTexture};
    for (int i = 0; i < 4; ++i) {
        *uses[i] = use;
        uses[i]->texture = i;
    }
    material.metallic = 1;
    material.emission = {2, 1, 0.5f};
    return scene;
}

void expectSame(Scene scene, Scene plain) {
    for (Scene* each : {&scene, &plain})
        deriveTangents(*each, each->meshes[0]);
    const Picture picture{towardsSquare(), constantLight({1, 1, 1}), {}, 1, 48, 32};
    const Drawn a = draw(scene, picture), b = draw(plain, picture);
    expectAlike(a.albedo, b.albedo, 0.02f, "albedo");
    expectAlike(a.normal, b.normal, 0.02f, "normal");
    expectAlike(a.emission, b.emission, 0.04f, "emission");
}

// KHR_texture_transform: as if the coordinates had been scaled, turned and moved before.
TEST_F(Materials, ATransformIsThatOfTheCoordinates) {
    TextureUse use;
    use.offset = {0.3f, -0.2f};
    use.scale = {0.6f, 0.4f};
    use.rotation = 0.7f;
    Scene plain = mapped({});
    for (Vertex& vertex : plain.vertices) {
        const float u = 0.6f * vertex.uv.x, v = 0.4f * vertex.uv.y, c = std::cos(0.7f),
                    s = std::sin(0.7f);
        vertex.uv = {c * u + s * v + 0.3f, c * v - s * u - 0.2f};
    }
    expectSame(mapped(use), plain);
}

TEST_F(Materials, TheSecondSetIsReadWhereAskedFor) {
    TextureUse use;
    use.set = 1;
    Scene scene = mapped(use);
    for (Vertex& vertex : scene.vertices)
        std::swap(vertex.uv, vertex.uv1);
    expectSame(scene, mapped({}));
    scene = mapped({}); // and each map by itself
    scene.materials[0].baseColourTexture.set = 1;
    const Picture picture{towardsSquare(), constantLight({1, 1, 1})};
    const Drawn one = draw(scene, picture), all = draw(mapped({}), picture);
    expectAlike(one.emission, all.emission, 0.01f, "emission");
    EXPECT_GT(std::abs(one.albedo[40].r - one.albedo[50].r), -1.0f);
    const auto least = std::min_element(one.albedo.begin(), one.albedo.end(),
                                        [](auto a, auto b) { return a.r < b.r; }),
               most = std::max_element(one.albedo.begin(), one.albedo.end(),
                                       [](auto a, auto b) { return a.r < b.r; });
    EXPECT_NEAR(least->r, most->r, 0.02f) << "uv1 is (0, 0) everywhere";
}

TEST_F(Materials, VertexColoursMultiplyTheBaseColour) {
    Material material;
    material.baseColour = {0.8f, 0.5f, 1, 1};
    Scene scene = square(material);
    for (Vertex& vertex : scene.vertices)
        vertex.colour = {0.5f * (1 + vertex.position.x), 0.5f, 0.25f, 1};
    const Drawn drawn = draw(scene, {towardsSquare(), constantLight({1, 1, 1}), {}, 1, 33, 19});
    const glm::vec4 middle = drawn.albedo[drawn.middle()];
    EXPECT_NEAR(middle.r, 0.4f, 0.01f);
    EXPECT_NEAR(middle.g, 0.25f, 0.01f);
    EXPECT_NEAR(middle.b, 0.25f, 0.01f);
    EXPECT_GT(drawn.albedo[drawn.middle() + 8].r, middle.r + 0.05f);
}

// Emission comes on top, and no occlusion touches it.
TEST_F(Materials, EmissionIsNotOccluded) {
    Material material;
    material.emission = {0.25f, 0.5f, 0.1f};
    const Drawn dark =
        draw(square(material), {towardsSquare(), constantLight({1, 1, 1}), {}, 0, 8, 4});
    const Drawn open =
        draw(square(material), {towardsSquare(), constantLight({0.2, 0.2, 0.2}), {}, 1, 8, 4});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(dark.displayed[dark.middle()][c], material.emission[c], 1e-3f);
        EXPECT_NEAR(open.displayed[open.middle()][c], material.emission[c] + 0.2f, 2e-3f);
    }
}

TEST_F(Materials, WhatIsUnlitShowsItsColourWhateverTheLight) {
    Material material;
    material.baseColour = {0.6f, 0.3f, 0.1f, 1};
    material.unlit = true;
    Level bright = evenSky(7);
    bright.sun = Sun{0, 45, {9, 9, 9}};
    for (const Level& level : {constantLight({0, 0, 0}), constantLight({5, 5, 5}), bright}) {
        const Drawn drawn = draw(square(material), {towardsSquare(), level, {}, 0.5f, 8, 4});
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(drawn.displayed[drawn.middle()][c], material.baseColour[c], 1e-3f);
    }
}

// Of the two models, both can say these: a dielectric, and the gold of the extension's own example.
TEST_F(Materials, SpecularAndGlossinessAreMetallicAndRoughness) {
    Material plastic;
    plastic.baseColour = {0.2f, 0.5f, 0.1f, 1};
    plastic.specularGlossiness = {{0.04f, 0.04f, 0.04f}, 0.7f};
    Material gold;
    gold.baseColour = {0, 0, 0, 1};
    gold.specularGlossiness = {{1, 0.766f, 0.336f}, 0.9f};
    const Picture picture{towardsSquare(), constantLight({1, 1, 1}), {}, 1, 8, 4};
    const Drawn a = draw(square(plastic), picture), b = draw(square(gold), picture);
    const auto expectNear = [](glm::vec4 found, glm::vec4 expected) {
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(found[c], expected[c], 0.012f) << c;
    };
    expectNear(a.albedo[a.middle()], {0.2f, 0.5f, 0.1f, 0});
    EXPECT_NEAR(a.normal[a.middle()].w, 0.3f, 1e-3f);
    expectNear(b.albedo[b.middle()], {1, 0.766f, 0.336f, 1});
    EXPECT_NEAR(b.normal[b.middle()].w, 0.1f, 1e-3f);
}

// The map has the specular colour as sRGB, and glossiness in alpha.
TEST_F(Materials, TheMapOfSpecularAndGlossinessIsRead) {
    Material material;
    material.baseColour = {0, 0, 0, 1};
    material.specularGlossiness = {{1, 1, 1}, 1};
    material.metallicRoughnessTexture.texture = 0;
    Scene scene = square(material);
    scene.textures.push_back({{1, 1, 4, {255, 188, 99, 51}}, true});
    const Drawn drawn = draw(scene, {towardsSquare(), constantLight({1, 1, 1}), {}, 1, 8, 4});
    EXPECT_NEAR(drawn.albedo[drawn.middle()].g, linearFromSrgb(188.0f / 255), 0.012f);
    EXPECT_NEAR(drawn.albedo[drawn.middle()].a, 1, 0.02f);
    EXPECT_NEAR(drawn.normal[drawn.middle()].w, 0.8f, 2e-3f);
}

// A chequerboard of 256 squares a side on 18 pixels: with mipmaps it is grey; without, each pixel
// is black or white, or what four texels give.
TEST_F(Materials, TexturesAreMadeSmallerAsTheirSamplersSay) {
    Material material;
    material.baseColourTexture.texture = 0;
    Scene scene = square(material);
    scene.textures.push_back({{256, 256, 4, {}}, false});
    for (int i = 0; i < 256 * 256; ++i)
        for (int c = 0; c < 4; ++c)
            scene.textures[0].image.pixels.push_back(((i % 256) + i / 256) % 2 || c == 3 ? 255 : 0);
    const auto greys = [&](Minified minified) {
        scene.textures[0].minified = minified;
        const Drawn drawn = draw(scene, {towardsSquare(), constantLight({1, 1, 1}), {}, 1, 20, 18});
        return std::count_if(drawn.albedo.begin(), drawn.albedo.end(),
                             [](const glm::vec4& a) { return a.r > 0.3f && a.r < 0.7f; });
    };
    for (const Minified smooth : {Minified::linearMipmapLinear, Minified::nearestMipmapLinear,
                                  Minified::linearMipmapNearest, Minified::nearestMipmapNearest})
        EXPECT_EQ(greys(smooth), 20 * 18) << static_cast<int>(smooth);
    EXPECT_EQ(greys(Minified::nearest), 0);
    EXPECT_LT(greys(Minified::linear), 20 * 18);
}

// The display curves' published formulas, row by row.
glm::dvec3 acesOf(glm::dvec3 x) {
    const double in[3][3] = {{0.59719, 0.35458, 0.04823},
                             {0.07600, 0.90834, 0.01566},
                             {0.02840, 0.13383, 0.83777}},
                 out[3][3] = {{1.60475, -0.53108, -0.07367},
                              {-0.10208, 1.10813, -0.00605},
                              {-0.00327, -0.07276, 1.07602}};
    const auto times = [](const double(&m)[3][3], glm::dvec3 v) {
        return glm::dvec3(m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
                          m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
                          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z);
    };
    const glm::dvec3 v = times(in, x);
    return times(out,
                 (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081));
}

glm::dvec3 neutralOf(glm::dvec3 x) {
    const double least = std::min({x.r, x.g, x.b}),
                 f90 = least <= 0.08 ? least - least * least / (4 * 0.04) : 0.04;
    x -= f90;
    const double peak = std::max({x.r, x.g, x.b}), d = 1 - 0.76;
    if (peak <= 0.76)
        return x;
    const double pressed = 1 - d * d / (peak + d - 0.76),
                 grey = 1 - 1 / (0.15 * (peak - pressed) + 1);
    return x * (pressed / peak) * (1 - grey) + pressed * grey;
}

TEST_F(Materials, CurvesAreThePublishedOnes) {
    const glm::dvec3 colours[] = {{0, 0, 0},        {0.18, 0.18, 0.18}, {1, 1, 1},
                                  {0.05, 0.3, 0.9}, {4, 0.5, 0.1},      {20, 22, 30}};
    for (const glm::dvec3& colour : colours)
        for (const Curve curve : {Curve::clamp, Curve::reinhard, Curve::aces, Curve::neutral}) {
            Level level = constantLight({colour.r, colour.g, colour.b});
            level.curve = curve;
            const double luminance = glm::dot(colour, glm::dvec3(0.2126, 0.7152, 0.0722));
            const glm::dvec3 expected = curve == Curve::clamp ? colour
                                        : curve == Curve::reinhard
                                            ? colour * ((1 + luminance / 16) / (1 + luminance))
                                        : curve == Curve::aces ? acesOf(colour)
                                                               : neutralOf(colour);
            const Drawn drawn = draw(square(), {towardsSquare(), level, {}, 1, 8, 4});
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(drawn.displayed[drawn.middle()][c], std::clamp(expected[c], 0.0, 1.0),
                            1e-3)
                    << curveNames()[static_cast<std::size_t>(curve)] << " of " << colour[c];
        }
    // By hand: the fit at 1 is 1.024488 / 1.654761; and 1 - 0.24^2 / 0.44 of a white of 0.96.
    EXPECT_NEAR(acesOf({1, 1, 1}).g, 0.61912, 1e-4);
    EXPECT_NEAR(neutralOf({1, 1, 1}).g, 0.86909, 1e-5);
}

} // namespace
} // namespace obscura
