// The compute blur against a plain evaluation of the weights it states: groups, what they share and
// the image's borders must not show.
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

// Boxes of several depths in front of a tilted wall, with sky beside them.
Scene boxes() {
    Scene scene;
    addQuad(scene, {glm::vec3(-3, -2, -1), glm::vec3(2, -2, 0), glm::vec3(2, 1.2f, -1),
                    glm::vec3(-3, 1.2f, -2)});
    for (int i = 0; i < 5; ++i) {
        const float x = 0.6f * static_cast<float>(i) - 1.5f, z = 0.2f * static_cast<float>(i);
        addQuad(scene, {glm::vec3(x, -1, z), glm::vec3(x + 0.5f, -1, z), glm::vec3(x + 0.5f, 1, z),
                        glm::vec3(x, 1, z)});
        addQuad(scene, {glm::vec3(x, 1, z), glm::vec3(x + 0.5f, 1, z),
                        glm::vec3(x + 0.5f, 1.3f, z - 0.8f), glm::vec3(x, 1.3f, z - 0.8f)});
    }
    return scene;
}

struct Surfaces {
    int width, height;
    float empty;
    std::vector<float> depth, normal; // the latter four per pixel
};

std::vector<float> blurred(const Surfaces& s, const std::vector<float>& values,
                           const Settings& settings, bool rows) {
    const int reach = static_cast<int>(settings["blurRadius"]);
    std::vector<float> result(values.size(), 1);
    for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < s.width; ++x) {
            const auto centre = static_cast<std::size_t>(y * s.width + x);
            double sum = 0, weights = 0;
            for (int i = -reach; i <= reach && s.depth[centre] < s.empty; ++i) {
                const int column = rows ? x + i : x, row = rows ? y : y + i;
                if (column < 0 || row < 0 || column >= s.width || row >= s.height)
                    continue;
                const auto other = static_cast<std::size_t>(row * s.width + column);
                if (s.depth[other] >= s.empty)
                    continue;
                double cosine = 0;
                for (std::size_t c = 0; c < 3; ++c)
                    cosine += static_cast<double>(s.normal[4 * centre + c]) *
                              static_cast<double>(s.normal[4 * other + c]);
                const double apart =
                    static_cast<double>(s.depth[other] - s.depth[centre]) / settings["radius"];
                const double deviation = reach / 2.0;
                const double weight = std::exp(-i * i / (2 * deviation * deviation)) *
                                      std::max(cosine, 0.0) *
                                      std::exp(-apart * apart / (2 * settings["depthVariance"]));
                sum += weight * static_cast<double>(values[other]);
                weights += weight;
            }
            if (weights > 0)
                result[centre] = static_cast<float>(sum / weights);
        }
    return result;
}

class ComputedBlur : public GlTest, public testing::WithParamInterface<std::array<int, 3>> {};

TEST_P(ComputedBlur, IsThePlainWeightedMean) {
    const auto [width, height, reach] = GetParam();
    const GpuScene scene(boxes());
    Camera camera;
    camera.position = {0.3, 0.4, 4};
    camera.fovDegrees = 60;
    const Frame frame = makeFrame(camera, width, height, scene.bounds(), 1);
    const gl::UniformBuffer block = frameBuffer(frame);
    bindFrame(block);
    GBufferContent content;
    content.occlusionNormal = Normals::smooth;
    const GBuffer gbuffer(width, height, content);
    GBufferPass().draw(scene, frame, gbuffer);

    Settings settings(technique("alchemy_cs562"));
    settings.set("radius", 1);
    settings.set("samples", 4);
    settings.set("intensity", 3);
    settings.set("blurRadius", reach);
    const OcclusionPasses passes(settings, width, height);
    passes.visibility({gbuffer, frame});
    const auto red = [&, width = width, height = height](const gl::Texture& texture) {
        return gl::readFloats(texture, width, height, gl::Format::r32f);
    };
    const auto resultOf = [&](const char* pass) { return red(passes.result(pass).texture()); };
    const Surfaces surfaces{
        width, height, frame.depth.y, red(gbuffer.depth()),
        gl::readFloats(*gbuffer.occlusionNormal(), width, height, gl::Format::rgba16f)};

    const std::vector<float> gathered = resultOf("gather"), columns = resultOf("blurColumns");
    std::vector<float> expected = blurred(surfaces, gathered, settings, false);
    const float rounding = 6e-4f; // half a step of a 16-bit float below 1, and of the sums
    for (std::size_t i = 0; i < columns.size(); ++i)
        ASSERT_NEAR(columns[i], expected[i], rounding) << "column pass, pixel " << i;

    // What the last pass's main does (technique.h).
    expected = blurred(surfaces, columns, settings, true);
    const std::vector<float> rows = resultOf("blurRows");
    for (std::size_t i = 0; i < rows.size(); ++i)
        ASSERT_NEAR(rows[i], std::max(1 - 3 * (1 - expected[i]), 0.0f), 3 * rounding)
            << "row pass, pixel " << i;
    const auto [least, most] = std::minmax_element(rows.begin(), rows.end());
    EXPECT_TRUE(rows.size() < 1000 || *most - *least > 0.1f); // there is something to blur
}

// Sizes about the group's 128, and kernels up to the largest.
INSTANTIATE_TEST_SUITE_P(Sizes, ComputedBlur,
                         testing::Values(std::array{300, 150, 6}, std::array{129, 128, 32},
                                         std::array{128, 257, 31}, std::array{127, 40, 1},
                                         std::array{40, 130, 17}, std::array{1, 1, 32}));

} // namespace
} // namespace obscura
