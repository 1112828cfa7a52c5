#include "viewer/command_line.h"

#include "base/arguments.h"
#include "base/error.h"
#include "protocols/reader/protocol.h"
#include "protocols/reader/protocol_argument.h"
#include "renderer/builtin/builtin.h"
#include "renderer/levels.h"
#include "viewer/technique_words.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// As typed.
struct Options {
    CommandLine line;
    std::string scene, techniques, layout, show, level, condition, size, normals;
    std::vector<double> camera;
    double fovDegrees = 50, near = 0, radius = 0;
    std::optional<double> exposure;
};

template <typename Names>
std::size_t indexIn(const Names& names, const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// A built-in scene's name, or a file: in the working folder or else in the scenes folder.
SceneChoice sceneIn(const std::string& text, const fs::path& scenes) {
    const auto builtins = builtinSceneNames();
    if (std::find(builtins.begin(), builtins.end(), text) != builtins.end())
        return {"", text, {}};
    for (const fs::path& file : {fs::path(text), scenes / text})
        if (fs::exists(file))
            return {file.string(), "", {}};
    throw Error(fmt::format("expected a glTF file, here or in the scenes folder {}, or a built-in "
                            "scene ({}), found \"{}\"",
                            scenes.string(), fmt::join(builtins, ", "), text));
}

std::vector<std::string> splitAt(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

// Names of the protocol's techniques, or "gtao high slices=6".
std::vector<TechniqueSetting> techniquesIn(const std::string& text, const Protocol* protocol) {
    std::vector<TechniqueSetting> techniques;
    for (const std::string& words : splitAt(text, ',')) {
        const TechniqueSetting* known = nullptr;
        for (const TechniqueSetting& each : protocol ? protocol->techniques : techniques)
            if (protocol && each.name == words)
                known = &each;
        techniques.push_back(known ? *known : techniqueIn(words));
    }
    return techniques;
}

const Condition& conditionOf(const Protocol& protocol, const std::string& id) {
    std::vector<std::string> ids;
    for (const Condition& condition : protocol.conditions) {
        if (id.empty() || condition.id == id)
            return condition;
        ids.push_back(condition.id);
    }
    throw Error(fmt::format("{} has no condition \"{}\"{}", protocol.path.string(), id,
                            suggestion(id, ids)));
}

bool showsSameScene(const View& a, const View& b) {
    return a.file == b.file && a.builtin == b.builtin && a.ground == b.ground;
}

// All that the condition says. In a test, every technique of the protocol and, where no condition
// is named, every view.
void takeProtocol(const Protocol& protocol, const Options& options, CommandLine& line) {
    const Condition& condition = conditionOf(protocol, options.condition);
    const View& view = protocol.view(condition.view);
    line.scene =
        view.file.empty() ? SceneChoice{"", view.builtin, {}} : sceneIn(view.file, line.scenes);
    line.scene.ground = view.ground;
    line.camera = view.camera;
    line.radius = view.radius;
    line.exposure = view.exposure;
    line.level = protocol.level(condition.level);
    if (!line.level.environment.empty())
        line.level.environment = (protocol.path.parent_path() / line.level.environment).string();
    line.normals = protocol.normals;
    for (const View& each : protocol.views)
        if (showsSameScene(each, view) || (line.test && options.condition.empty()))
            line.views.push_back(each);
    if (line.test) {
        line.techniques = protocol.techniques;
        std::erase_if(line.techniques, [](const TechniqueSetting& each) {
            return technique(each.technique).reads & rays;
        });
        return;
    }
    for (const Role& role : condition.roles)
        if (line.techniques.size() < 4)
            line.techniques.push_back(protocol.technique(role.technique));
}

Level levelIn(const std::string& name, const Protocol* protocol) {
    for (const Level& each : protocol ? protocol->levels : std::vector<Level>())
        if (each.name == name) {
            Level level = each;
            if (!level.environment.empty())
                level.environment = (protocol->path.parent_path() / level.environment).string();
            return level;
        }
    return levelNamed(name);
}

// Camera, radius and exposure, where they are typed.
void takeView(const Options& options, CommandLine& line) {
    if (options.camera.size() == 6) {
        const auto& c = options.camera;
        line.camera = Camera{
            {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {0, 1, 0}, options.fovDegrees, options.near};
        if (const std::string fault = faultOf(*line.camera); !fault.empty())
            throw Error("--camera: " + fault);
        line.views.clear();
    }
    if (options.radius > 0)
        line.radius = options.radius;
    if (options.exposure)
        line.exposure = *options.exposure;
    for (View& view : line.views) {
        view.radius = options.radius > 0 ? options.radius : view.radius;
        view.exposure = options.exposure.value_or(view.exposure);
    }
}

void takeSize(const std::string& text, CommandLine& line) {
    const auto size = parsePair(text, 'x');
    if (!size || std::min(size->first, size->second) < 16 ||
        std::max(size->first, size->second) > 8192)
        throw Error(
            fmt::format("expected --size WIDTHxHEIGHT, each 16 ... 8192, found \"{}\"", text));
    line.width = size->first;
    line.height = size->second;
}

CommandLine resolved(const Options& options) {
    CommandLine line = options.line;
    std::optional<Protocol> protocol;
    line.scene = sceneIn("atrium", line.scenes);
    line.level = levelNamed("moderate");
    if (!line.protocol.empty()) {
        protocol = readProtocol(line.protocol);
        takeProtocol(*protocol, options, line);
    }
    const Protocol* given = protocol ? &*protocol : nullptr;
    if (!options.scene.empty()) {
        line.scene = sceneIn(options.scene, line.scenes);
        line.camera.reset();
        line.radius.reset();
        line.views.clear();
    }
    if (!options.techniques.empty())
        line.techniques = techniquesIn(options.techniques, given);
    if (!options.level.empty())
        line.level = levelIn(options.level, given);
    if (!options.normals.empty())
        line.normals = static_cast<Normals>(indexIn(normalsNames(), options.normals));
    takeView(options, line);
    if (!options.size.empty())
        takeSize(options.size, line);
    if (!options.layout.empty())
        line.layout = static_cast<Layout>(indexIn(layoutNames(), options.layout));
    if (!options.show.empty())
        line.show = static_cast<Show>(indexIn(showNames(), options.show));
    if (line.techniques.empty())
        line.techniques = techniquesIn(line.test ? "starcraft,hbao,alchemy,none" : "none,gtao", {});
    if (!line.test && line.techniques.size() > 4)
        throw Error(fmt::format("expected one to four --techniques, one for each pane, found {}",
                                line.techniques.size()));
    return line;
}

void addWhat(CLI::App& app, Options& options) {
    CommandLine& line = options.line;
    app.add_option("scene", options.scene,
                   "glTF file, here or in the scenes folder, or a built-in scene; default atrium");
    app.add_option("--scenes", line.scenes, "scenes folder; default OBSCURA_SCENES");
    takesProtocol(app.add_option("--protocol", line.protocol,
                                 "a study: its scene, camera, light and techniques are shown"));
    app.add_option("--condition", options.condition, "of the protocol; default its first")
        ->needs("--protocol");
    app.add_option(
        "--techniques", options.techniques,
        "one to four (in a test any number) of obscura-render --list, each with a preset "
        "or settings: \"none,gtao high,starcraft samples=8\"; or names of the protocol's");
    app.add_option("--level", options.level,
                   "light: low, moderate, high, or one of the protocol's");
    app.add_option("--normals", options.normals, "that techniques work with")
        ->check(CLI::IsMember(normalsNames()));
    app.add_option("--camera", options.camera, "position x y z, target x y z; default: found")
        ->expected(6)
        ->check(numberFrom(-1e9, 1e9));
    app.add_option("--fov", options.fovDegrees, "of --camera, vertical, degrees")
        ->check(numberFrom(1, 170));
    app.add_option("--near", options.near,
                   "of --camera, metres; default: as the scene's size has it")
        ->check(numberFrom(1e-7, 1e3));
    app.add_option("--radius", options.radius,
                   "how far occlusion reaches, metres; default: one that suits the scene")
        ->check(numberFrom(1e-4, 1e4));
    app.add_option("--exposure", options.exposure, "stops")->check(numberFrom(-20, 20));
    app.add_flag_callback(
        "--no-textures", [&line] { line.textures = false; }, "everything white and matte");
    app.add_option("--size", options.size,
                   "WIDTHxHEIGHT of the window, or of a test's pictures; default 1280x720");
    app.add_option("--device", line.device, "of a test: one of obscura-render --devices");
}

void addWindow(CLI::App& app, Options& options) {
    CommandLine& line = options.line;
    app.add_option("--layout", options.layout, "how pictures are put beside each other")
        ->check(CLI::IsMember(layoutNames()));
    app.add_option("--show", options.show, "of each technique")->check(CLI::IsMember(showNames()));
    app.add_flag("--reference", line.reference, "trace the reference");
    app.add_option("--rays", line.rays, "a pixel, that --picture waits for")
        ->check(CLI::Range(1, 1 << 16))
        ->capture_default_str();
    app.add_option("--render-scale", line.renderScale, "pixels drawn for each of the screen's")
        ->check(numberFrom(0.1, 2));
    app.add_option("--ui-scale", line.uiScale, "of letters and panels; default: the screen's")
        ->check(numberFrom(0.5, 4));
    app.add_option("--tab", line.tab, "the panel that is open")->check(CLI::IsMember(tabNames()));
    app.add_flag_callback(
        "--no-panels", [&line] { line.panels = false; }, "the pictures alone");
    app.add_flag("--keys", line.help, "with the keys on the screen");
    app.add_option("--picture", line.picture,
                   "save the window as PNG when everything is drawn, and end");
    app.add_flag("--times", line.times, "print the longest frame at the end");
}

void addTest(CLI::App& app, Options& options) {
    CommandLine& line = options.line;
    app.add_flag("--test", line.test,
                 "no window: frames per second of every technique from every camera, to files");
    app.add_option("--cameras", line.cameras,
                   "of a test: how many are found in the scene, where neither protocol, --camera, "
                   "stored views nor the file say which")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    app.add_option("--seconds", line.seconds, "of a test: for each technique, camera and round")
        ->check(numberFrom(0, 3600))
        ->capture_default_str();
    app.add_option("--rounds", line.rounds, "of a test")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_option("--seed", line.seed, "of a test's orders and found cameras")
        ->capture_default_str();
    app.add_option("--out", line.out, "of a test: folder of its results")->capture_default_str();
}

} // namespace

const std::vector<std::string>& tabNames() {
    static const std::vector<std::string> names{"techniques", "view", "measure", "study"};
    return names;
}

CommandLine parseCommandLine(CLI::App& app, int argc, char** argv) {
    Options options;
    const char* scenes = std::getenv("OBSCURA_SCENES");
    options.line.scenes = scenes ? scenes : ".";
    addWhat(app, options);
    addWindow(app, options);
    addTest(app, options);
    app.parse(argc, argv);
    return resolved(options);
}

} // namespace obscura
