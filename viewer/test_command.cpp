#include "viewer/test_command.h"

#include "base/progress.h"
#include "renderer/found_cameras.h"
#include "renderer/framing.h"
#include "renderer/reference/sight.h"
#include "renderer/render.h"
#include "viewer/presets.h"
#include "viewer/test_mode.h"

#include <fmt/format.h>

namespace obscura {

namespace {

// A room is seen from within and a thing from around it: foundCameras() knows. What nobody says of
// radius and camera is found by rays.
std::vector<View> foundViews(const View& like, const CommandLine& line) {
    const Scene scene = loadSceneOf(like, {line.scenes, {}});
    const Sight sight(scene);
    const RayTracer tracer(scene);
    View view = like;
    if (!line.radius)
        view.radius = suggestedRadius(sight, tracer, line.cameras, line.seed).metres;
    std::vector<View> views;
    const auto add = [&](const std::string& name, const Camera& camera) {
        views.push_back(view);
        views.back().name = name;
        views.back().camera = camera;
    };
    if (line.camera)
        add("camera", *line.camera);
    else if (auto stored = storedViews(viewsFolder(), like); !stored.empty())
        views = std::move(stored);
    else if (scene.cameras.size() >= 2)
        for (std::size_t i = 0; i < scene.cameras.size(); ++i)
            add(fmt::format("{} {}", i + 1, scene.cameras[i].name), scene.cameras[i].camera);
    else
        for (const Camera& camera :
             foundCameras(sight, tracer, view.radius, line.cameras, line.seed))
            add(std::to_string(views.size() + 1), camera);
    return views;
}

} // namespace

TestPlan testPlanOf(const CommandLine& line) {
    TestPlan plan;
    plan.techniques = line.techniques;
    plan.level = line.level;
    plan.normals = line.normals;
    plan.textures = line.textures;
    plan.width = line.width;
    plan.height = line.height;
    plan.seconds = line.seconds;
    plan.rounds = line.rounds;
    plan.seed = line.seed;
    plan.out = line.out;
    plan.scenes = line.scenes;
    plan.cameras = line.views;
    if (!plan.cameras.empty())
        return plan;
    View view;
    view.file = line.scene.file.empty() ? "" : std::filesystem::absolute(line.scene.file).string();
    view.builtin = line.scene.builtin;
    view.ground = line.scene.ground;
    view.exposure = line.exposure;
    view.radius = line.radius.value_or(0);
    plan.cameras = foundViews(view, line);
    return plan;
}

int runTestCommand(const CommandLine& line) {
    const TestPlan plan = testPlanOf(line);
    std::vector<TestRow> rows;
    {
        Progress progress("testing", 1);
        rows = runTest(
            plan,
            [&](double share, const std::string& now) {
                progress.update(share, now);
                return true;
            },
            line.device);
    }
    fmt::print("{}In {}: test.csv, passes.csv, table.txt, and a screenshot of each\n",
               leedsTable(plan, rows), plan.out.string());
    return 0;
}

} // namespace obscura
