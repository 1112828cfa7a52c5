// Temporal accumulation where its outcome is known in closed form.
#include "renderer/techniques/accumulation.h"
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <cmath>
#include <functional>
#include <numeric>

namespace obscura {
namespace {

constexpr int width = 96, height = 64;
constexpr double focal = 80; // pixels: at distance d a metre is focal / d pixels wide

Camera cameraAt(double x, double z = 0) {
    Camera camera;
    camera.position = {x, 0, z};
    camera.target = {x, 0, z - 1};
    camera.fovDegrees = 2 * std::atan(height / 2 / focal) * 180 / M_PI;
    return camera;
}

void addWall(Scene& scene, float left, float right, float z) {
    addQuad(scene, {glm::vec3(left, -40, z), glm::vec3(right, -40, z), glm::vec3(right, 40, z),
                    glm::vec3(left, 40, z)});
}

// Visibility by pixel, x from the left and y from below.
using Picture = std::function<double(int x, int y)>;
Picture constant(double value) {
    return [=](int, int) { return value; };
}

// Frames of a scene whose visibility the test makes up.
class AccumulationTest : public GlTest {
  protected:
    void build(int frames) {
        gpuScene_.emplace(scene_);
        accumulation_.emplace(frames, 1, width, height);
    }
    // The mean after this frame, rows from below.
    std::vector<float> add(const Camera& camera, const Picture& visibility) {
        const Frame frame = makeFrame(camera, width, height, gpuScene_->bounds(), 1);
        const gl::UniformBuffer block = frameBuffer(frame);
        bindFrame(block);
        const GBuffer gbuffer(width, height, {});
        GBufferPass().draw(*gpuScene_, frame, gbuffer);
        std::vector<float> values;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                values.push_back(static_cast<float>(visibility(x, y)));
        const gl::Texture texture = gl::floatTexture(width, height, values);
        return gl::readFloats(accumulation_->add(texture, gbuffer, frame), width, height,
                              gl::Format::r32f);
    }

    Scene scene_;
    std::optional<GpuScene> gpuScene_;
    std::optional<Accumulation> accumulation_;
};

TEST_F(AccumulationTest, FramesWeighAlikeUpToTheirNumberAndFadeThen) {
    addWall(scene_, -40, 40, -4);
    build(3);
    const double given[] = {0.9, 0.3, 0.6, 0, 0, 1};
    const double expected[] = {0.9, 0.6, 0.6, 0.4, 0.8 / 3, 0.8 / 3 * 2 / 3 + 1.0 / 3};
    for (int i = 0; i < 6; ++i)
        for (const float value : add(cameraAt(0.37), constant(given[i])))
            ASSERT_NEAR(value, expected[i], 1e-6) << i;
    accumulation_->forget();
    EXPECT_EQ(accumulation_->frame(), 0);
    for (const float value : add(cameraAt(0.37), constant(0.25)))
        ASSERT_EQ(value, 0.25f);
}

TEST_F(AccumulationTest, AStillPictureIsNotBlurred) {
    addWall(scene_, -40, 40, -4);
    build(8);
    const Picture dots = [](int x, int y) { return (x + 3 * y) % 5 == 0 ? 0.25 : 0.75; };
    Camera camera = cameraAt(12.3, 1.7);
    camera.target = {11, 0.4, -4};
    for (int i = 0; i < 12; ++i) {
        const std::vector<float> mean = add(camera, dots);
        for (std::size_t p = 0; p < mean.size(); ++p)
            ASSERT_NEAR(mean[p], dots(static_cast<int>(p) % width, static_cast<int>(p) / width),
                        1e-5);
    }
}

// What is painted on the wall, linear across it so that bilinear fetches are exact; all that a
// frame shows the frame before showed too, for at the border fetches are not.
TEST_F(AccumulationTest, AMovingCameraLeavesNoGhostOnAWall) {
    addWall(scene_, -40, 40, -4);
    build(16);
    for (int i = 0; i < 20; ++i) {
        const double x = 0.02 * i, z = -0.05 * i, perPixel = (4 + z) / focal;
        const Picture painted = [&](int column, int row) {
            return 0.5 + 0.05 * (x + (column - (width - 1) / 2.0) * perPixel) +
                   0.08 * (row - (height - 1) / 2.0) * perPixel;
        };
        const std::vector<float> mean = add(cameraAt(x, z), painted);
        for (std::size_t p = 0; p < mean.size(); ++p)
            ASSERT_NEAR(mean[p], painted(static_cast<int>(p) % width, static_cast<int>(p) / width),
                        1e-4)
                << "frame " << i << ", pixel " << p % width << ", " << p / width;
    }
}

// A near wall at distance 2 hides the left of a far one at distance 4. From x = 0 the far wall
// shows right of x = 0, from x = 0.5 right of x = -0.5; its points move by 10 pixels, and the near
// wall's by 20.
TEST_F(AccumulationTest, WhatWasHiddenHasNoHistory) {
    addWall(scene_, -40, 0, -2);
    addWall(scene_, -40, 40, -4);
    build(8);
    add(cameraAt(0), constant(1));
    const std::vector<float> mean = add(cameraAt(0.5), constant(0));
    for (int x = 0; x < width; ++x) {
        const double right = (x - (width - 1) / 2.0) / focal, onNear = 0.5 + 2 * right,
                     onFar = 0.5 + 4 * right;
        const bool near = onNear < 0;
        const double before = x + (near ? 20 : 10); // the pixel that showed it, or would have
        if (std::abs(onNear) < 0.05 || std::abs(onFar) < 0.1 || std::abs(before - width) < 2)
            continue; // at an edge
        const bool known = before < width && (near || onFar > 0);
        for (int y = 0; y < height; ++y)
            ASSERT_NEAR(mean[static_cast<std::size_t>(y * width + x)], known ? 0.5 : 0, 1e-5)
                << x << ", " << y;
    }
}

TEST_F(AccumulationTest, ACutToAnotherPlaceForgetsAndOneToTheSameWallDoesNot) {
    addWall(scene_, -40, 40, -4);
    addWall(scene_, -40, 40, 4);
    build(8);
    add(cameraAt(0), constant(1));
    for (const float value : add(cameraAt(0, -2), constant(0))) // half-way to the wall
        ASSERT_NEAR(value, 0.5, 1e-6);
    Camera behind = cameraAt(0);
    behind.target = {0, 0, 1};
    for (const float value : add(behind, constant(0.25)))
        ASSERT_EQ(value, 0.25f);
}

// Other facets of a shape lie near the same place and face elsewhere.
TEST_F(AccumulationTest, AnotherSurfaceAtTheSamePlaceIsNoHistory) {
    addWall(scene_, -40, 40, -4);
    build(8);
    add(cameraAt(0), constant(1));
    scene_ = Scene();
    addWall(scene_, -40, 40, -4.2f); // 5 % further, four pixels' widths
    gpuScene_.emplace(scene_);
    for (const float value : add(cameraAt(0), constant(0)))
        ASSERT_EQ(value, 0);
}

TEST_F(AccumulationTest, EmptyPixelsStayOpen) {
    addWall(scene_, -40, 0, -4);
    build(8);
    const Picture half = [](int x, int) { return x < width / 2 ? 0.5 : 1; };
    add(cameraAt(0), half);
    const std::vector<float> mean = add(cameraAt(0), half);
    for (int x = 0; x < width; ++x)
        EXPECT_EQ(mean[static_cast<std::size_t>(x)], x < width / 2 ? 0.5f : 1.0f) << x;
}

// A floor and a wall behind it: along the crease nothing changes but noise.
Scene creaseScene() {
    Scene scene;
    addQuad(scene, {glm::vec3(-20, 0, 20), glm::vec3(20, 0, 20), glm::vec3(20, 0, -1),
                    glm::vec3(-20, 0, -1)});
    addQuad(scene, {glm::vec3(-20, 0, -1), glm::vec3(20, 0, -1), glm::vec3(20, 20, -1),
                    glm::vec3(-20, 20, -1)});
    return scene;
}

Camera creaseCamera() {
    Camera camera;
    camera.position = {0, 2, 3};
    camera.target = {0, 0, -1};
    camera.fovDegrees = 20;
    return camera;
}

// The unfiltered estimate.
Settings unfiltered(const Technique& technique, int frames) {
    Settings settings(technique);
    for (const char* name : {"blur", "denoise", "filterPasses"})
        if (settings.has(name))
            settings.set(name, 0);
    settings.set("accumulate", frames);
    return settings;
}

// The root of the variance along rows.
double unevenness(const Image& image) {
    double squares = 0;
    for (int y = 0; y < image.height; ++y) {
        const auto row = image.pixels.begin() + y * image.width;
        const double mean = std::accumulate(row, row + image.width, 0.0) / image.width;
        for (int x = 0; x < image.width; ++x)
            squares += std::pow(static_cast<double>(row[x]) - mean, 2);
    }
    return std::sqrt(squares / static_cast<double>(image.pixels.size()));
}

class EveryNoise : public GlTest, public testing::WithParamInterface<std::string> {};

Image creaseOf(const Settings& settings, std::uint64_t seed = 1) {
    return visibilityOf(creaseScene(), creaseCamera(), settings, 32, 32, seed);
}

TEST_P(EveryNoise, IsAccumulatedWhereThereIsAny) {
    const Technique& row = technique(GetParam());
    Settings settings(row);
    if (settings.has("accumulate"))
        settings = unfiltered(row, 1);
    const double change = compare(creaseOf(settings, 1), creaseOf(settings, 2)).largest;
    EXPECT_EQ(settings.has("accumulate"), change > 0 && !(row.reads & rays)) << change;
}

// Each pixel gets what any other gets in the course of the frames: all of the tile, or most of what
// differs between pixels; what is left of that is where taps fall in pixels.
TEST_P(EveryNoise, AveragesOutOverTheFrames) {
    const Technique& row = technique(GetParam());
    if (!Settings(row).has("accumulate"))
        return; // no noise
    const double one = unevenness(creaseOf(unfiltered(row, 1))),
                 many = unevenness(creaseOf(unfiltered(row, 16)));
    EXPECT_GT(one, 1e-3);
    EXPECT_LT(many, 0.6 * one);
}

TEST_P(EveryNoise, AStillPictureIsTheMeanOfItsFrames) {
    const Technique& row = technique(GetParam());
    if (!Settings(row).has("accumulate"))
        return; // no noise
    constexpr int frames = 5;
    const Image accumulated = creaseOf(unfiltered(row, frames));
    Image mean = accumulated;
    std::fill(mean.pixels.begin(), mean.pixels.end(), 0.0f);
    std::vector<Image> single;
    for (int i = 0; i < frames; ++i) {
        single.push_back(
            visibilityOf(creaseScene(), creaseCamera(), unfiltered(row, 1), 32, 32, 1, i));
        for (std::size_t p = 0; p < mean.pixels.size(); ++p)
            mean.pixels[p] += single.back().pixels[p] / frames;
    }
    EXPECT_LT(compare(accumulated, mean).largest, 1e-5);
    EXPECT_GT(compare(single[0], single[1]).largest, 1e-3);
}

std::vector<std::string> allTechniques() {
    std::vector<std::string> result;
    for (const Technique& row : techniques())
        result.emplace_back(row.id);
    return result;
}

INSTANTIATE_TEST_SUITE_P(Table, EveryNoise, testing::ValuesIn(allTechniques()),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace obscura
