#include "base/arguments.h"
#include "base/program.h"
#include "base/progress.h"
#include "protocols/reader/protocol_argument.h"
#include "protocols/reader/study_text.h"
#include "renderer/builtin/builtin.h"
#include "renderer/compare.h"
#include "renderer/framing.h"
#include "renderer/levels.h"
#include "renderer/reference/reference_cache.h"
#include "renderer/render.h"
#include "renderer/techniques/document.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace {

using namespace obscura;
namespace fs = std::filesystem;

struct Options {
    bool devices = false, list = false, document = false, layers = false, frame = false;
    std::string device, scene = "atrium", techniqueId = "none", level = "moderate", scenes;
    std::string recipe, describe, preset, normals = "smooth";
    std::vector<std::string> settings;
    std::vector<double> camera;
    std::optional<double> near, radius;
    double fovDegrees = 50, exposure = 0;
    int width = 1280, height = 720, antialiasing = 4;
    int seed = 1;
    fs::path out = "render.png";
    fs::path protocol;
    std::string condition;
    int member = 0;
    fs::path reference, cache;
    std::string integral = "cosine";
    int rays = 256;
};

int printDevices() {
    bool any = false;
    for (const gl::Device& device : gl::devices()) {
        any |= device.problem.empty();
        if (device.problem.empty())
            fmt::print("{:<12} {} / {} / {}{}\n", device.name, device.driver.vendor,
                       device.driver.renderer, device.driver.version,
                       device.driver.software ? "  (software)" : "");
        else
            fmt::print("{:<12} cannot be used: {}\n", device.name, device.problem);
    }
    if (!any)
        gl::Context context; // throws, naming all that was tried
    return 0;
}

int printTechniques() {
    for (const Technique& row : techniques())
        fmt::print("{:<20} {}  [{}]\n", row.id, row.title, row.citation);
    return 0;
}

int printTechnique(const std::string& id) {
    const Technique& row = technique(id);
    fmt::print("{}: {}\n{}\n", row.id, row.title, row.citation);
    for (const Parameter& parameter : row.parameters)
        fmt::print("  {:<16} {:>8} {:<7} [{}, {}]  {}; {}\n", parameter.name, parameter.value,
                   spell(parameter.unit), parameter.low, parameter.high, parameter.meaning,
                   parameter.source);
    for (const Preset& preset : row.presets) {
        fmt::print("  preset {}:", preset.name);
        for (const PresetValue& given : preset.values)
            fmt::print(" {} = {}", given.name, given.value);
        fmt::print("\n");
    }
    return 0;
}

// The image that a protocol's condition shows.
Recipe recipeOfProtocol(const Options& options, SceneHashes& scenes, const gl::Driver& driver) {
    const Protocol protocol = readProtocol(options.protocol);
    std::vector<std::string> ids;
    for (const Condition& condition : protocol.conditions) {
        if (condition.id == options.condition)
            return makeRecipe(protocol, condition, options.member, scenes, driver);
        ids.push_back(condition.id);
    }
    throw Error(fmt::format("{} has no condition \"{}\"{}", options.protocol.string(),
                            options.condition, suggestion(options.condition, ids)));
}

// Camera and radius that suit the view's scene, unless the options say otherwise; and what to type
// for the same again.
void frame(View& view, const Options& options, const Folders& folders) {
    const Scene scene = loadSceneOf(view, folders);
    const Framing found = framing(scene, RayTracer(scene), static_cast<std::uint64_t>(options.seed),
                                  static_cast<double>(options.width) / options.height);
    view.camera = found.camera;
    view.camera.near = options.near.value_or(found.near);
    view.radius = options.radius.value_or(found.radius);
    const Camera& camera = view.camera;
    fmt::print("{}\ncamera = {}\nradius = {}\n--camera {} {} --fov {} --near {} --radius {}{}\n",
               found.why, toToml(camera), view.radius, fmt::join(camera.position, " "),
               fmt::join(camera.target, " "), camera.fovDegrees, camera.near, view.radius,
               camera.up == Camera().up ? "" : "  (these options have no \"up\")");
}

// One view put together on the command line.
Recipe recipeOfOptions(const Options& options, SceneHashes& scenes, const gl::Driver& driver) {
    if (options.camera.size() != 6 && !options.frame)
        throw Error("expected --camera with six numbers, position and target (--camera 0 2 8 0 1 "
                    "0), or --frame, which finds a view that shows the scene");
    Protocol protocol;
    protocol.seed = static_cast<std::uint64_t>(options.seed);
    protocol.width = options.width;
    protocol.height = options.height;
    protocol.antialiasing = options.antialiasing;
    protocol.normals = static_cast<Normals>(
        std::find(normalsNames().begin(), normalsNames().end(), options.normals) -
        normalsNames().begin());
    View view;
    view.name = options.scene;
    const auto builtins = builtinSceneNames();
    const bool builtin =
        std::find(builtins.begin(), builtins.end(), options.scene) != builtins.end();
    (builtin ? view.builtin : view.file) = options.scene;
    if (options.frame)
        frame(view, options, scenes.folders());
    else {
        const auto& c = options.camera;
        view.camera.position = {c[0], c[1], c[2]};
        view.camera.target = {c[3], c[4], c[5]};
        view.camera.fovDegrees = options.fovDegrees;
        view.camera.near = options.near.value_or(0);
        view.radius = options.radius.value_or(0.5);
    }
    view.exposure = options.exposure;
    protocol.views.push_back(view);
    protocol.levels.push_back(levelNamed(options.level));
    TechniqueSetting setting{"technique", options.techniqueId, {}, {}};
    if (!options.preset.empty())
        setting.preset = {options.preset, {}};
    for (const std::string& text : options.settings) {
        NamedNumber given = parseNamedNumber("--set", text);
        setting.settings.push_back({std::move(given.name), given.value, {}});
    }
    protocol.techniques.push_back(setting);
    Condition condition;
    condition.view = view.name;
    condition.level = options.level;
    condition.roles = {{"a", "technique"}};
    return makeRecipe(protocol, condition, 0, scenes, driver);
}

void writeLayers(const fs::path& out, const Rendering& rendering) {
    const auto beside = [&](const std::string& kind) {
        fs::path path = out;
        return path.replace_filename(out.stem().string() + "-" + kind + ".exr");
    };
    const std::vector<std::string> names{"R", "G", "B", "A"};
    writeExr(beside("ao"), rendering.visibility, std::array{std::string("V")}, true);
    for (const auto& [kind, image] : rendering.layers)
        writeExr(beside(kind), image,
                 std::span(names).first(static_cast<std::size_t>(image.channels)), kind == "depth");
}

Recipe recipeOf(const Options& options, SceneHashes& scenes, const gl::Driver& driver) {
    return options.protocol.empty() ? recipeOfOptions(options, scenes, driver)
                                    : recipeOfProtocol(options, scenes, driver);
}

int render(const Options& options) {
    const gl::Context context(options.device);
    const Folders folders{options.scenes, options.protocol.parent_path()};
    SceneHashes scenes(folders);
    const Recipe recipe = recipeOf(options, scenes, context.driver());
    RecipeRenderer renderer(folders);
    const Rendering rendering = renderer.render(recipe, options.layers);
    for (const std::string& warning : renderer.sceneWarnings())
        fmt::print(stderr, "warning: {}\n", warning);
    writePng(options.out, rendering.image);
    fs::path ao = options.out;
    ao.replace_filename(options.out.stem().string() + "-ao.png");
    writePng(ao, quantised(rendering.visibility));
    if (options.layers)
        writeLayers(options.out, rendering);
    const StageTimes& t = renderer.times();
    fmt::print("{} and {}: mean occlusion {:.4f}; seconds: scene {:.2f}, G-buffer {:.2f}, light "
               "{:.2f}, occlusion {:.2f}, composite {:.2f}, hash {:.2f}\n",
               options.out.string(), ao.string(), rendering.meanOcclusion, t.scene, t.gbuffer,
               t.light, t.occlusion, t.composite, t.hash);
    return 0;
}

// The ray-traced truth of one view: EXR, and its visibility as PNG beside it.
int traceReference(const Options& options) {
    const gl::Context context(options.device);
    const Folders folders{options.scenes, options.protocol.parent_path()};
    SceneHashes scenes(folders);
    const Recipe recipe = recipeOf(options, scenes, context.driver());
    const auto& names = integralNames();
    ReferenceInputs inputs{recipe.sceneSha256,
                           recipe.view.camera,
                           recipe.width,
                           recipe.height,
                           {0, 0},
                           recipe.normals,
                           {}};
    inputs.settings.integral = static_cast<Integral>(
        std::find(names.begin(), names.end(), options.integral) - names.begin());
    inputs.settings.radius = recipe.view.radius;
    inputs.settings.rays = options.rays;
    inputs.settings.seed = recipe.seed;
    const fs::path cache = options.cache.empty() ? defaultCache() : options.cache;
    bool kept = true;
    const Reference reference = cachedReference(cache, referenceKey(inputs), [&] {
        kept = false;
        const Scene scene = loadSceneOf(recipe.view, folders);
        Progress progress("tracing rays", 1);
        const Reference traced = traceView(RayTracer(scene), GpuScene(scene), GBufferPass(), inputs,
                                           [&](double share) { progress.update(share); });
        progress.update(1);
        return traced;
    });
    writeReference(options.reference, reference);
    fs::path preview = options.reference;
    writePng(preview.replace_extension(".png"), quantised(reference.visibility));
    fmt::print("{} and {}{}\n", options.reference.string(), preview.string(),
               kept ? fmt::format(": kept in {} since an earlier run", cache.string()) : "");
    return 0;
}

int run(CLI::App& app, int argc, char** argv) {
    Options options;
    const char* scenes = std::getenv("OBSCURA_SCENES");
    options.scenes = scenes ? scenes : ".";
    app.add_flag("--devices", options.devices, "list the devices that can render, and stop");
    app.add_flag("--list", options.list, "list the techniques, and stop");
    app.add_option("--describe", options.describe, "print a technique's settings, and stop");
    app.add_flag("--document", options.document, "print docs/techniques.md, and stop");
    app.add_option("--device", options.device, "render with this device of --devices");
    app.add_option("--scene", options.scene, "built-in scene or glTF file in the scenes folder")
        ->capture_default_str();
    app.add_option("--scenes", options.scenes, "scenes folder; default OBSCURA_SCENES");
    CLI::Option* camera = app.add_option("--camera", options.camera, "position x y z, target x y z")
                              ->expected(6)
                              ->check(numberFrom(-1e9, 1e9));
    CLI::Option* fov = app.add_option("--fov", options.fovDegrees, "vertical, degrees")
                           ->check(numberFrom(1, 170))
                           ->capture_default_str();
    app.add_flag("--frame", options.frame,
                 "instead of --camera: find a view that shows the scene, with near plane and "
                 "radius, and print it")
        ->excludes(camera)
        ->excludes(fov);
    app.add_option("--near", options.near,
                   "where the camera begins to see, metres; default: that of --frame, else 0.05, "
                   "or a twentieth of the diagonal of a smaller scene")
        ->check(numberFrom(1e-7, 1e3));
    app.add_option("--exposure", options.exposure, "stops")
        ->check(numberFrom(-32, 32))
        ->capture_default_str();
    app.add_option("--level", options.level, "low, moderate or high")
        ->check(CLI::IsMember(levelNames()))
        ->capture_default_str();
    app.add_option("--technique", options.techniqueId, "id of --list")->capture_default_str();
    app.add_option("--preset", options.preset, "a preset of --describe; --set overrides it");
    app.add_option("--set", options.settings, "NAME=NUMBER, a setting of --describe");
    app.add_option("--radius", options.radius, "metres; default: that of --frame, else 0.5")
        ->check(numberFrom(lowestRadius, highestRadius));
    app.add_option("--width", options.width)->check(CLI::Range(1, 16384))->capture_default_str();
    app.add_option("--height", options.height)->check(CLI::Range(1, 16384))->capture_default_str();
    app.add_option("--antialiasing", options.antialiasing, "jittered frames averaged")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    app.add_option("--normals", options.normals, "what occlusion works with: face, smooth, mapped")
        ->check(CLI::IsMember(normalsNames()))
        ->capture_default_str();
    app.add_option("--seed", options.seed)->capture_default_str();
    takesProtocol(app.add_option("--protocol", options.protocol,
                                 "take everything from a protocol's condition"))
        ->excludes("--frame");
    app.add_option("--condition", options.condition, "its id")->needs("--protocol");
    app.add_option("--member", options.member, "0 for a, 1 for b")->check(CLI::Range(0, 1));
    app.add_option("--out", options.out, "PNG; its visibility goes beside it")
        ->capture_default_str();
    app.add_flag("--layers", options.layers,
                 "write linear EXR of image, visibility and G-buffer too");
    app.add_option("--reference", options.reference,
                   "instead of an image, trace its true visibility by rays: EXR of visibility, "
                   "standard error and bent normal, and a PNG beside it");
    app.add_option("--integral", options.integral, "of --reference")
        ->check(CLI::IsMember(integralNames()))
        ->capture_default_str();
    app.add_option("--rays", options.rays, "of --reference, per pixel; a power of two")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    app.add_option("--cache", options.cache,
                   "folder that keeps references; default OBSCURA_CACHE, else ~/.cache/obscura");
    const std::function<int()> compare = addCompare(app);
    app.parse(argc, argv);
    if (app.got_subcommand("compare"))
        return compare();
    if (options.devices)
        return printDevices();
    if (options.list)
        return printTechniques();
    if (options.document) {
        fmt::print("{}", techniquesDocument());
        return 0;
    }
    if (!options.describe.empty())
        return printTechnique(options.describe);
    return options.reference.empty() ? render(options) : traceReference(options);
}

} // namespace

int main(int argc, char** argv) {
    return obscura::runProgram("obscura-render", "one image, or what there is to render with", run,
                               argc, argv);
}
