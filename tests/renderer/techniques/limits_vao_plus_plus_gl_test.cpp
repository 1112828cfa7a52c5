// VAO++ against its limits of infinitely many samples, and each of its switches.
#include "renderer/frame/light.h"
#include "tests/renderer/techniques/limits_fixture.h"

#include <cstdlib>
#include <filesystem>
#include <numeric>

namespace obscura {
namespace {

namespace fs = std::filesystem;

constexpr const char* extensions[] = {"adaptive", "culling", "rangeCheck", "luminanceSensitivity",
                                      "colourBleeding"};

Settings plain(Settings settings, int samples) {
    for (const char* name : extensions)
        settings.set(name, 0);
    settings.set("samples", samples);
    return settings;
}

double meanOf(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double meanDifference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        sum += std::abs(static_cast<double>(a.pixels[i] - b.pixels[i]));
    return sum / static_cast<double>(a.pixels.size());
}

class VaoPlusPlusLimits : public Limits {
  protected:
    static Settings unfilteredPlain(int samples) {
        return plain(unfiltered("vao_plus_plus", samples), samples);
    }
    // As Limits::centre, but in an image that shows all of the ball's disc: lines that would leave
    // it are measured at its border, and 16 rows would measure those of the middle only.
    static double centre(const Scene& scene, const Settings& settings, int seeds = 1) {
        constexpr int across = 257, down = 121, rows = 9; // multiples of the noise tile's 3
        Camera camera;
        camera.position = {0, 200, 0};
        camera.up = {0, 0, -1};
        camera.fovDegrees = 2 * std::atan(field / 2 * down / across / 200) * 180 / M_PI;
        double sum = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            const Image image = visibilityOf(scene, camera, settings, across, down,
                                             static_cast<std::uint64_t>(seed));
            for (int y = (down - rows) / 2; y < (down + rows) / 2; ++y)
                for (int x = across / 2 - 1; x <= across / 2 + 1; ++x)
                    sum += static_cast<double>(image.at(x, y, 0));
        }
        return sum / (3 * rows * seeds);
    }
    // The shader's limit of occlusion for a curb, by the midpoint rule over the disc; R = 1.
    // `thickness` is the range check's, infinite for none.
    static double limit(double distance, double step, double thickness) {
        constexpr int steps = 1000;
        constexpr double r = 0.5;
        double blocked = 0, total = 0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const double x = (2 * (i + 0.5) / steps - 1) * r;
                const double y = (2 * (j + 0.5) / steps - 1) * r;
                const double square = r * r - x * x - y * y;
                if (square <= 0)
                    continue;
                const double extent = std::sqrt(square), top = r + extent;
                const double height = x > distance ? step : 0;
                const double share = thickness / std::max(thickness, height - top);
                blocked += share * std::clamp(height - r + extent, 0.0, 2 * extent);
                total += 2 * extent;
            }
        return blocked / total;
    }
};

struct Curb {
    float distance, step;
    double occlusion; // sheet A.3, row "VAO"
};
constexpr Curb curbs[] = {
    {0.25f, 0.5f, 0.0782}, {0.5f, 0.5f, 0}, {0.1f, 0.2f, 0.0310}, {0.25f, 2, 0.1564}};

TEST_F(VaoPlusPlusLimits, TheOpenBallOnPlanesAndConvexEdges) {
    for (const float slope : {0.0f, -1.0f})
        for (const int samples : {2, 32, 100})
            EXPECT_NEAR(centre(wedge(slope), unfilteredPlain(samples)), 1, 2e-3) << samples;
}

// With the spiral of 256 lines in place of a set.
TEST_F(VaoPlusPlusLimits, TheTangentBallBesideACurb) {
    for (const Curb& c : curbs) {
        EXPECT_NEAR(limit(c.distance, c.step, 1e9), c.occlusion, 1e-3);
        const double found = 1 - centre(curb(c.distance, c.step), unfilteredPlain(256));
        EXPECT_NEAR(found, c.occlusion, 0.01) << c.distance << " " << c.step;
        RecordProperty(std::to_string(c.distance) + "/" + std::to_string(c.step),
                       std::to_string(found));
    }
}

// The sets themselves: nine rotations of the largest, turned by 8 seeds.
TEST_F(VaoPlusPlusLimits, TheLargestSetHasTheSameMean) {
    for (const Curb& c : curbs) {
        const double found = 1 - centre(curb(c.distance, c.step), unfilteredPlain(32), 8);
        EXPECT_NEAR(found, c.occlusion, 0.01) << c.distance << " " << c.step;
    }
}

TEST_F(VaoPlusPlusLimits, TheRangeCheckLightensTheFootOfAHighStepOnly) {
    Settings settings = unfilteredPlain(256);
    settings.set("rangeCheck", 1);
    for (const Curb& c : curbs) {
        const double expected =
            limit(c.distance, c.step, static_cast<double>(settings["thickness"]));
        const double found = 1 - centre(curb(c.distance, c.step), settings);
        EXPECT_NEAR(found, expected, 0.01) << c.distance << " " << c.step;
        if (c.step > 1) {
            EXPECT_LT(found, 0.02);
        }
        RecordProperty(std::to_string(c.distance) + "/" + std::to_string(c.step),
                       std::to_string(found) + " of " + std::to_string(expected));
    }
}

// Equation 4 itself: where the step hides every line, what is left of occlusion is the mean of the
// lines' shares, so a wrong slope shows in full.
TEST_F(VaoPlusPlusLimits, HiddenLinesFadeByEquation4) {
    constexpr float distance = 0.1f;
    for (const float step : {1.3f, 2.0f, 4.0f}) {
        const double all = 1 - centre(curb(distance, step), unfilteredPlain(256));
        ASSERT_GT(all, 0.2);
        for (const double thickness : {0.2, 0.6}) {
            Settings settings = unfilteredPlain(256);
            settings.set("rangeCheck", 1);
            settings.set("thickness", thickness);
            const double expected = limit(distance, step, thickness) / limit(distance, step, 1e9);
            const double found = (1 - centre(curb(distance, step), settings)) / all;
            EXPECT_NEAR(found, expected, 0.02 * expected) << step << " " << thickness;
            RecordProperty(std::to_string(step) + "/" + std::to_string(thickness),
                           std::to_string(found) + " of " + std::to_string(expected));
        }
    }
}

// A room's corner with a red wall, small and far in part: something for every switch to do.
class VaoPlusPlusSwitches : public GlTest {
  protected:
    static Scene room() {
        Scene scene;
        addQuad(scene, {glm::vec3(-4, 0, 9), glm::vec3(4, 0, 9), glm::vec3(4, 0, -4),
                        glm::vec3(-4, 0, -4)});
        addQuad(scene, {glm::vec3(-4, 0, -4), glm::vec3(4, 0, -4), glm::vec3(4, 6, -4),
                        glm::vec3(-4, 6, -4)});
        addQuad(scene, {glm::vec3(-0.3f, 0, 1), glm::vec3(0.3f, 0, 1), glm::vec3(0.3f, 2, 1),
                        glm::vec3(-0.3f, 2, 1)});
        scene.materials.push_back({});
        scene.materials[1].baseColour = {0.9f, 0.05f, 0.05f, 1};
        scene.meshes.push_back({static_cast<std::uint32_t>(scene.indices.size()), 6, 1});
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (const glm::vec3& corner :
             {glm::vec3(-4, 0, 9), glm::vec3(-4, 0, -4), glm::vec3(-4, 6, -4), glm::vec3(-4, 6, 9)})
            scene.vertices.push_back({corner, {1, 0, 0}, {}, {}});
        for (const std::uint32_t i : {0, 1, 2, 0, 2, 3})
            scene.indices.push_back(first + i);
        return scene;
    }
    static Camera camera() {
        Camera camera;
        camera.position = {2, 2.5, 8};
        camera.target = {-1.5, 0.8, -2};
        return camera;
    }
    static constexpr int width = 160, height = 90;

    static Settings start() { // all off but the filter
        Settings settings = plain(Settings(technique("vao_plus_plus")), 16);
        settings.set("radius", 1);
        return settings;
    }
    static Settings with(const char* name, double value) {
        Settings settings = start();
        settings.set(name, value);
        return settings;
    }
    static Image picture(const Settings& settings) {
        return visibilityOf(room(), camera(), settings, width, height);
    }

    // All four channels of the last pass, rows from the bottom, and what ambient light there is.
    struct Sent {
        std::vector<float> values, ambient;
    };
    static Sent sent(const Settings& settings) {
        const GpuScene gpu(room());
        const Frame frame = makeFrame(camera(), width, height, gpu.bounds(), 1);
        const gl::UniformBuffer block = frameBuffer(frame);
        bindFrame(block);
        GBufferContent content;
        content.occlusionNormal = Normals::smooth;
        const GBuffer gbuffer(width, height, content);
        GBufferPass().draw(gpu, frame, gbuffer);
        const Lighting lighting(whiteLight(), gpu, fs::path());
        const LightBuffers light(width, height, false);
        lighting.draw(gbuffer, light);
        const OcclusionPasses passes(settings, width, height);
        const gl::Texture& last =
            passes.visibility({gbuffer, frame, [&] {
                                   return OcclusionInputs::Light{light, lighting};
                               }});
        return {gl::readFloats(last, width, height,
                               passes.sendsLight() ? gl::Format::rgba32f : gl::Format::r32f),
                gl::readFloats(light.ambient(), width, height, gl::Format::rgba32f)};
    }
};

TEST_F(VaoPlusPlusSwitches, AdaptiveWithATinyDiameterIsTheFullSet) {
    Settings settings = with("adaptive", 1);
    settings.set("adaptiveDiameter", 1e-5);
    EXPECT_EQ(picture(settings).pixels, picture(start()).pixels);
}

TEST_F(VaoPlusPlusSwitches, AdaptiveWithAHugeDiameterIsTheSmallestSet) {
    Settings settings = with("adaptive", 1);
    settings.set("adaptiveDiameter", 16);
    Settings two = start();
    two.set("samples", 2);
    EXPECT_EQ(picture(settings).pixels, picture(two).pixels);
}

// A wall face-on shows a disc of one size: each level is one of the sets, twice the lines for twice
// the area.
TEST_F(VaoPlusPlusSwitches, AdaptiveDoublesLinesWithTheDiscsArea) {
    const double diameter = 1 / (2 * std::tan(25 * M_PI / 180)) / 5; // image heights, at 5 m
    Scene scene;
    addQuad(scene, {glm::vec3(-50, -50, 0), glm::vec3(50, -50, 0), glm::vec3(50, 50, 0),
                    glm::vec3(-50, 50, 0)});
    addQuad(scene, {glm::vec3(0.2f, -50, 0.3f), glm::vec3(50, -50, 0.3f), glm::vec3(50, 50, 0.3f),
                    glm::vec3(0.2f, 50, 0.3f)});
    Camera camera;
    camera.position = {0, 0, 5.5};                    // the ball's centre is half the radius nearer
    const auto left = [&](const Settings& settings) { // of the edge, on the wall behind
        const Image image = visibilityOf(scene, camera, settings, width, height);
        std::vector<float> values;
        for (int y = 10; y < height - 10; ++y)
            for (int x = 40; x < width / 2; ++x)
                values.push_back(image.at(x, y, 0));
        return values;
    };
    for (const int lines : {2, 4, 8, 16, 32}) {
        Settings fixed = start(), adaptive = with("adaptive", 1);
        fixed.set("samples", lines);
        adaptive.set("samples", 32);
        adaptive.set("adaptiveDiameter", diameter / std::sqrt(lines / 2.0) * 0.99);
        EXPECT_EQ(left(adaptive), left(fixed)) << lines;
        EXPECT_LT(meanOf(left(fixed)), 0.999);
    }
}

TEST_F(VaoPlusPlusSwitches, CullingKeepsOcclusionAndSkipsOpenPlaces) {
    const Image full = picture(start()), greedy = picture(with("culling", 1)),
                careful = picture(with("culling", 2));
    EXPECT_LT(meanDifference(full, careful), 0.002);
    EXPECT_LE(meanDifference(full, careful), meanDifference(full, greedy));
    for (std::size_t i = 0; i < full.pixels.size(); ++i)
        EXPECT_GE(greedy.pixels[i], full.pixels[i] - 1e-3f); // it can only brighten
}

// Specks above a wall, too small for one pixel in 8 x 8 to see them all, are what greedy culling
// loses. The careful variant spends four lines there, here as many as everywhere.
TEST_F(VaoPlusPlusSwitches, CarefulCullingKeepsWhatGreedyLoses) {
    Scene scene;
    addQuad(scene, {glm::vec3(-50, -50, 0), glm::vec3(50, -50, 0), glm::vec3(50, 50, 0),
                    glm::vec3(-50, 50, 0)});
    for (int i = -6; i <= 6; ++i) // stepping through the cells' phases
        for (int j = -4; j <= 4; ++j) {
            const float x = 0.61f * static_cast<float>(i), y = 0.55f * static_cast<float>(j);
            addQuad(scene, {glm::vec3(x, y, 0.1f), glm::vec3(x + 0.08f, y, 0.1f),
                            glm::vec3(x + 0.08f, y + 0.08f, 0.1f), glm::vec3(x, y + 0.08f, 0.1f)});
        }
    Camera camera;
    camera.position = {0, 0, 5};
    const auto look = [&](int culling) {
        Settings settings = with("culling", culling);
        settings.set("radius", 0.2);
        settings.set("samples", 4);
        return visibilityOf(scene, camera, settings, width, height);
    };
    const Image full = look(0), greedy = look(1);
    EXPECT_EQ(look(2).pixels, full.pixels);
    EXPECT_GT(meanDifference(full, greedy), 1e-3);
}

// The post in front of the room's far wall.
TEST_F(VaoPlusPlusSwitches, TheRangeCheckTakesTheHaloFromBehindAPost) {
    const auto occlusion = [](const Image& image) { return 1 - meanOf(image.pixels); };
    Scene scene;
    addQuad(scene, {glm::vec3(-50, -50, 0), glm::vec3(50, -50, 0), glm::vec3(50, 50, 0),
                    glm::vec3(-50, 50, 0)});
    addQuad(scene, {glm::vec3(-0.1f, -50, 5), glm::vec3(0.1f, -50, 5), glm::vec3(0.1f, 50, 5),
                    glm::vec3(-0.1f, 50, 5)});
    Camera camera;
    camera.position = {0, 0, 12};
    const auto look = [&](double on) {
        return occlusion(visibilityOf(scene, camera, with("rangeCheck", on), width, height));
    };
    EXPECT_GT(look(0), 0.002);
    EXPECT_LT(look(1), 0.1 * look(0));
}

// The red wall's luminance is 0.24, its HSV value 0.9; white surfaces have 1.
TEST_F(VaoPlusPlusSwitches, SensitivitySparesBrightSurfaces) {
    const Image full = picture(start());
    const auto red = [](int x) { return x < width / 4; }; // left, the wall alone
    const auto occlusionOf = [&](const Image& image, bool ofRed) {
        double sum = 0;
        for (int y = 0; y < height / 2; ++y)
            for (int x = 0; x < width; ++x)
                sum += ofRed == red(x) ? 1 - static_cast<double>(image.at(x, y, 0)) : 0;
        return sum;
    };
    ASSERT_GT(occlusionOf(full, true), 0.5);
    ASSERT_GT(occlusionOf(full, false), 0.5);
    Settings byLuminance = with("luminanceSensitivity", 1);
    byLuminance.set("luminanceWidth", 0.2);
    const Image luminance = picture(byLuminance);
    EXPECT_EQ(
        *std::min_element(luminance.pixels.begin() + width - 1, luminance.pixels.begin() + width),
        1.0f);
    EXPECT_NEAR(occlusionOf(luminance, true), occlusionOf(full, true), 1e-3);
    EXPECT_LT(occlusionOf(luminance, false), 0.3 * occlusionOf(full, false));
    Settings byValue = with("luminanceSensitivity", 2);
    byValue.set("luminanceWidth", 0.2);
    EXPECT_LT(occlusionOf(picture(byValue), true), 1e-3);
    // Far above the threshold, where the base of equation 3 as printed would be negative.
    byValue.set("luminanceThreshold", 0);
    byValue.set("luminanceWidth", 0.01);
    byValue.set("luminancePower", 0.5);
    for (const float value : picture(byValue).pixels)
        EXPECT_EQ(value, 1.0f);
}

TEST_F(VaoPlusPlusSwitches, TheFilterSmoothsTheNoiseTile) {
    const auto roughness = [](const Image& image) {
        double sum = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 1; x < width; ++x)
                sum += std::abs(static_cast<double>(image.at(x, y, 0) - image.at(x - 1, y, 0)));
        return sum / (width * height);
    };
    Settings gaussian = with("blur", 2);
    gaussian.set("blurSize", 9);
    gaussian.set("blurDeviation", 3);
    const double none = roughness(picture(with("blur", 0))), mean = roughness(picture(start()));
    EXPECT_LT(mean, 0.7 * none);
    EXPECT_LT(roughness(picture(gaussian)), 0.9 * mean);
    gaussian.set("blurSize", 1);                                                   // no neighbours
    EXPECT_LT(compare(picture(gaussian), picture(with("blur", 0))).largest, 1e-3); // rounding
}

// Colour bleeding leaves visibility as it is; beside the red wall, red is what white surfaces keep.
TEST_F(VaoPlusPlusSwitches, ColourBleedingTintsBesideTheRedWall) {
    const Sent off = sent(start());
    EXPECT_EQ(off.values.size(), static_cast<std::size_t>(width * height));
    for (const int every : {1, 2, 4}) {
        const Sent on = sent(with("colourBleeding", every));
        ASSERT_EQ(on.values.size(), 4 * off.values.size());
        double red = 0, green = 0, blue = 0;
        for (std::size_t i = 0; i < off.values.size(); ++i) {
            ASSERT_NEAR(on.values[4 * i], off.values[i], 1e-3f); // rounded once more
            ASSERT_LE(on.values[4 * i + 1], 0);
            // It takes away no more than there is.
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_GE(on.values[4 * i + 1 + c], -on.ambient[4 * i + c]);
            red += static_cast<double>(on.values[4 * i + 1]);
            green += static_cast<double>(on.values[4 * i + 2]);
            blue += static_cast<double>(on.values[4 * i + 3]);
        }
        EXPECT_LT(green, -5) << every;
        EXPECT_NEAR(green, blue, 1e-3 * std::abs(green)) << every;
        EXPECT_GT(red, 0.2 * green) << every;
    }
}

// A scene that nobody here modelled. Skipped, loudly, where the shared folder is absent.
class VaoPlusPlusOnSponza : public GlTest {
  protected:
    static constexpr int width = 640, height = 360;
};

TEST_F(VaoPlusPlusOnSponza, SavingsCostLittleAccuracy) {
    const char* folder = std::getenv("OBSCURA_SCENES");
    const fs::path scenes =
        folder ? fs::path(folder) : fs::path(OBSCURA_SOURCE) / ".." / "shared" / "scenes";
    const fs::path file = scenes / "sponza" / "Sponza.gltf";
    if (!fs::exists(file))
        GTEST_SKIP() << "Sponza is neither in OBSCURA_SCENES nor beside the project (" << file
                     << ")";
    const GpuScene gpu(loadScene(file));
    Camera camera;
    camera.position = {-8, 1.9, 0.75};
    camera.target = {2, 2.9, -0.45};
    camera.fovDegrees = 56;
    const Frame frame = makeFrame(camera, width, height, gpu.bounds(), 1);
    const gl::UniformBuffer block = frameBuffer(frame);
    bindFrame(block);
    GBufferContent content;
    content.occlusionNormal = Normals::smooth;
    const GBuffer gbuffer(width, height, content);
    GBufferPass().draw(gpu, frame, gbuffer);
    const Lighting lighting(whiteLight(), gpu, fs::path());
    const LightBuffers light(width, height, false);
    lighting.draw(gbuffer, light);
    std::vector<float> depth = gl::readFloats(gbuffer.depth(), width, height, gl::Format::r32f);

    const auto look = [&](double adaptive, double culling) {
        Settings settings(technique("vao_plus_plus"));
        settings.set("radius", 0.8);
        settings.set("samples", 32);
        settings.set("adaptive", adaptive);
        settings.set("culling", culling);
        const OcclusionPasses passes(settings, width, height);
        return gl::readFloats(passes.visibility({gbuffer, frame,
                                                 [&] {
                                                     return OcclusionInputs::Light{light, lighting};
                                                 }}),
                              width, height, gl::Format::r32f);
    };
    std::vector<float> sorted = depth;
    std::nth_element(sorted.begin(), sorted.begin() + width * height / 2, sorted.end());
    const float median = sorted[width * height / 2];
    const auto difference = [&](const std::vector<float>& a, const std::vector<float>& b,
                                float from) {
        double sum = 0;
        int count = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (depth[i] > from) {
                sum += std::abs(static_cast<double>(a[i] - b[i]));
                ++count;
            }
        return sum / count;
    };
    const std::vector<float> full = look(0, 0);
    const double careful = difference(full, look(0, 2), 0);
    const double adaptive = difference(full, look(1, 0), median);
    EXPECT_LT(careful, 0.005);
    EXPECT_LT(adaptive, 0.005);
    RecordProperty("careful", std::to_string(careful));
    RecordProperty("adaptive", std::to_string(adaptive));
}

} // namespace
} // namespace obscura
