// Light on materials against closed forms and integrals.
#include "image/image.h"
#include "tests/folder.h"
#include "tests/renderer/frame/frame_fixture.h"

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr double pi = std::numbers::pi;

class LightOnMaterials : public GlTest {};

Material metalOf(glm::vec3 colour, float metallic, float roughness) {
    Material material;
    material.baseColour = glm::vec4(colour, 1);
    material.metallic = metallic;
    material.roughness = roughness;
    return material;
}

// A camera so far away that the square is seen under one angle.
Camera under(double cosine) {
    Camera camera;
    camera.position = {100 * std::sqrt(1 - cosine * cosine), 0, 100 * cosine};
    camera.fovDegrees = 1;
    camera.up = {0, 1, 0};
    return camera;
}

// Nothing is lost and nothing comes from nowhere, whatever the surface is made of: what the table
// of reflectance leaves out, the other parts make up.
TEST_F(LightOnMaterials, AWhiteSurfaceUnderAnEvenSkyIsAsBrightAsTheSky) {
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f})
            for (const double cosine : {1.0, 0.5, 0.15}) {
                const Drawn drawn = draw(square(metalOf({1, 1, 1}, metallic, roughness)),
                                         {under(cosine), evenSky(0.5), {}, 1, 8, 4});
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(drawn.ambient[drawn.middle()][c], 0.5, 1e-3)
                        << metallic << " " << roughness << " " << cosine;
            }
}

// GGX's reflectance for light from everywhere, one bounce, as scale and offset of the reflectance
// face-on: the product of distribution, masking and Fresnel term over the hemisphere of lights, by
// solid angle.
std::pair<double, double> reflectance(double roughness, double cosine) {
    const double a2 = std::pow(roughness, 4);
    const glm::dvec3 eye(std::sqrt(1 - cosine * cosine), 0, cosine);
    const auto smith = [&](double c) { return std::sqrt(1 + a2 * (1 / (c * c) - 1)); };
    double scale = 0, offset = 0;
    constexpr int steps = 600;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double up = (i + 0.5) / steps, turn = 2 * pi * (j + 0.5) / steps,
                         out = std::sqrt(1 - up * up);
            const glm::dvec3 light(out * std::cos(turn), out * std::sin(turn), up),
                half = glm::normalize(light + eye);
            const double spread = half.z * half.z * (a2 - 1) + 1,
                         distribution = a2 / (pi * spread * spread),
                         masking = 2 / (smith(up) + smith(cosine)),
                         fresnel = std::pow(1 - glm::dot(eye, half), 5),
                         share = distribution * masking / (4 * cosine) * 2 * pi / (steps * steps);
            scale += share * (1 - fresnel);
            offset += share * fresnel;
        }
    return {scale, offset};
}

// Black dielectrics and grey metals show the specular part alone.
TEST_F(LightOnMaterials, TheSpecularPartIsTheIntegral) {
    for (const double roughness : {0.3, 0.5, 0.9})
        for (const double cosine : {1.0, 0.6, 0.3})
            for (const bool metal : {false, true}) {
                const Drawn drawn =
                    draw(square(metalOf(glm::vec3(metal ? 0.5f : 0.0f), metal ? 1 : 0,
                                        static_cast<float>(roughness))),
                         {under(cosine), evenSky(1), {}, 1, 8, 4});
                const auto [scale, offset] = reflectance(roughness, cosine);
                const double faceOn = metal ? 0.5 : 0.04, lost = 1 - scale - offset,
                             once = faceOn * scale + offset, mean = faceOn + (1 - faceOn) / 21;
                EXPECT_NEAR(drawn.ambient[drawn.middle()].g,
                            once * (1 + lost * mean / (1 - lost * mean)), 0.01)
                    << roughness << " " << cosine << " " << metal;
            }
}

// A smooth metal shows what a panorama has in the mirrored direction, times its colour.
TEST_F(LightOnMaterials, AMirrorShowsThePanorama) {
    const test::Folder folder;
    const auto radiance = [](const glm::dvec3& d, int c) {
        return 0.5 + 0.4 * std::sin(2 * d[c] + c);
    };
    Image panorama{512, 256, 3, {}};
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 512; ++x)
            for (int c = 0; c < 3; ++c)
                panorama.pixels.push_back(static_cast<float>(
                    radiance(panoramaDirection((x + 0.5) / 512, (y + 0.5) / 256), c)));
    const std::string names[] = {"R", "G", "B"};
    writeExr(folder / "sky.exr", panorama, names);
    Level level;
    level.environment = "sky.exr";
    const glm::vec3 colour(1, 0.8f, 0.5f);
    for (const glm::dvec3 from : {glm::dvec3(0.6, 0, 0.8), glm::dvec3(-0.5, 0.4, 0.6),
                                  glm::dvec3(0, -0.3, 0.9), glm::dvec3(0.1, 0, 1)}) {
        Camera camera;
        const glm::dvec3 eye = 100.0 * glm::normalize(from);
        camera.position = {eye.x, eye.y, eye.z};
        camera.fovDegrees = 1;
        const Drawn drawn =
            draw(square(metalOf(colour, 1, 0)), {camera, level, folder / "sky.exr", 1, 8, 4});
        const glm::dvec3 mirrored = glm::normalize(glm::dvec3(-eye.x, -eye.y, eye.z));
        const glm::vec4 albedo = drawn.albedo[drawn.middle()]; // 8 bits of it
        for (int c = 0; c < 3; ++c) {
            const double expected = static_cast<double>(albedo[c]) * radiance(mirrored, c);
            EXPECT_NEAR(drawn.ambient[drawn.middle()][c], expected, 0.03) << c;
        }
    }
}

// Bare constant light has no direction: a metal sends its colour on, as a mirror would.
TEST_F(LightOnMaterials, ConstantLightTakesMetalsAndOthersAlike) {
    for (const float metallic : {0.0f, 1.0f}) {
        const Drawn drawn = draw(square(metalOf(glm::vec3(1), metallic, 0.5f)),
                                 {towardsSquare(), constantLight({0.7, 0.7, 0.7})});
        EXPECT_NEAR(drawn.ambient[drawn.middle()].r, 0.7f, 1e-3f);
    }
}

// Light and eye along the normal: diffuse 1 / pi, and the highlight's peak at roughness 1.
constexpr double faceOn = 1 / pi + 0.04 * 9 / (8 * pi);

double lit(const PointLight& light, bool shaded = true) {
    Scene scene = square();
    scene.lights.push_back(light);
    Level level = constantLight({0, 0, 0});
    level.sceneLights = shaded;
    Camera camera = under(1);
    const Drawn drawn = draw(scene, {camera, level, {}, 0, 9, 5}); // no pixel's edge in the middle
    return drawn.direct.empty() ? 0.0 : static_cast<double>(drawn.direct[drawn.middle()].g);
}

TEST_F(LightOnMaterials, ThoseOfTheFileShineAsTheExtensionSays) {
    using Kind = PointLight::Kind;
    PointLight light;
    light.intensity = {2, 2, 2};
    light.position = {0, 0, 1};
    EXPECT_NEAR(lit(light), 2 * faceOn, 0.003);
    EXPECT_EQ(lit(light, false), 0) << "the level does not ask for them";
    light.position.z = 2;
    EXPECT_NEAR(lit(light), 2 * faceOn / 4, 0.001);
    light.range = 4;
    EXPECT_NEAR(lit(light), 2 * faceOn / 4 * (1 - 1.0 / 16), 0.001);
    light.range = 1.9f;
    EXPECT_EQ(lit(light), 0);
    light.position.z = -1;
    EXPECT_EQ(lit(light), 0) << "from behind";

    PointLight sun;
    sun.kind = Kind::directional;
    sun.intensity = {0.5f, 0.5f, 0.5f};
    sun.position = {9, 9, 9}; // wherever it hangs
    EXPECT_NEAR(lit(sun), 0.5 * faceOn, 0.001);

    PointLight spot;
    spot.kind = Kind::spot;
    spot.position = {0, 0, 1};
    spot.innerCosine = 0.9f;
    spot.outerCosine = 0.5f;
    EXPECT_NEAR(lit(spot), faceOn, 0.002);
    spot.direction = {std::sqrt(1 - 0.49f), 0, -0.7f}; // half way from outer to inner
    EXPECT_NEAR(lit(spot), faceOn / 4, 0.002);
    spot.direction = {std::sqrt(1 - 0.16f), 0, -0.4f};
    EXPECT_EQ(lit(spot), 0);
}

} // namespace
} // namespace obscura
