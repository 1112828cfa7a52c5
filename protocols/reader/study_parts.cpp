#include "protocols/reader/study_parts.h"

#include "base/files.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace obscura {

std::string faultOf(const Camera& camera) {
    const Vec3 &p = camera.position, &t = camera.target, &u = camera.up;
    const Vec3 d{t[0] - p[0], t[1] - p[1], t[2] - p[2]};
    const double length = std::hypot(d[0], d[1], d[2]);
    const double sine =
        std::hypot(d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0]);
    if (!std::isfinite(length) || !(sine > 1e-6 * length))
        return "expected a target apart from the position and a view direction that is not along "
               "\"up\"";
    if (!(camera.fovDegrees > 0 && camera.fovDegrees < 180))
        return fmt::format("expected a field of view between 0 and 180 degrees, found {}",
                           camera.fovDegrees);
    return {};
}

namespace {

// Scene coordinates: more than a million metres is a mistyped number.
constexpr double farAway = 1e6;

bool lowerCaseName(const std::string& name, std::string_view alsoAllowed) {
    return std::all_of(name.begin(), name.end(), [&](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
               alsoAllowed.find(c) != std::string_view::npos;
    });
}

Camera parseCamera(TomlTable table) {
    Camera camera;
    camera.position = table.triple("position", -farAway, farAway);
    camera.target = table.triple("target", -farAway, farAway);
    camera.up = table.triple("up", -1, 1, camera.up);
    camera.fovDegrees = table.number("fovDegrees", 1, 120, camera.fovDegrees);
    camera.near = table.number("near", 1e-7, 1e3, camera.near);
    table.finish();

    if (const std::string fault = faultOf(camera); !fault.empty())
        throw Error(table.place(), fault);
    return camera;
}

// Adds the techniques of one file, whose top table is `root`. A name that is taken already is an
// Error that says where it was given first.
void addTechniques(TomlTable& root, std::vector<TechniqueSetting>& techniques, Lists lists) {
    for (auto& [name, table] : root.tables("techniques", "at least one technique, "
                                                         "[techniques.NAME]")) {
        const Place place = table.place();
        const auto added = lists == Lists::varied
                               ? parseVariants(name, std::move(table))
                               : std::vector{parseTechnique(name, std::move(table))};
        for (const TechniqueSetting& other : techniques)
            if (other.name == added.front().name)
                throw Error(place, fmt::format("expected a new name, found \"{}\", which {}:{} has "
                                               "given already",
                                               name, other.place.file, other.place.line));
        techniques.insert(techniques.end(), added.begin(), added.end());
    }
}

// Reads a file of techniques alone and returns the hash of its text.
std::string includeFile(const PlacedText& included, const std::filesystem::path& folder,
                        std::vector<TechniqueSetting>& techniques, Lists lists) {
    const std::string file = (folder / included.text).string();
    if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file))
        throw Error(included.place, fmt::format("expected a file, found something else: {}", file));
    std::string text;
    try {
        text = readFile(file);
    } catch (const Error& error) {
        throw Error(included.place, error.what());
    }
    const toml::table table = parseToml(text, file);
    TomlTable root(table, file, "");
    addTechniques(root, techniques, lists);
    root.finish();
    return sha256(text);
}

} // namespace

void checkName(const TomlTable& table, std::string_view key, const std::string& name,
               std::string_view alsoAllowed, std::string_view spelt) {
    if (!lowerCaseName(name, alsoAllowed))
        throw Error(table.placeOf(key), fmt::format("expected lower-case letters, digits{}, "
                                                    "found \"{}\"",
                                                    spelt, name));
}

namespace {

Ground parseGround(TomlTable table) {
    Ground ground;
    ground.wall = table.number("wall", -1e6, 1e6);
    ground.colour = table.triple("colour", 0, 1, ground.colour);
    table.finish();
    return ground;
}

} // namespace

View parseView(const std::string& name, TomlTable table, bool withRadius) {
    View view;
    view.name = name;
    view.place = table.place();
    const bool file = table.has("file"), builtin = table.has("builtin");
    if (file == builtin)
        throw Error(view.place, fmt::format("expected either \"file\" (glTF, in the scenes folder) "
                                            "or \"builtin\", found {}",
                                            file ? "both" : "neither"));
    (file ? view.file : view.builtin) = table.text(file ? "file" : "builtin");
    view.camera = parseCamera(table.requiredTable("camera", "a camera"));
    if (withRadius)
        view.radius = table.number("radius", lowestRadius, highestRadius);
    view.exposure = table.number("exposure", -20, 20, view.exposure);
    if (auto ground = table.table("ground"))
        view.ground = parseGround(std::move(*ground));
    table.finish();
    return view;
}

namespace {

// Gives the setting one value of a key, which may come from a list.
void give(TechniqueSetting& setting, const TomlTable& table, const std::string& key,
          const toml::node& value) {
    const Place place = table.placeOf(value, table.pathOf(key));
    if (key == "preset") {
        if (!value.is_string())
            throw Error(
                place, fmt::format("expected a text in quotes, found {}", TomlTable::spell(value)));
        setting.preset = {*value.value<std::string>(), place};
        return;
    }
    if (!value.is_number() && !value.is_boolean())
        throw Error(place, fmt::format("expected a number, true or false, found {}",
                                       TomlTable::spell(value)));
    const double number =
        value.is_boolean() ? (*value.value<bool>() ? 1.0 : 0.0) : *value.value<double>();
    setting.settings.push_back({key, number, table.placeOf(key)});
}

// Every combination of one of `settings` with one value of a list.
std::vector<TechniqueSetting> varied(const std::vector<TechniqueSetting>& settings,
                                     const TomlTable& table, const std::string& key,
                                     const toml::array& values) {
    if (values.empty())
        throw Error(table.placeOf(values, table.pathOf(key)),
                    "expected at least one value in the list, found none");
    std::vector<TechniqueSetting> result;
    for (const TechniqueSetting& setting : settings)
        for (const toml::node& value : values) {
            result.push_back(setting);
            give(result.back(), table, key, value);
            result.back().name +=
                key == "preset" ? fmt::format(" {}", result.back().preset->name)
                                : fmt::format(" {}={:g}", key, result.back().settings.back().value);
        }
    return result;
}

} // namespace

TechniqueSetting parseTechnique(const std::string& name, TomlTable table) {
    TechniqueSetting setting{name, table.text("technique"), {}, table.place()};
    for (const auto& [key, value] : table.raw())
        if (key.str() != "technique")
            give(setting, table, std::string(key.str()), value);
    return setting;
}

std::vector<TechniqueSetting> parseVariants(const std::string& name, TomlTable table) {
    std::vector<TechniqueSetting> settings{{name, table.text("technique"), {}, table.place()}};
    for (const auto& [key, value] : table.raw()) {
        if (key.str() == "technique")
            continue;
        const std::string keyName(key.str());
        if (const toml::array* values = value.as_array())
            settings = varied(settings, table, keyName, *values);
        else
            for (TechniqueSetting& setting : settings)
                give(setting, table, keyName, value);
    }
    return settings;
}

Techniques parseTechniques(TomlTable& root, Lists lists) {
    Techniques result;
    const auto folder = std::filesystem::path(root.place().file).parent_path();
    for (const PlacedText& included : root.texts("include", "names of files with techniques")) {
        result.includedSha256 += includeFile(included, folder, result.techniques, lists);
        result.includes.push_back(included.text);
    }
    if (root.has("techniques") || result.techniques.empty())
        addTechniques(root, result.techniques, lists);
    return result;
}

std::string studySha256(const std::string& text, const std::string& includedSha256) {
    return sha256(text + includedSha256);
}

Normals parseNormals(TomlTable& root) {
    return static_cast<Normals>(
        root.choice("normals", normalsNames(), static_cast<std::size_t>(Normals::smooth)));
}

const std::vector<std::string>& curveNames() {
    static const std::vector<std::string> names{"clamp", "reinhard", "aces", "neutral"};
    return names;
}

const std::vector<std::string>& normalsNames() {
    static const std::vector<std::string> names{"face", "smooth", "mapped"};
    return names;
}

toml::table parseToml(const std::string& text, const std::string& file) {
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        throw Error({file, static_cast<int>(at.line), static_cast<int>(at.column), {}},
                    fmt::format("expected TOML: {}", error.description()));
    }
}

} // namespace obscura
