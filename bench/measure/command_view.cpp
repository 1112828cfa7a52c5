#include "base/arguments.h"
#include "base/progress.h"
#include "bench/commands.h"
#include "bench/measure/layers.h"
#include "bench/measure/measured_view.h"
#include "bench/measure/normals.h"
#include "bench/measure/rays.h"
#include "bench/measure/tested_technique.h"
#include "bench/measure/thickness.h"
#include "bench/measure/timing.h"
#include "gl/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace obscura {

namespace {

namespace fs = std::filesystem;

struct Options {
    std::string scene = "atrium", integral = "cosine";
    fs::path scenes;
    std::vector<double> camera{7.6, 1.2, -0.9, -4, 2.4, 1.2};
    double fovDegrees = 60;
    int width = 640, height = 360;
    TraceSettings settings;
    std::vector<std::string> techniques;
    double seconds = 5;
};

Scene sceneOf(const Options& options) {
    return loadSceneOf(viewOfScene(options.scene), {options.scenes, {}});
}

Camera cameraOf(const Options& options) {
    Camera camera;
    const auto& c = options.camera;
    camera.position = {c[0], c[1], c[2]};
    camera.target = {c[3], c[4], c[5]};
    camera.fovDegrees = options.fovDegrees;
    return camera;
}

TraceSettings traceSettingsOf(const Options& options) {
    const std::vector<std::string>& names = integralNames();
    TraceSettings settings = options.settings;
    settings.integral = static_cast<Integral>(
        std::find(names.begin(), names.end(), options.integral) - names.begin());
    return settings;
}

int runRays(const Options& options) {
    const Scene scene = sceneOf(options);
    const gl::Context context;
    const GpuScene gpuScene(scene);
    const Surfaces surfaces = surfacesOf(gpuScene, GBufferPass(),
                                         makeFrame(cameraOf(options), options.width, options.height,
                                                   gpuScene.bounds(), options.settings.seed),
                                         Normals::smooth);
    const RayRates rates = measureRays(scene, surfaces, traceSettingsOf(options));
    fmt::print("{}: {:.1f} million rays within {} m, {}\n", options.scene, rates.rays * 1e-6,
               options.settings.radius, options.integral);
    fmt::print("million rays a second and core: ours {:.2f}; bare Embree, one by one {:.2f}, in "
               "packets {:.2f}\n",
               rates.ours * 1e-6, rates.single * 1e-6, rates.packets * 1e-6);
    fmt::print("ratio: {:.2f} one by one, {:.2f} packets; our trace {:.1f} s, peak memory {:.0f} "
               "MiB\n",
               rates.ours / rates.single, rates.ours / rates.packets, rates.wall, peakMemory());
    return 0;
}

int runNormals(const Options& options) {
    const gl::Context context;
    const NormalsEffect effect = measureNormals(sceneOf(options), cameraOf(options), options.width,
                                                options.height, traceSettingsOf(options));
    fmt::print("mean visibility: face {:.4f}, smooth {:.4f}, mapped {:.4f}\n", effect.mean[0],
               effect.mean[1], effect.mean[2]);
    fmt::print("RMSE: face-smooth {:.4f}, smooth-mapped {:.4f}, face-mapped {:.4f}; noise {:.4f} "
               "taken out\n",
               effect.faceSmooth, effect.smoothMapped, effect.faceMapped, effect.noise);
    return 0;
}

int runThickness(const Options& options) {
    const Scene scene = sceneOf(options);
    const gl::Context context;
    const Subject subject(scene);
    const Probe probe(subject, cameraOf(options), options.width, options.height, Normals::smooth,
                      options.settings.seed);
    for (const ThicknessEffect& effect : measureThickness(scene, probe, traceSettingsOf(options)))
        fmt::print("thickness {}: RMSE {:.4f}, bias {:+.4f}, SSIM {:.3f}\n",
                   effect.radii ? fmt::format("{:g} R", *effect.radii) : "infinite",
                   effect.error.rmse, effect.error.bias, effect.error.ssim);
    return 0;
}

int runLayers(const Options& options) {
    const Scene scene = sceneOf(options);
    const gl::Context context;
    const Subject subject(scene);
    const Probe probe(subject, cameraOf(options), options.width, options.height, Normals::smooth,
                      options.settings.seed);
    for (const LayersFloor& floor : measureLayers(scene, probe, traceSettingsOf(options)))
        fmt::print("{} layer{}, guard band {:g}: RMSE {:.4f}, bias {:+.4f}\n", floor.layers,
                   floor.layers > 1 ? "s" : "", floor.guardBand, floor.error.rmse,
                   floor.error.bias);
    return 0;
}

int runPasses(const Options& options) {
    const Scene scene = sceneOf(options);
    const gl::Context context;
    const gl::TimingChoice choice = gl::honestTiming();
    const Subject subject(scene);
    const Probe probe(subject, cameraOf(options), options.width, options.height, Normals::smooth,
                      options.settings.seed);
    std::vector<Settings> techniques;
    for (const std::string& text : options.techniques) {
        techniques.push_back(TestedTechnique(text).settings());
        if (techniques.back().has("radius"))
            techniques.back().set("radius", options.settings.radius);
    }
    TimingPlan plan;
    plan.seconds = options.seconds;
    plan.timing = choice.timing;
    const auto times = timeTechniques(probe, techniques, options.settings.radius, plan);
    fmt::print("{}, {}x{}, {}; {}\n", options.scene, options.width, options.height,
               context.driver().renderer, choice.reason);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const TechniqueTime& time = times[i];
        fmt::print("{}: {:.2f} ms ({:.2f} ... {:.2f}, {} frames); {:.3f} x G-buffer ({:.2f} ms), "
                   "{:.3f} x starcraft 16; {:.1f} bytes a pixel\n ",
                   options.techniques[i], time.total.median, time.total.low, time.total.high,
                   time.frames, time.total.median / time.gbuffer, time.gbuffer,
                   time.total.median / time.starcraft,
                   time.bytes / (1.0 * options.width * options.height));
        for (const PassTime& pass : time.passes)
            fmt::print(" {} {:.2f}", pass.name, pass.median);
        fmt::print("\n");
    }
    return 0;
}

} // namespace

std::vector<Command> viewCommands(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    const char* scenes = std::getenv("OBSCURA_SCENES");
    options->scenes = scenes ? scenes : ".";
    CLI::App* ray = app.add_subcommand("rays", "our ray tracing beside a bare Embree loop");
    CLI::App* normal =
        app.add_subcommand("normals", "what face, smooth and mapped normals do to visibility");
    CLI::App* thick = app.add_subcommand(
        "thickness", "how far the depth buffer's reference is from the scene's, by its thickness");
    CLI::App* layer = app.add_subcommand(
        "layers", "the least error of what knows all that one, two or three layers of depth show");
    CLI::App* pass = app.add_subcommand(
        "passes", "what each pass of some techniques takes, all timed in turn on one view");
    for (CLI::App* command : {ray, normal, thick, layer, pass}) {
        command
            ->add_option("--scene", options->scene, "built-in scene or file in the scenes folder")
            ->capture_default_str();
        command->add_option("--scenes", options->scenes, "scenes folder; default OBSCURA_SCENES");
        command->add_option("--camera", options->camera, "position x y z, target x y z")
            ->expected(6)
            ->check(numberFrom(-1e9, 1e9));
        command->add_option("--fov", options->fovDegrees, "vertical, degrees")
            ->check(numberFrom(1, 170))
            ->capture_default_str();
        for (auto [name, value] :
             {std::pair("--width", &options->width), std::pair("--height", &options->height)})
            command->add_option(name, *value)->check(CLI::Range(1, 16384))->capture_default_str();
        command->add_option("--radius", options->settings.radius, "metres")
            ->check(numberFrom(1e-4, 1e4))
            ->capture_default_str();
    }
    for (CLI::App* command : {ray, normal, thick, layer}) {
        command->add_option("--rays", options->settings.rays, "per pixel")->capture_default_str();
        command->add_option("--integral", options->integral)
            ->check(CLI::IsMember(integralNames()))
            ->capture_default_str();
    }
    pass->add_option("techniques", options->techniques,
                     "technique and settings in one argument: \"hbao steps=8 blur=0\"")
        ->required();
    pass->add_option("--seconds", options->seconds, "of each, or 200 frames")
        ->check(numberFrom(0, 86400))
        ->capture_default_str();
    return {{ray, [options] { return runRays(*options); }},
            {normal, [options] { return runNormals(*options); }},
            {thick, [options] { return runThickness(*options); }},
            {layer, [options] { return runLayers(*options); }},
            {pass, [options] { return runPasses(*options); }}};
}

} // namespace obscura
