// Techniques that trace the scene's own triangles, against closed forms (fact sheet, section A.1)
// and against the reference, whose rays are others.
#include "tests/renderer/techniques/limits_fixture.h"

#include <fmt/format.h>

namespace obscura {
namespace {

class RaysLimits : public Limits, public testing::WithParamInterface<std::string> {
  protected:
    static Settings few(int rays) {
        Settings settings = neutral(GetParam().c_str());
        settings.set("denoise", 0);
        settings.set("rays", rays);
        return settings;
    }
    static Settings within(double radius) {
        Settings settings = few(64);
        settings.set("radius", radius);
        return settings;
    }
    static double occlusion(const Scene& scene, const Settings& settings) {
        return centre(
            scene, settings, [](double v) { return 1 - v; }, 3);
    }
    // A floor, and an upright wall at x = `distance`.
    static Scene wall(float distance, float high) {
        Scene scene;
        addStrip(scene, -5, 0, 5, 0);
        addStrip(scene, distance, 0, distance, high);
        return scene;
    }
};

TEST_P(RaysLimits, BesideAWallThatIsHigherThanTheRadius) {
    const std::pair<float, double> cases[] = {
        {0.1f, 0.43644}, {0.25f, 0.34252}, {0.5f, 0.19550}, {0.75f, 0.07215}};
    for (const auto& [distance, expected] : cases)
        EXPECT_NEAR(occlusion(wall(distance, 5), few(64)), expected, 0.003) << distance;
}

// The wall is outside of the picture, which is 2.6 m wide.
TEST_P(RaysLimits, AWallThatNobodySees) {
    const std::pair<float, double> cases[] = {{1, 0.05279}, {2, 0.14645}, {4, 0.27639}};
    for (const auto& [high, expected] : cases)
        EXPECT_NEAR(occlusion(wall(2, high), within(1000)), expected, 0.004) << high;
}

TEST_P(RaysLimits, OnTheFloorOfAWell) {
    Scene scene;
    addStrip(scene, -5, 0, 5, 0);
    constexpr int sides = 256;
    for (int i = 0; i < sides; ++i) {
        const auto at = [&](int k, float y) {
            const double azimuth = 2 * M_PI * k / sides;
            return glm::vec3(std::cos(azimuth), y, std::sin(azimuth));
        };
        addQuad(scene, {at(i, 0), at(i + 1, 0), at(i + 1, 2), at(i, 2)});
    }
    // The picture's column is up to 0.04 m off the centre.
    EXPECT_NEAR(occlusion(scene, within(100)), 0.8, 0.006);
    EXPECT_NEAR(occlusion(scene, within(1.5)), 1 - 1 / 2.25, 0.006);
}

// What a normal that is tilted by an angle t sends below the face is blocked: (1 - cos t) / 2.
TEST_P(RaysLimits, ATiltedNormalOnAPlane) {
    for (const float degrees : {30.0f, 60.0f, 85.0f}) {
        const float angle = glm::radians(degrees);
        Scene scene;
        addStrip(scene, -5, 0, 5, 0);
        for (Vertex& vertex : scene.vertices)
            vertex.normal = {std::sin(angle), std::cos(angle), 0};
        EXPECT_NEAR(occlusion(scene, few(64)), (1 - std::cos(angle)) / 2, 0.003) << degrees;
    }
}

// A block on a floor under a plate with holes, and sky.
Scene maskedScene() {
    Scene scene;
    addQuad(scene,
            {glm::vec3(-2, 0, 2), glm::vec3(2, 0, 2), glm::vec3(2, 0, -2), glm::vec3(-2, 0, -2)});
    addQuad(scene, {glm::vec3(0, 0, 0), glm::vec3(0.7f, 0, 0.3f), glm::vec3(0.7f, 0.8f, 0.3f),
                    glm::vec3(0, 0.8f, 0)});
    const std::uint32_t opaque = static_cast<std::uint32_t>(scene.indices.size());
    addQuad(scene, {glm::vec3(-1, 0.4f, 1), glm::vec3(1, 0.4f, 1), glm::vec3(1, 0.4f, -1),
                    glm::vec3(-1, 0.4f, -1)});
    const glm::vec2 corners[] = {{-0.7f, -0.4f}, {2.3f, -0.4f}, {2.3f, 1.9f}, {-0.7f, 1.9f}};
    for (std::size_t i = 0; i < 4; ++i)
        scene.vertices[scene.vertices.size() - 4 + i].uv = corners[i];
    Texture texture{{5, 3, 4, {}}, false, Wrap::mirrored, Wrap::repeat, false, {}};
    for (int i = 0; i < 15; ++i)
        for (const int value : {200, 180, 160, i % 3 == 0 ? 0 : 80 + 12 * i})
            texture.image.pixels.push_back(static_cast<std::uint8_t>(value));
    scene.textures.push_back(std::move(texture));
    Material masked;
    masked.baseColourTexture.texture = 0;
    masked.alphaCutoff = 0.4f;
    masked.doubleSided = true;
    scene.materials.push_back(masked);
    scene.meshes.back().indexCount = opaque - scene.meshes.back().firstIndex;
    scene.meshes.push_back({opaque, static_cast<std::uint32_t>(scene.indices.size()) - opaque,
                            static_cast<int>(scene.materials.size()) - 1});
    return scene;
}

Camera maskedCamera() {
    Camera camera;
    camera.position = {1.2, 1.3, 2.6};
    camera.target = {0, 0.2, 0};
    return camera;
}

Settings truthOf(Settings like, int rays) {
    Settings settings(technique("ray_traced"));
    settings.set("radius", static_cast<double>(like["radius"]));
    settings.set("rays", rays);
    return settings;
}

// Error falls about as that of independent rays or faster, whose eightfold number makes it 2.8
// times less, and there is some: the reference's rays are others.
TEST_P(RaysLimits, TheErrorFallsAsRaysGrow) {
    const Scene scene = maskedScene();
    const auto picture = [&](const Settings& settings) {
        return visibilityOf(scene, maskedCamera(), settings, 96, 64, 3);
    };
    const Image truth = picture(truthOf(few(1), 4096));
    double before = 10;
    for (const int rays : {1, 8, 64}) {
        const double error = compare(picture(few(rays)), truth).rms;
        EXPECT_GT(error, 1e-3) << rays;
        EXPECT_LT(error, before / 2.4) << rays;
        before = error;
    }
    EXPECT_LT(before, 0.03);
}

TEST_P(RaysLimits, TheFilterHelps) {
    const Scene scene = maskedScene();
    const auto error = [&](double denoise) {
        Settings settings = few(4);
        settings.set("denoise", denoise);
        return compare(visibilityOf(scene, maskedCamera(), settings, 192, 128, 3),
                       visibilityOf(scene, maskedCamera(), truthOf(settings, 1024), 192, 128, 3))
            .rms;
    };
    EXPECT_LT(error(1), 0.4 * error(0));
}

// The same rays, so the same picture; rounding moves a few of them past an edge.
TEST_F(Limits, EmbreeAndTheShaderAgree) {
    for (const int rays : {1, 64}) {
        Image pictures[2];
        for (const int i : {0, 1}) {
            Settings settings = neutral(i == 0 ? "rtao" : "rtao_bvh");
            settings.set("denoise", 0);
            settings.set("rays", rays);
            pictures[i] = visibilityOf(maskedScene(), maskedCamera(), settings, 96, 64, 5);
        }
        const Difference difference = compare(pictures[0], pictures[1], 1e-3);
        EXPECT_LT(difference.rms, 0.004 * std::sqrt(64.0 / rays)) << rays;
        EXPECT_LT(difference.share, rays == 1 ? 0.002 : 0.06) << rays;
    }
}

INSTANTIATE_TEST_SUITE_P(Table, RaysLimits, testing::Values("rtao", "rtao_bvh"),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace obscura
