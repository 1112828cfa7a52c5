// SSDO and proxy spheres against their own limits of infinitely many samples.
#include "renderer/frame/composite.h"
#include "tests/renderer/techniques/limits_fixture.h"

#include <functional>
#include <numbers>

namespace obscura {
namespace {

constexpr double pi = std::numbers::pi;

// A prism along z, seen from straight above: all that the depth buffer can know.
using Height = std::function<double(double x)>;

// Points of SSDO's limit in the hemisphere about the world's y: directions and lengths even.
struct Point {
    glm::dvec3 direction, position;
};
std::vector<Point> hemispherePoints(glm::dvec3 normal, int count) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) {
        const auto coordinate = [&](double step) { return std::fmod(0.5 + (i + 1) * step, 1.0); };
        const double y = coordinate(0.8191725133961645), flat = std::sqrt(1 - y * y);
        const double angle = 2 * pi * coordinate(0.6710436067037893);
        const glm::dvec3 up(flat * std::cos(angle), y, flat * std::sin(angle));
        // The half turn that takes y to the normal.
        const glm::dvec3 axis = glm::normalize(normal + glm::dvec3(0, 1, 0));
        const glm::dvec3 direction = axis * (2 * glm::dot(axis, up)) - up;
        points.push_back({direction, direction * coordinate(0.5497004779019703)});
    }
    return points;
}

// Equation 1 with a visibility of 1 / pi, and with the environment's light: shares that arrive.
struct Arriving {
    double visibility;
    glm::dvec3 light;
};
Arriving arriving(const Height& height, glm::dvec3 at, glm::dvec3 normal, int count,
                  const std::function<glm::dvec3(glm::dvec3)>& radiance) {
    double open = 0, all = 0;
    glm::dvec3 openLight(0), allLight(0);
    for (const Point& point : hemispherePoints(normal, count)) {
        const double cosine = glm::dot(point.direction, normal);
        const glm::dvec3 light = radiance(point.direction) * cosine;
        const glm::dvec3 p = at + point.position;
        const bool isOpen = p.y >= height(p.x);
        open += isOpen ? cosine : 0;
        openLight += isOpen ? light : glm::dvec3(0);
        all += cosine;
        allLight += light;
    }
    return {open / all, openLight / allLight};
}
glm::dvec3 white(glm::dvec3) { return glm::dvec3(1); }

class LightLimits : public Limits {
  protected:
    static Settings ssdo(int samples) {
        Settings settings = unfiltered("ssdo", samples);
        settings.set("bias", 0);
        settings.set("thickness", 1000);
        return settings;
    }
    static Camera above() {
        Camera camera;
        camera.position = {0, 200, 0};
        camera.up = {0, 0, -1};
        camera.fovDegrees = 2 * std::atan(field / 2 * height / width / 200) * 180 / M_PI;
        return camera;
    }
    // The mean of each channel over the column at x = 0.
    static std::array<double, 4> channels(const Scene& scene, const Settings& settings,
                                          const Level& level) {
        const Image image =
            occlusionOf(scene, above(), settings, width, height, 1, Normals::smooth, level);
        std::array<double, 4> sums{};
        for (int y = 0; y < height; ++y)
            for (int c = 0; c < 4; ++c)
                sums[static_cast<std::size_t>(c)] +=
                    static_cast<double>(image.at(width / 2, y, c)) / height;
        return sums;
    }
    static Level skyLight() { // orange above, blue around
        Level level;
        level.sky = Sky{{2, 1, 0.2}, {0.1, 0.5, 2}, {0.1, 0.1, 0.1}};
        return level;
    }
};

// SSDO.

// Lengths are even, so occlusion fades linearly with distance: sheet A.3, row "N8AO-type".
TEST_F(LightLimits, SsdoBesideACurb) {
    const struct {
        float distance, step;
        double occlusion;
    } cases[] = {
        {0.25f, 0.5f, 0.1098}, {0.5f, 0.5f, 0.0356}, {0.1f, 0.2f, 0.0705}, {0.25f, 2, 0.1680}};
    Settings settings = ssdo(512);
    settings.set("directional", 0); // visibility is the same without
    settings.set("bounce", 0);
    for (const auto& c : cases) {
        const double occlusion = 1 - centre(curb(c.distance, c.step), settings);
        EXPECT_NEAR(occlusion, c.occlusion, 0.01) << c.distance << " " << c.step;
    }
}

// Beside a high step the sky's light from the side of the step is missing, and none other.
TEST_F(LightLimits, SsdoLetsInTheLightOfOpenDirections) {
    const Irradiance irradiance = irradianceOf(skyPanorama(*skyLight().sky));
    // As radianceTowards() of environment.glsl.
    const auto radiance = [&](glm::dvec3 d) {
        const double basis[9] = {0.282095,
                                 0.488603 * d.y,
                                 0.488603 * d.z,
                                 0.488603 * d.x,
                                 1.092548 * d.x * d.y,
                                 1.092548 * d.y * d.z,
                                 0.315392 * (3 * d.z * d.z - 1),
                                 1.092548 * d.x * d.z,
                                 0.546274 * (d.x * d.x - d.y * d.y)};
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < 9; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                sum[static_cast<int>(c)] += basis[i] * static_cast<double>(irradiance[i][c]) /
                                            (i == 0  ? pi
                                             : i < 4 ? 2 * pi / 3
                                                     : pi / 4);
        return glm::max(sum, glm::dvec3(0));
    };
    const Arriving limit = arriving([](double x) { return x > 0.1 ? 2.0 : 0.0; }, glm::dvec3(0),
                                    {0, 1, 0}, 1 << 18, radiance);
    Settings settings = ssdo(512);
    settings.set("bounce", 0);
    const std::array<double, 4> found = channels(curb(0.1f, 2), settings, skyLight());
    EXPECT_NEAR(found[0], limit.visibility, 0.01);
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        const double ambient = // white albedo under an upward normal
            (0.282095 * irradiance[0][i] + 0.488603 * irradiance[1][i] -
             0.315392 * irradiance[6][i] - 0.546274 * irradiance[8][i]) /
            pi;
        const double expected = ambient * (limit.light[c] - limit.visibility);
        EXPECT_NEAR(found[i + 1], expected, 0.004 * ambient) << c;
        EXPECT_GT(std::abs(expected), 0.01 * ambient) << "nothing to test";
    }
}

// A grey floor up to x = 0.2 m, from where a red slope rises by 45 degrees, under white light.
// Equation 2 as a mean over points: light sent x cosines / distance^2; what a point of the slope
// sends is its own visibility.
TEST_F(LightLimits, SsdoBouncesTheLightOfAColouredWall) {
    constexpr double d = 0.2, nearest = 0.25;
    Scene scene;
    addStrip(scene, -5, 0, d, 0);
    const std::uint32_t floorEnd = static_cast<std::uint32_t>(scene.indices.size());
    addStrip(scene, d, 0, 5, 5 - static_cast<float>(d));
    scene.materials[0].baseColour = {0.5f, 0.5f, 0.5f, 1};
    scene.materials.push_back({});
    scene.materials[1].baseColour = {0.8f, 0.1f, 0, 1};
    scene.meshes = {{0, floorEnd, 0},
                    {floorEnd, static_cast<std::uint32_t>(scene.indices.size()) - floorEnd, 1}};

    const Height ground = [](double x) { return std::max(x - d, 0.0); };
    const glm::dvec3 up(0, 1, 0), slope(-std::sqrt(0.5), std::sqrt(0.5), 0);
    double sent[65]; // by the slope, over x from d to d + 1
    for (int i = 0; i <= 64; ++i)
        sent[i] = arriving(ground, {d + i / 64.0, i / 64.0, 0}, slope, 1 << 12, white).visibility;
    double sum = 0;
    const std::vector<Point> points = hemispherePoints(up, 1 << 18);
    for (const Point& point : points) {
        const double x = point.position.x;
        if (point.position.y >= ground(x))
            continue;
        const glm::dvec3 towards(x, ground(x), point.position.z);
        const double squared = glm::dot(towards, towards);
        if (squared < 1)
            sum += sent[static_cast<int>((x - d) * 64 + 0.5)] * std::max(towards.y, 0.0) *
                   std::max(-glm::dot(slope, towards), 0.0) /
                   (squared * std::max(squared, nearest * nearest));
    }
    const double limit = sum / static_cast<double>(points.size());
    const std::array<double, 4> found = channels(scene, ssdo(2048), whiteLight());
    EXPECT_GT(limit, 0.02) << "nothing to test";
    EXPECT_NEAR(found[1], 0.5 * 0.8 * limit, 1e-3);
    EXPECT_NEAR(found[2], 0.5 * 0.1 * limit, 2e-4);
    EXPECT_NEAR(found[3], 0, 1e-4);

    Settings few = ssdo(64);
    const double once = channels(scene, few, whiteLight())[1];
    few.set("bounceStrength", 2);
    EXPECT_NEAR(channels(scene, few, whiteLight())[1], 2 * once, 1e-4);
    few.set("bounce", 0);
    EXPECT_NEAR(channels(scene, few, whiteLight())[1], 0, 1e-6);
}

// Where nothing occludes, the image is the plain ambient one, under a sky too and
// with few samples: a slope from above and at a grazing angle, in coarse pixels.
TEST_F(LightLimits, SsdoLeavesAnOpenSceneAsItIs) {
    Scene scene;
    addStrip(scene, -5, 2, 5, -2);
    for (const Level& level : {whiteLight(), skyLight()})
        for (const double eye : {0.5, 5.0}) {
            View view;
            view.camera.position = {3, eye, 2};
            view.camera.target = {0, -0.5, 0};
            const auto image = [&](const char* id) {
                const GpuScene gpuScene(scene);
                const Frame frame = makeFrame(view.camera, 96, 64, gpuScene.bounds(), 1);
                const gl::UniformBuffer block = frameBuffer(frame);
                bindFrame(block);
                const Lighting lighting(level, gpuScene, std::filesystem::path());
                const GBuffer gbuffer(96, 64, {true, lighting.readsNormals(), Normals::smooth});
                GBufferPass().draw(gpuScene, frame, gbuffer);
                const LightBuffers light(96, 64, false);
                lighting.draw(gbuffer, light);
                const OcclusionPasses passes(Settings(technique(id)), 96, 64);
                Composite composite(view, level, 96, 64, true);
                composite.draw(
                    light,
                    passes.visibility({gbuffer, frame,
                                       [&] {
                                           return OcclusionInputs::Light{light, lighting};
                                       }}),
                    passes.sendsLight());
                return composite.meanLinear();
            };
            const std::vector<float> with = image("ssdo"), without = image("none");
            float largest = 0;
            for (std::size_t i = 0; i < with.size(); ++i)
                largest = std::max(largest, std::abs(with[i] - without[i]));
            EXPECT_LT(largest, 1e-6f) << eye; // rounding of the blur's mean
        }
}

// Proxy spheres.

Settings pixelsOnly(Settings settings) {
    settings.set("distant", 0);
    settings.set("pixelsPerTap", 1);
    settings.set("bias", 0);
    return settings;
}

// Occlusion 1 / pi times the integral of cos / d^2 over the step's top within the radius: with rho
// across and h up, h / (rho^2 + h^2)^(3/2), where x > distance.
double curbLimit(double distance, double step) {
    double sum = 0;
    constexpr int n = 2000;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double x = distance + (1 - distance) * (i + 0.5) / n, z = (j + 0.5) / n;
            const double squared = x * x + z * z + step * step;
            sum += squared < 1 ? step / (squared * std::sqrt(squared)) : 0;
        }
    return 2 / pi * sum * (1 - distance) / (n * n);
}

TEST_F(LightLimits, ProxySpheresOfPixelsBesideACurb) {
    const struct {
        float distance, step;
    } cases[] = {{0.25f, 0.5f}, {0.5f, 0.5f}, {0.1f, 0.2f}, {0.25f, 2}};
    for (const auto& c : cases) {
        const double limit =
            curbLimit(static_cast<double>(c.distance), static_cast<double>(c.step));
        EXPECT_NEAR(
            1 - centre(curb(c.distance, c.step), pixelsOnly(unfiltered("proxy_spheres", 1024))),
            limit, 0.01)
            << c.distance << " " << c.step;
    }
}

// Twice the radius, four times the disc.
TEST_F(LightLimits, ProxySpheresOfPixelsGrowWithTheirSize) {
    Settings settings = pixelsOnly(unfiltered("proxy_spheres", 1024));
    settings.set("proxySize", 1.5);
    EXPECT_NEAR(1 - centre(curb(0.5f, 0.5f), settings), 2.25 * curbLimit(0.5, 0.5), 0.01);
}

// A sphere of 0.6 m radius, 1.3 m above a floor, blocks 2 (1 - sqrt(1 - r^2 / d^2)) cos.
TEST_F(LightLimits, OneRealSphereAboveAPlane) {
    const Scene scene = wedge(0);
    Settings settings = neutral("proxy_spheres");
    settings.set("detail", 0);
    settings.set("bias", 0);
    settings.set("sphereSize", 1);
    settings.set("distantReach", 100);
    const Image image = occlusionOf(scene, above(), settings, width, height, 1, Normals::smooth,
                                    whiteLight(), {glm::vec4(0, 1.3f, 0, 0.6f)});
    for (const double x : {0.5, 0.8, 1.2}) {
        const double distance = std::hypot(x, 1.3), sine = 0.6 / distance;
        const double expected = 2 * (1 - std::sqrt(1 - sine * sine)) * 1.3 / distance;
        const int column = static_cast<int>((x / field + 0.5) * width);
        EXPECT_NEAR(1 - static_cast<double>(image.at(column, height / 2, 0)), expected, 0.003) << x;
    }
}

TEST_F(LightLimits, ProxySpheresWithoutEitherPassAreOpen) {
    Settings settings = neutral("proxy_spheres");
    settings.set("detail", 0);
    settings.set("distant", 0);
    EXPECT_EQ(centre(curb(0.25f, 0.5f), settings), 1);
}

} // namespace
} // namespace obscura
