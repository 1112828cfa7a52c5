#include "bench/measure/layers.h"
#include "bench/measure/timing.h"
#include "renderer/scene/quads.h"
#include "tests/renderer/gl_test.h"

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

void addSheet(Scene& scene, float x0, float x1, float y) {
    addQuad(scene, {glm::vec3(x0, y, 0.9f), glm::vec3(x1, y, 0.9f), glm::vec3(x1, y, -0.9f),
                    glm::vec3(x0, y, -0.9f)});
}

// From straight above, 2 m across.
Camera fromAbove() {
    Camera camera;
    camera.position = {0, 100, 0};
    camera.up = {0, 0, -1};
    camera.fovDegrees = 2 * std::atan(1 / 100.0) * 180 / M_PI;
    return camera;
}

std::vector<LayersFloor> floorsOf(const Scene& scene) {
    const Subject subject(scene);
    const Probe probe(subject, fromAbove(), 24, 24, Normals::smooth, 1);
    TraceSettings settings;
    settings.radius = 1;
    settings.rays = 64;
    return measureLayers(scene, probe, settings);
}

class Floors : public GlTest {};

// A sheet that alone occludes lies under roofs that are too high to.
TEST_F(Floors, FallToNothingWithTheLayerThatShowsWhatBlocks) {
    for (int roofs = 0; roofs < 3; ++roofs) {
        Scene scene;
        addSheet(scene, -1, 1, 0);
        addSheet(scene, -0.2f, 0.2f, 0.4f);
        for (int i = 0; i < roofs; ++i)
            addSheet(scene, -0.3f, 0.3f, 2.0f + static_cast<float>(i));
        for (const LayersFloor& floor : floorsOf(scene)) {
            SCOPED_TRACE(floor.layers);
            if (floor.layers > roofs) {
                EXPECT_LT(floor.error.rmse, 1e-6);
            } else {
                EXPECT_GT(floor.error.rmse, 0.05);
                EXPECT_LT(floor.error.bias, -0.03);
            }
        }
    }
}

// A sheet 2 to 10 cm beyond the border is within the guard band of a tenth, 20 cm.
TEST_F(Floors, FallToNothingWithTheGuardBandThatShowsWhatBlocks) {
    Scene scene;
    addSheet(scene, -1.5f, 1.5f, 0);
    addSheet(scene, 1.05f, 1.1f, 0.4f);
    for (const LayersFloor& floor : floorsOf(scene)) {
        if (floor.guardBand > 0)
            EXPECT_LT(floor.error.rmse, 1e-6) << floor.layers;
        else
            EXPECT_GT(floor.error.rmse, 1e-3) << floor.layers;
    }
}

// What more layers cost is the technique's own.
TEST_F(Floors, LayersAreTimedAndCountedAsPreparation) {
    Scene scene;
    addSheet(scene, -1, 1, 0);
    const Subject subject(scene);
    const Probe probe(subject, fromAbove(), 24, 24, Normals::smooth, 1);
    Settings one(technique("gtao")), three = one;
    three.set("layers", 3);
    TimingPlan plan;
    plan.frames = 3;
    const auto times = timeTechniques(probe, std::vector{one, three}, 1, plan);
    const auto layers = [](const TechniqueTime& time) {
        return std::find_if(time.passes.begin(), time.passes.end(),
                            [](const PassTime& pass) { return pass.name == "layers"; });
    };
    EXPECT_EQ(layers(times[0]), times[0].passes.end());
    ASSERT_NE(layers(times[1]), times[1].passes.end());
    EXPECT_EQ(layers(times[1])->work, static_cast<int>(Work::prepare));
    EXPECT_GT(layers(times[1])->median, 0);
    EXPECT_EQ(times[1].bytes - times[0].bytes, 24 * 24 * 16);
}

} // namespace
} // namespace obscura
