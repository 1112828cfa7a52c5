#include "base/arguments.h"
#include "base/progress.h"
#include "bench/commands.h"
#include "bench/measure/machine.h"
#include "bench/measure/measured_view.h"
#include "bench/motion/temporal_tests.h"
#include "bench/stability/stability.h"
#include "gl/context.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

namespace obscura {

namespace {

struct Options {
    StabilityOptions stability;
    std::string device;
    bool quick = false, pageOnly = false;
    std::string scene = "atrium";
    std::filesystem::path scenes;
    std::vector<std::string> tests; // empty: all
    std::vector<double> camera{7.6, 1.2, -0.9, -4, 2.4, 1.2};
    double fovDegrees = 60, radius = 0.5;
    int frames = 0;

    TemporalEffort effort() const {
        TemporalEffort effort = quick ? quickTemporalEffort() : fullTemporalEffort();
        effort.frames = frames > 0 ? frames : effort.frames;
        return effort;
    }
};

std::vector<std::string> motionTestIds() {
    std::vector<std::string> ids;
    for (const TemporalTest& row : temporalTests())
        ids.emplace_back(row.test.id);
    return ids;
}

// Those of `all` that were asked for; all of them unless any were.
std::vector<std::string> asked(std::vector<std::string> all,
                               const std::vector<std::string>& tests) {
    std::erase_if(all, [&](const std::string& id) {
        return !tests.empty() && std::find(tests.begin(), tests.end(), id) == tests.end();
    });
    return all;
}

// All that decides the numbers besides tests and configurations.
std::string aboutOf(const Options& options, const gl::Driver& driver) {
    nlohmann::ordered_json about;
    about["formatVersion"] = 1;
    about["program"] = programName();
    about["renderer"] = driver.renderer;
    about["glVersion"] = driver.version;
    about["size"] =
        fmt::format("{} x {}", options.stability.size.width, options.stability.size.height);
    const TemporalEffort effort = options.effort();
    SceneHashes hashes({options.scenes, {}});
    about["motion"] = {
        {"scene", options.scene},   {"sceneSha256", hashes.of(viewOfScene(options.scene))},
        {"camera", options.camera}, {"fov", options.fovDegrees},
        {"radius", options.radius}, {"frames", effort.frames},
        {"rays", effort.rays},      {"size", fmt::format("{} x {}", effort.width, effort.height)}};
    return about.dump(2) + "\n";
}

Motion motionOf(const Options& options) {
    View view = viewOfScene(options.scene);
    const std::vector<double>& c = options.camera;
    view.camera.position = {c[0], c[1], c[2]};
    view.camera.target = {c[3], c[4], c[5]};
    view.camera.fovDegrees = options.fovDegrees;
    return {loadSceneOf(view, {options.scenes, {}}), view.camera, options.radius, options.effort()};
}

int run(Options options) {
    StabilityOptions& stability = options.stability;
    if (options.pageOnly) {
        writeStabilityPage(stability.folder);
        return 0;
    }
    const gl::Context context(options.device);
    if (options.quick)
        stability.size.height = 108;
    stability.size.height += stability.size.height % 2;
    stability.size.width = stability.size.height * 8 / 9 * 2;
    if (stability.configurations.empty())
        stability.configurations = screenTechniques();
    stability.tests = asked(stillTestIds(), options.tests);
    stability.motion = motionOf(options);
    if (!options.tests.empty())
        stability.motion->effort.tests = asked(motionTestIds(), options.tests);
    if (stability.motion->effort.tests.empty())
        stability.motion.reset();
    stability.about = aboutOf(options, context.driver());
    Progress progress("stability", 1);
    runStability(stability,
                 [&](double done, const std::string& note) { progress.update(done, note); });
    progress.update(1);
    fmt::print("{}\n", (stability.folder / "stability.html").string());
    return 0;
}

} // namespace

std::vector<Command> stabilityCommands(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    StabilityOptions& stability = options->stability;
    stability.folder = "stability";
    CLI::App* command = app.add_subcommand("stability", "where techniques fail");
    command
        ->add_option("--out", stability.folder,
                     "result folder; processes of the same command, on any machines that see it, "
                     "share the work")
        ->capture_default_str();
    command->add_option("--technique", stability.configurations,
                        "id, or \"id setting=value ...\"; may be repeated; default: all");
    std::vector<std::string> tests = stillTestIds();
    for (std::string& id : motionTestIds())
        tests.push_back(std::move(id));
    command->add_option("--test", options->tests, "only this one; may be repeated; default: all")
        ->check(CLI::IsMember(tests));
    command->add_option("--height", stability.size.height, "lines of the tests' images")
        ->check(CLI::Range(72, 2160))
        ->capture_default_str();
    command->add_flag("--quick", options->quick, "smaller images, fewer frames and paths");
    const char* scenes = std::getenv("OBSCURA_SCENES");
    options->scenes = scenes ? scenes : ".";
    command
        ->add_option("--scene", options->scene,
                     "built-in scene or file in the scenes folder, for tests in motion")
        ->capture_default_str();
    command->add_option("--scenes", options->scenes, "scenes folder; default OBSCURA_SCENES");
    command->add_option("--camera", options->camera, "where paths start: position, target")
        ->expected(6)
        ->check(numberFrom(-1e9, 1e9));
    command->add_option("--fov", options->fovDegrees, "vertical, degrees")
        ->check(numberFrom(1, 170))
        ->capture_default_str();
    command->add_option("--radius", options->radius, "of tests in motion, metres")
        ->check(numberFrom(1e-4, 1e4))
        ->capture_default_str();
    command->add_option("--frames", options->frames, "of each path; default 60, quick 12")
        ->check(CLI::Range(3, 100000));
    command->add_flag("--page", options->pageOnly, "only make the page anew from the folder's CSV");
    command->add_option("--device", options->device, "as obscura-render --devices lists it");
    return {{command, [options] { return run(*options); }}};
}

} // namespace obscura
