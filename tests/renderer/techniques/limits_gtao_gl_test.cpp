// GTAO and the visibility bitmask against their own limits of infinitely many slices and steps.
#include "tests/renderer/techniques/slices_fixture.h"

namespace obscura {
namespace {

// Sheet A.3, row "GTAO exact horizon, hard R".
TEST_F(SlicesLimits, ExactHorizonBesideACurb) {
    const double expected[] = {0.2676, 0.1273, 0.2760, 0};
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(besideCurb(curbs[i], exact("gtao")), expected[i], 0.01) << i;
        EXPECT_NEAR(sheetLimit(curbs[i].distance, 99, curbs[i].step, 1e9), expected[i], 1e-3) << i;
    }
}

// Sheet A.3, row "XeGTAO defaults before / after ^2.2".
TEST_F(SlicesLimits, XeGtaosDefaultsBesideACurb) {
    const double before[] = {0.2409, 0.0775, 0.2752, 0}, after[] = {0.4547, 0.1627, 0.5075, 0};
    Settings settings = exact("gtao");
    settings.set("falloff", 0.615);
    settings.set("radiusMultiplier", 1.457);
    settings.set("steps", 128);
    for (int i = 0; i < 4; ++i) {
        settings.set("power", 1);
        EXPECT_NEAR(besideCurb(curbs[i], settings, 1.457), before[i], 0.01) << i;
        settings.set("power", 2.2);
        EXPECT_NEAR(besideCurb(curbs[i], settings, 1.457), after[i], 0.015) << i;
    }
}

TEST_F(SlicesLimits, BitmaskOfEndlessThicknessIsGtao) {
    const double expected[] = {0.2676, 0.1273, 0.2760, 0};
    for (int i = 0; i < 4; ++i)
        for (const char* id : {"visibility_bitmask", "gt_vbao"})
            EXPECT_NEAR(besideCurb(curbs[i], exact(id)), expected[i], 0.01) << id << i;
}

TEST_F(SlicesLimits, BitmaskOfFiniteThicknessBesideACurb) {
    Settings settings = exact("visibility_bitmask");
    for (const auto& [c, thickness] :
         {std::pair(curbs[0], 0.1), {curbs[0], 0.3}, {curbs[1], 0.2}, {curbs[2], 0.1}}) {
        settings.set("thickness", thickness);
        EXPECT_NEAR(occlusionFrom(above(c.distance, 1), sheet(c.distance, 2, c.step), settings),
                    sheetLimit(c.distance, 2, c.step, thickness), 0.01)
            << c.distance << " " << thickness;
    }
}

// Light passes beneath a bar that floats beside the point.
TEST_F(SlicesLimits, BitmaskBesideAFloatingBar) {
    Settings settings = exact("visibility_bitmask");
    const Scene scene = sheet(0.2, 0.5, 0.4);
    for (const double thickness : {0.06, 0.15, 0.3, 1e6}) {
        settings.set("thickness", thickness);
        EXPECT_NEAR(occlusionFrom(above(0.2, 1), scene, settings),
                    sheetLimit(0.2, 0.5, 0.4, thickness), 0.01)
            << thickness;
    }
}

TEST_F(SlicesLimits, AdaptiveSlicesHaveTheSameLimit) {
    for (const char* id : {"gtao", "visibility_bitmask", "gt_vbao"}) {
        Settings settings = exact(id);
        settings.set("adaptive", 1);
        for (const auto& [curb, expected] : {std::pair(curbs[0], 0.2676), {curbs[2], 0.2760}})
            EXPECT_NEAR(besideCurb(curb, settings), expected, 0.01) << id << curb.distance;
    }
}

// A surface as thick as it goes on outwards, and not less than `least`: fronts move outwards
// continuously, so the union of all arcs reaches from the first front to the farthest back.
TEST_F(SlicesLimits, GtVbaoIsAsThickAsWide) {
    constexpr double nearEdge = 0.2, h = 0.4;
    constexpr double pixel = nearEdge / 11.75; // of above(); both edges lie a quarter outside
    Settings settings = exact("gt_vbao");
    for (const auto& [farEdge, least] :
         {std::pair(20.25 * pixel, 0.02), {29.25 * pixel, 0.02}, {29.25 * pixel, 0.25}}) {
        settings.set("thickness", least);
        const double far = farEdge, thinnest = least; // clang 14 captures no bindings
        const double expected = overAzimuths([&](double cosine) {
            const double within = std::sqrt(1 - h * h), from = nearEdge / cosine;
            const double end = std::min(far / cosine, 1.0), to = std::min(end, within);
            double back = 0;
            for (int i = 0; i <= 100 && from < to; ++i) {
                const double x = from + (to - from) * i / 100;
                back = std::max(back, std::atan2(x, h - std::max(end - x, thinnest)));
            }
            return from < to ? std::pair(std::atan2(from, h), back) : std::pair(0.0, 0.0);
        });
        EXPECT_NEAR(occlusionFrom(above(nearEdge, 1), sheet(nearEdge, far, h), settings), expected,
                    0.01)
            << farEdge << " " << least;
    }
}

// Seen obliquely: a wall at x = 0 of height h, 2 l long, and a floor point at distance d. The view
// factor of a rectangle at right angles to the point's own plane is
//   O = (atan(l / d) - d / e atan(l / e)) / pi,  e^2 = d^2 + h^2.
class ObliqueWall : public SlicesLimits, public testing::WithParamInterface<const char*> {
  protected:
    static constexpr double d = 0.15, h = 0.3, l = 1.2;
    static double limit() {
        const double e = std::hypot(d, h);
        return (std::atan(l / d) - d / e * std::atan(l / e)) / M_PI;
    }
    // The floor around the point, and the wall's upper edge, which alone decides the horizon.
    static Scene wall() {
        Scene scene;
        const float x = static_cast<float>(d), y = static_cast<float>(h), z = static_cast<float>(l);
        addQuad(scene, {glm::vec3(x - 0.05f, 0, 0.05f), glm::vec3(x + 0.05f, 0, 0.05f),
                        glm::vec3(x + 0.05f, 0, -0.05f), glm::vec3(x - 0.05f, 0, -0.05f)});
        addQuad(scene, {glm::vec3(0, y - 0.1f, z), glm::vec3(0, y - 0.1f, -z), glm::vec3(0, y, -z),
                        glm::vec3(0, y, z)});
        return scene;
    }
    // Towards the point, from an elevation above the floor and an azimuth from the wall's normal.
    static Camera camera(double elevationDegrees, double azimuthDegrees) {
        const double e = elevationDegrees * M_PI / 180, a = azimuthDegrees * M_PI / 180;
        Camera result;
        result.position = {d + 10 * std::cos(e) * std::cos(a), 10 * std::sin(e),
                           10 * std::cos(e) * std::sin(a)};
        result.target = {d, 0, 0};
        result.up = {0, 0, 1};
        result.fovDegrees = 2 * std::atan(1.3 / 10) * 180 / M_PI;
        return result;
    }
    static double seen(const Settings& settings, const Camera& from, int size, int seeds) {
        double sum = 0;
        for (int seed = 0; seed < seeds; ++seed)
            sum += 1 - static_cast<double>(visibilityOf(wall(), from, settings, size, size,
                                                        static_cast<std::uint64_t>(seed))
                                               .at(size / 2, size / 2, 0));
        return sum / seeds;
    }
};

TEST_P(ObliqueWall, ReadsItsViewFactor) {
    Settings settings = exact(GetParam());
    settings.set("radius", 3);
    settings.set("slices", 32);
    settings.set("steps", 96);
    for (const auto& [elevation, azimuth] : {std::pair(30, 0), {60, 0}, {40, 30}})
        EXPECT_NEAR(seen(settings, camera(elevation, azimuth), 151, 1), limit(), 0.015)
            << elevation << " " << azimuth;
}

// Slices drawn by weight: a single one has no bias.
TEST_P(ObliqueWall, FewSlicesHaveTheSameMean) {
    Settings settings = exact(GetParam());
    settings.set("radius", 3);
    settings.set("slices", 1);
    EXPECT_NEAR(seen(settings, camera(30, 0), 75, 32), limit(), 0.025);
}

INSTANTIATE_TEST_SUITE_P(Slices, ObliqueWall,
                         testing::Values("gtao", "visibility_bitmask", "gt_vbao"),
                         [](const auto& test) { return std::string(test.param); });

// A half-buried ball seen in perspective from nearby, aside of the middle of the image, with a
// radius that encloses the camera. On the floor at distance x from the centre of a ball of radius
// 1,
//   O = (s - sin s cos s) / pi, sin s = 1 / x (sheet A.1, case 5).
class Dome : public SlicesLimits, public testing::WithParamInterface<const char*> {
  protected:
    static Scene dome() {
        Scene scene;
        addQuad(scene, {glm::vec3(1.1f, 0, 0.7f), glm::vec3(2.2f, 0, 0.7f),
                        glm::vec3(2.2f, 0, -0.7f), glm::vec3(1.1f, 0, -0.7f)});
        constexpr int count = 48;
        const auto at = [](int i, int j) {
            const double a = j * M_PI / 2 / count, b = i * 2 * M_PI / count;
            return glm::vec3(std::cos(a) * std::cos(b), std::sin(a), -std::cos(a) * std::sin(b));
        };
        for (int i = 0; i < count; ++i)
            for (int j = 0; j < count - 1; ++j)
                addQuad(scene, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        return scene;
    }
};

TEST_P(Dome, OccludesTheFloorInPerspective) {
    constexpr int size = 96;
    Camera camera;
    camera.position = {2.2, 3, 1.2};
    camera.target = {0.6, 0, -0.2};
    camera.fovDegrees = 60;
    Settings settings = exact(GetParam());
    settings.set("radius", 20);
    const Scene scene = dome();
    const Image image = visibilityOf(scene, camera, settings, size, size);
    const Frame frame = makeFrame(camera, size, size, scene.bounds(), 1);
    const glm::vec3 eye(frame.worldFromView[3]);
    double error = 0, bias = 0;
    int count = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::vec2 uv((x + 0.5f) / size, (size - y - 0.5f) / size);
            const glm::vec3 ray = glm::mat3(frame.worldFromView) *
                                  glm::vec3(uv.x * frame.viewFromUv.x + frame.viewFromUv.z,
                                            uv.y * frame.viewFromUv.y + frame.viewFromUv.w, -1);
            const glm::vec3 floor = eye - ray * (eye.y / ray.y);
            if (ray.y >= 0 || floor.x < 1.15f || floor.x > 2.15f || std::abs(floor.z) > 0.65f)
                continue;
            const double s = std::asin(1 / std::hypot(floor.x, floor.z));
            const double expected = (s - std::sin(s) * std::cos(s)) / M_PI;
            const double off = 1 - static_cast<double>(image.at(x, y, 0)) - expected;
            error += std::abs(off);
            bias += off;
            ++count;
        }
    ASSERT_GT(count, 200);
    EXPECT_LT(error / count, 0.008);
    EXPECT_NEAR(bias / count, 0, 0.004);
}

INSTANTIATE_TEST_SUITE_P(Slices, Dome, testing::Values("gtao", "visibility_bitmask", "gt_vbao"),
                         [](const auto& test) { return std::string(test.param); });

// Every pixel of a plane, at any angle, with the fewest samples and no filter.
class TiltedPlane : public SlicesLimits,
                    public testing::WithParamInterface<std::tuple<const char*, int>> {};

TEST_P(TiltedPlane, IsOpen) {
    const auto [id, tilt] = GetParam();
    const double angle = tilt * M_PI / 180;
    Camera camera;
    camera.position = {0, 5 * std::cos(angle), 5 * std::sin(angle)};
    camera.up = {0, std::sin(angle), -std::cos(angle)};
    camera.fovDegrees = 60;
    Settings settings(technique(id));
    settings.apply("low");
    settings.set("denoise", 0);
    settings.set("radius", 1);
    for (const auto& [levels, steps] : {std::pair(16, 2), {0, 2}, {3, 16}}) {
        settings.set("levelOffset", levels);
        settings.set("steps", steps);
        const Image image = visibilityOf(wedge(0), camera, settings, 128, 96);
        EXPECT_GT(*std::min_element(image.pixels.begin(), image.pixels.end()), 0.99f) << levels;
    }
}

INSTANTIATE_TEST_SUITE_P(Slices, TiltedPlane,
                         testing::Combine(testing::Values("gtao", "visibility_bitmask", "gt_vbao"),
                                          testing::Values(0, 20, 40, 60, 70, 80)),
                         [](const auto& test) {
                             return std::string(std::get<0>(test.param)) + "At" +
                                    std::to_string(std::get<1>(test.param));
                         });

class BentNormals : public SlicesLimits {
  protected:
    static constexpr Sky sky{{1, 0.9, 0.8}, {0.1, 0.2, 0.3}, {0, 0, 0}};
    // Its irradiance on a surface with that normal; the sky is the same all around.
    static double irradianceOf(const glm::dvec3& n, int channel) {
        const Irradiance e = obscura::irradianceOf(skyPanorama(sky));
        const auto term = [&](std::size_t i) {
            return static_cast<double>(e[i][static_cast<std::size_t>(channel)]);
        };
        return 0.282095 * term(0) + 0.488603 * n.y * term(1) +
               0.315392 * (3 * n.z * n.z - 1) * term(6) +
               0.546274 * (n.x * n.x - n.y * n.y) * term(8);
    }
    // A pass's output where the column and row meet, all four channels, under light from above.
    static glm::vec4 resultAt(const char* pass, const Scene& scene, const Above& view,
                              const Settings& settings) {
        const GpuScene gpuScene(scene);
        const Frame frame = makeFrame(view.camera, view.width, view.height, gpuScene.bounds(), 1);
        const gl::UniformBuffer block = frameBuffer(frame);
        bindFrame(block);
        GBufferContent content;
        content.occlusionNormal = Normals::smooth;
        const GBuffer gbuffer(view.width, view.height, content);
        GBufferPass().draw(gpuScene, frame, gbuffer);
        Level level;
        level.sky = sky;
        const Lighting lighting(level, gpuScene, std::filesystem::path());
        const LightBuffers lights(view.width, view.height, false);
        const OcclusionPasses passes(settings, view.width, view.height);
        passes.visibility({gbuffer, frame, [&] {
                               return OcclusionInputs::Light{lights, lighting};
                           }});
        EXPECT_EQ(passes.sendsLight(), settings["bentNormals"] > 0);
        const std::vector<float> values = gl::readFloats(passes.result(pass).texture(), view.width,
                                                         view.height, gl::Format::rgba32f);
        glm::vec4 sum(0);
        for (int y = view.row - 4; y <= view.row + 4; ++y)
            for (int c = 0; c < 4; ++c)
                sum[c] += values[static_cast<std::size_t>((y * view.width + view.column) * 4 + c)];
        return sum / 9.0f;
    }
    // The mean over the hemisphere, weighted by the cosine, of open directions beside a curb: in
    // world space, y up. The length is kept: 2/3 when all is open.
    static glm::dvec3 meanOpenDirection(const Curb& c) {
        glm::dvec3 sum(0);
        constexpr int count = 1000;
        for (int i = 0; i < count; ++i)
            for (int j = 0; j < count; ++j) {
                const double azimuth = (i + 0.5) / count * 2 * M_PI;
                const double sine = std::sqrt((j + 0.5) / count),
                             cosine = std::sqrt(1 - sine * sine);
                const bool blocked = std::cos(azimuth) > 0 &&
                                     std::hypot(c.distance / std::cos(azimuth), c.step) < 1 &&
                                     cosine * c.distance / std::cos(azimuth) < c.step * sine;
                if (!blocked)
                    sum += glm::dvec3(sine * std::cos(azimuth), cosine, sine * std::sin(azimuth));
            }
        return sum / static_cast<double>(count * count);
    }
};

TEST_F(BentNormals, LeanAwayFromACurb) {
    Settings settings = exact("gtao");
    settings.set("bentNormals", 1);
    for (const Curb& c : {curbs[0], curbs[1], curbs[2]}) {
        const Scene scene = sheet(c.distance, c.distance + 0.12, c.step);
        const glm::vec4 gathered = resultAt("gather", scene, above(c.distance, 1), settings);
        // View space from above: x to the right, y towards -z of the world, z up.
        const glm::dvec3 expected = meanOpenDirection(c);
        EXPECT_NEAR(gathered.y, expected.x, 0.01) << c.distance;
        EXPECT_NEAR(gathered.z, -expected.z, 0.01) << c.distance;
        EXPECT_NEAR(gathered.w, expected.y, 0.01) << c.distance;
    }
}

// The light that is added is what a surface facing the open direction gets more than this one,
// times the final visibility.
TEST_F(BentNormals, MoveAmbientLightToTheOpenSide) {
    Settings settings = exact("gtao");
    settings.set("bentNormals", 1);
    settings.set("power", 2);
    const Scene scene = sheet(0.25, 0.4, 0.5);
    const glm::vec4 light = resultAt("bentLight", scene, above(0.25, 1), settings);
    const double visibility = (1 - 0.2676) * (1 - 0.2676); // power 2
    EXPECT_NEAR(light.x, visibility, 0.015);
    const glm::dvec3 bent = glm::normalize(meanOpenDirection(curbs[0]));
    for (int channel = 0; channel < 3; ++channel) {
        const double gain = irradianceOf(bent, channel) - irradianceOf({0, 1, 0}, channel);
        EXPECT_LT(gain, -0.02); // the sky is brightest in the zenith
        EXPECT_NEAR(light[channel + 1], gain / M_PI * visibility, 0.003) << channel;
    }
    const glm::vec4 open = resultAt("bentLight", wedge(0), above(0.25, 1), settings);
    EXPECT_NEAR(open.y, 0, 1e-3);
}

// Just below the edge of a block a ledge darkens its front, of which the open top must show nothing
// however often the denoiser runs. Depth goes on over the edge; only normals part the two. Where
// they count for nothing, as in XeGTAO, the top is dark beside the edge.
TEST_F(SlicesLimits, TheDenoiserStopsAtCreases) {
    Scene scene;
    addQuad(scene,
            {glm::vec3(-1, 1, 0), glm::vec3(1, 1, 0), glm::vec3(1, 1, -1), glm::vec3(-1, 1, -1)});
    addQuad(scene,
            {glm::vec3(-1, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(-1, 1, 0)});
    addQuad(scene, {glm::vec3(-1, 0.95f, 0.1f), glm::vec3(1, 0.95f, 0.1f), glm::vec3(1, 0.95f, 0),
                    glm::vec3(-1, 0.95f, 0)});
    Camera camera;
    camera.position = {0, 4, 3};
    camera.target = {0, 1, 0};
    camera.fovDegrees = 4;
    const auto darkestOfTop = [&](const char* id, double edgeAngle) {
        Settings settings = neutral(id);
        settings.set("radius", 0.3);
        settings.set("denoise", 3);
        settings.set("edgeAngle", edgeAngle);
        const Image image = visibilityOf(scene, camera, settings, 64, 64);
        const auto row = image.pixels.begin() + 64 * 8, edge = image.pixels.begin() + 64 * 32;
        return *std::min_element(row, edge); // the camera looks at the block's edge
    };
    for (const char* id : {"gtao", "visibility_bitmask", "gt_vbao"}) {
        EXPECT_GT(darkestOfTop(id, Settings(technique(id))["edgeAngle"]), 0.995f) << id;
        EXPECT_LT(darkestOfTop(id, 180), 0.97f) << id;
    }
}

// The denoiser evens out noise and leaves the mean.
TEST_F(SlicesLimits, DenoisingKeepsTheMean) {
    for (const char* id : {"gtao", "visibility_bitmask", "gt_vbao"}) {
        Settings settings = neutral(id);
        settings.set("slices", 2);
        double before = 1, mean = -1;
        for (int passes = 0; passes < 4; ++passes) {
            settings.set("denoise", passes);
            const Above view = above(0.25, 1);
            const Image image =
                visibilityOf(curb(0.25f, 0.5f), view.camera, settings, view.width, view.height);
            double sum = 0, squares = 0;
            int count = 0;
            for (int y = 30; y < view.height - 30; ++y, ++count) {
                const auto v = static_cast<double>(image.at(view.column, y, 0));
                sum += v;
                squares += v * v;
            }
            const double deviation = std::sqrt(squares / count - sum * sum / count / count);
            EXPECT_LT(deviation, 0.95 * before) << id << passes;
            before = deviation;
            mean = passes == 0 ? sum / count : mean;
            EXPECT_NEAR(sum / count, mean, 0.015) << id << passes;
        }
    }
}

} // namespace
} // namespace obscura
