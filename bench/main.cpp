#include "renderer/builtin.h"
#include "renderer/gl/context.h"

#include "bench/normals.h"
#include "bench/rays.h"
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace {

using namespace obscura;
namespace fs = std::filesystem;

struct Options {
    std::string scene = "atrium", integral = "cosine";
    fs::path scenes;
    std::vector<double> camera{7.6, 1.2, -0.9, -4, 2.4, 1.2};
    double fovDegrees = 60;
    int width = 640, height = 360;
    TraceSettings settings;
};

// Peak memory of this process, MiB, as Linux counts it; 0 where there is no /proc.
double peakMemory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:"))
            return std::strtod(line.c_str() + 6, nullptr) / 1024;
    return 0;
}

Scene sceneOf(const Options& options) {
    const auto builtins = builtinSceneNames();
    return std::find(builtins.begin(), builtins.end(), options.scene) != builtins.end()
               ? builtinScene(options.scene)
               : loadScene(options.scenes / options.scene);
}

Camera cameraOf(const Options& options) {
    Camera camera;
    const auto& c = options.camera;
    camera.position = {c[0], c[1], c[2]};
    camera.target = {c[3], c[4], c[5]};
    camera.fovDegrees = options.fovDegrees;
    return camera;
}

int rays(const Options& options) {
    const Scene scene = sceneOf(options);
    const gl::Context context;
    const GpuScene gpuScene(scene);
    const Surfaces surfaces = surfacesOf(gpuScene, GBufferPass(),
                                         makeFrame(cameraOf(options), options.width, options.height,
                                                   gpuScene.bounds(), options.settings.seed),
                                         Normals::smooth);
    const RayRates rates = measureRays(scene, surfaces, options.settings);
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

int normals(const Options& options) {
    const gl::Context context;
    const NormalsEffect effect = measureNormals(sceneOf(options), cameraOf(options), options.width,
                                                options.height, options.settings);
    fmt::print("mean visibility: face {:.4f}, smooth {:.4f}, mapped {:.4f}\n", effect.mean[0],
               effect.mean[1], effect.mean[2]);
    fmt::print("RMSE: face-smooth {:.4f}, smooth-mapped {:.4f}, face-mapped {:.4f}; noise {:.4f} "
               "taken out\n",
               effect.faceSmooth, effect.smoothMapped, effect.faceMapped, effect.noise);
    return 0;
}

int run(int argc, char** argv) {
    Options options;
    const char* scenes = std::getenv("OBSCURA_SCENES");
    options.scenes = scenes ? scenes : ".";
    CLI::App app("obscura-bench: how fast the parts of Obscura are");
    app.require_subcommand(1);
    CLI::App* ray = app.add_subcommand("rays", "our ray tracing beside a bare Embree loop");
    CLI::App* normal =
        app.add_subcommand("normals", "what face, smooth and mapped normals do to visibility");
    for (CLI::App* command : {ray, normal}) {
        command->add_option("--scene", options.scene, "built-in scene or file in the scenes folder")
            ->capture_default_str();
        command->add_option("--scenes", options.scenes, "scenes folder; default OBSCURA_SCENES");
        command->add_option("--camera", options.camera, "position x y z, target x y z")
            ->expected(6);
        command->add_option("--fov", options.fovDegrees, "vertical, degrees")
            ->capture_default_str();
        for (auto [name, value] :
             {std::pair("--width", &options.width), std::pair("--height", &options.height)})
            command->add_option(name, *value)->check(CLI::Range(1, 16384))->capture_default_str();
        command->add_option("--rays", options.settings.rays, "per pixel")->capture_default_str();
        command->add_option("--radius", options.settings.radius, "metres")->capture_default_str();
        command->add_option("--integral", options.integral)
            ->check(CLI::IsMember(integralNames()))
            ->capture_default_str();
    }
    CLI11_PARSE(app, argc, argv);
    const std::vector<std::string>& names = integralNames();
    options.settings.integral = static_cast<Integral>(
        std::find(names.begin(), names.end(), options.integral) - names.begin());
    return ray->parsed() ? rays(options) : normals(options);
}

} // namespace

int main(int argc, char** argv) { return obscura::runProgram("obscura-bench", run, argc, argv); }
