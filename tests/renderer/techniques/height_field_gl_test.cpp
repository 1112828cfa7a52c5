// On smooth height fields, where the depth buffer hides nothing, horizon methods with a cosine
// weight estimate the very integral that the depth-buffer reference traces.
#include "base/random.h"
#include "renderer/reference/depth_reference.h"
#include "tests/renderer/techniques/limits_fixture.h"

#include <numbers>
#include <numeric>

namespace obscura {
namespace {

// Hills of a few wavelengths, facing +z; slopes stay below 1, so that a camera above sees them all.
class Hills {
  public:
    explicit Hills(std::uint64_t seed) {
        Random random(seed, "hills");
        for (Wave& wave : waves_) {
            const double turn = 2 * std::numbers::pi * random.uniform();
            const double number = 3 + 5 * random.uniform(); // radians per metre
            wave = {number * std::cos(turn), number * std::sin(turn),
                    2 * std::numbers::pi * random.uniform(), 0.5 / number};
        }
    }

    Scene scene() const {
        constexpr int cells = 400;
        constexpr double half = 4;
        Scene scene;
        scene.materials.push_back({});
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells; ++i)
                scene.vertices.push_back(
                    vertexAt(half * (2.0 * i / cells - 1), half * (2.0 * j / cells - 1)));
        for (std::uint32_t j = 0; j < cells; ++j)
            for (std::uint32_t i = 0; i < cells; ++i) {
                const std::uint32_t a = j * (cells + 1) + i, b = a + cells + 1;
                for (const std::uint32_t index : {a, a + 1, b + 1, a, b + 1, b})
                    scene.indices.push_back(index);
            }
        scene.meshes.push_back({0, static_cast<std::uint32_t>(scene.indices.size()), 0});
        return scene;
    }

  private:
    struct Wave {
        double x, y, phase, height;
    };
    Vertex vertexAt(double x, double y) const {
        double z = 0, slopeX = 0, slopeY = 0;
        for (const Wave& wave : waves_) {
            const double angle = wave.x * x + wave.y * y + wave.phase;
            z += wave.height * std::sin(angle);
            slopeX += wave.height * wave.x * std::cos(angle);
            slopeY += wave.height * wave.y * std::cos(angle);
        }
        Vertex vertex;
        vertex.position = glm::vec3(x, y, z);
        vertex.normal = glm::normalize(glm::vec3(-slopeX, -slopeY, 1));
        return vertex;
    }
    std::array<Wave, 4> waves_;
};

class HeightField : public GlTest, public testing::WithParamInterface<int> {
  protected:
    static constexpr int size = 128;

    static Camera above() {
        Camera camera;
        camera.position = {0, 0, 6};
        camera.fovDegrees = 45;
        return camera;
    }

    // The integral itself: a hard radius, every pixel on the way, no hierarchy, no filter.
    static Settings exact(const char* id) {
        Settings settings(technique(id));
        const std::pair<const char*, double> values[] = {
            {"radius", 1},      {"slices", 16},           {"steps", 48},
            {"samplePower", 1}, {"falloff", 0},           {"levelOffset", 16},
            {"denoise", 0},     {"minimumVisibility", 0}, {"intensity", 1},
            {"power", 1},       {"radiusMultiplier", 1},  {"thickness", 1e6}};
        for (const auto& [name, value] : values)
            if (settings.has(name))
                settings.set(name, value);
        return settings;
    }

    static Image meanOverSeeds(const Scene& scene, const Settings& settings, int seeds) {
        Image sum{size, size, 1, std::vector<float>(size * size, 0.0f)};
        for (int seed = 1; seed <= seeds; ++seed) {
            const Image one = visibilityOf(scene, above(), settings, size, size,
                                           static_cast<std::uint64_t>(seed));
            for (std::size_t i = 0; i < sum.pixels.size(); ++i)
                sum.pixels[i] += one.pixels[i] / static_cast<float>(seeds);
        }
        return sum;
    }

    struct Agreement {
        double meanAbsolute = 0, bias = 0; // of occlusion, in the middle of the image
    };
    static Agreement agreement(const Image& truth, const Image& found) {
        constexpr int border = 16;
        constexpr double count = (size - 2 * border) * (size - 2 * border);
        Agreement result;
        for (int y = border; y < size - border; ++y)
            for (int x = border; x < size - border; ++x) {
                const auto difference =
                    static_cast<double>(truth.at(x, y, 0)) - static_cast<double>(found.at(x, y, 0));
                result.meanAbsolute += std::abs(difference) / count;
                result.bias += difference / count;
            }
        return result;
    }
};

TEST_P(HeightField, HorizonsAgreeWithTheDepthBufferReference) {
    const Scene scene = Hills(static_cast<std::uint64_t>(GetParam())).scene();
    const GpuScene gpuScene(scene);
    const Frame frame = makeFrame(above(), size, size, gpuScene.bounds(), 1);
    const Surfaces surfaces = surfacesOf(gpuScene, GBufferPass(), frame, Normals::smooth);
    TraceSettings trace;
    trace.radius = 1;
    trace.rays = 256;
    const Image truth = depthReference(surfaces, trace).visibility;
    const double open =
        std::accumulate(truth.pixels.begin(), truth.pixels.end(), 0.0) / (size * size);
    EXPECT_LT(open, 0.93); // there is something to agree on
    for (const char* id : {"gtao", "visibility_bitmask"}) {
        const Agreement with = agreement(truth, meanOverSeeds(scene, exact(id), 4));
        EXPECT_LT(with.meanAbsolute, 0.012) << id;
        EXPECT_LT(std::abs(with.bias), 0.012) << id;
        RecordProperty(std::string(id) + " mean absolute", std::to_string(with.meanAbsolute));
        RecordProperty(std::string(id) + " bias", std::to_string(with.bias));
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, HeightField, testing::Values(1, 2));

} // namespace
} // namespace obscura
