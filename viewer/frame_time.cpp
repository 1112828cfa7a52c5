// What a picture of the viewer takes while the camera moves, by its parts: obscura-frame-time SCENE
// TECHNIQUE [WIDTH HEIGHT [SETTING=VALUE ...]].
#include "gl/context.h"
#include "viewer/worker.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <semaphore>

namespace {

using namespace obscura;

constexpr int frames = 40;

Level sunAndSky() { // obscura-render's "high"
    Level level;
    level.sky = Sky{};
    level.sun = Sun{62, 66, {4, 3.8, 3.4}};
    return level;
}

Wanted wishOf(const Opened& opened, int argc, char** argv) {
    Wanted wanted;
    wanted.scene = opened.id;
    wanted.view.camera = opened.camera;
    wanted.view.radius = opened.radius;
    wanted.level = sunAndSky();
    wanted.width = argc > 4 ? std::atoi(argv[3]) : 1280;
    wanted.height = argc > 4 ? std::atoi(argv[4]) : 720;
    TechniqueSetting setting;
    setting.technique = argv[2];
    for (int i = 5; i < argc; ++i) {
        const std::string text = argv[i];
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos)
            throw Error(fmt::format("expected SETTING=VALUE, found \"{}\"", text));
        setting.settings.push_back(
            {text.substr(0, equals), std::atof(text.c_str() + equals + 1), {}});
    }
    wanted.panes.push_back(settingsOf(setting, opened.radius));
    return wanted;
}

// To the side, so that every pixel changes.
void move(Camera& camera, int frame) {
    const double step = 0.002 * std::hypot(camera.target[0] - camera.position[0],
                                           camera.target[2] - camera.position[2]);
    camera.position[0] += step * std::cos(frame * 0.1);
    camera.position[2] += step * std::sin(frame * 0.1);
}

int run(int argc, char** argv) {
    if (argc < 3)
        throw Error("expected SCENE TECHNIQUE [WIDTH HEIGHT [SETTING=VALUE ...]]");
    std::counting_semaphore<> told(0);
    Worker worker([]() -> std::shared_ptr<void> { return std::make_shared<gl::Context>(); },
                  [&] { told.release(); });
    const std::string scene = argv[1];
    const bool file = scene.find('.') != std::string::npos;
    worker.open({file ? scene : "", file ? "" : scene, {}});
    worker.waitUntilDrawn(600);
    const auto opened = worker.opened();
    if (!opened)
        throw Error(worker.status().error);
    fmt::print("{}: {} triangles, open after {:.1f} s. {}\n", scene, opened->triangles,
               opened->seconds, opened->why);
    Wanted wanted = wishOf(*opened, argc, argv);
    worker.want(wanted); // compiles
    worker.waitUntilDrawn(600);
    if (!worker.newest())
        throw Error(worker.status().error);
    fmt::print("first picture after {:.0f} ms, compiled\n", worker.newest()->frameMs);
    std::map<std::string, double> sums;
    const std::clock_t before = std::clock();
    for (int i = 0; i < frames; ++i) {
        move(wanted.view.camera, i);
        worker.want(wanted);
        auto drawn = worker.newest();
        for (; !(drawn->wanted == wanted); drawn = worker.newest())
            told.acquire();
        sums["G-buffer"] += drawn->gbufferMs;
        sums["light"] += drawn->lightMs;
        for (const PassDrawn& pass : drawn->panes[0].passes)
            sums["technique: " + pass.name] += pass.ms;
        sums["composite and picture"] +=
            drawn->frameMs - drawn->gbufferMs - drawn->lightMs - drawn->panes[0].ms;
        sums["whole picture"] += drawn->frameMs;
        sums["from one to the next"] += drawn->intervalMs;
    }
    for (const auto& [name, sum] : sums)
        fmt::print("{:<28} {:8.2f} ms\n", name, sum / frames);
    fmt::print("{:<28} {:8.2f} ms\n", "of all processors together",
               1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC / frames);
    fmt::print("{:.1f} pictures a second\n", 1e3 * frames / sums["from one to the next"]);
    return 0;
}

} // namespace

int main(int argc, char** argv) { return runProgram("obscura-frame-time", run, argc, argv); }
