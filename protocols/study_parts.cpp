#include "protocols/study_parts.h"

#include "protocols/files.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace obscura {

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
    camera.near = table.number("near", 1e-4, 1e3, camera.near);
    table.finish();

    const Vec3 &p = camera.position, &t = camera.target, &u = camera.up;
    const Vec3 d{t[0] - p[0], t[1] - p[1], t[2] - p[2]};
    const double sine =
        std::hypot(d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0]);
    if (!(sine > 1e-6 * std::hypot(d[0], d[1], d[2])))
        throw Error(table.place(), "expected a target apart from the position and a view direction "
                                   "that is not along \"up\"");
    return camera;
}

// The techniques of one file, `root` being its whole. A name that is taken is an error that says
// where it was given first.
void addTechniques(TomlTable& root, std::vector<TechniqueSetting>& techniques) {
    for (auto& [name, table] : root.tables("techniques", "at least one technique, "
                                                         "[techniques.NAME]")) {
        const Place place = table.place();
        for (const TechniqueSetting& other : techniques)
            if (other.name == name)
                throw Error(place, fmt::format("expected a new name, found \"{}\", which {}:{} has "
                                               "given already",
                                               name, other.place.file, other.place.line));
        techniques.push_back(parseTechnique(name, std::move(table)));
    }
}

// A file of techniques alone; gives its text's hash.
std::string includeFile(const PlacedText& included, const std::filesystem::path& folder,
                        std::vector<TechniqueSetting>& techniques) {
    const std::string file = (folder / included.text).string();
    std::string text;
    try {
        text = readFile(file);
    } catch (const Error& error) {
        throw Error(included.place, error.what());
    }
    const toml::table table = parseToml(text, file);
    TomlTable root(table, file, "");
    addTechniques(root, techniques);
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
    table.finish();
    return view;
}

// Which settings exist, and their ranges, the renderer's technique table knows; here they must be
// numbers, or true and false for 1 and 0.
TechniqueSetting parseTechnique(const std::string& name, TomlTable table) {
    TechniqueSetting setting;
    setting.name = name;
    setting.place = table.place();
    setting.technique = table.text("technique");
    if (table.has("preset"))
        setting.preset = {table.text("preset"), table.placeOf("preset")};
    for (const auto& [key, value] : table.raw()) {
        if (key.str() == "technique" || key.str() == "preset")
            continue;
        const std::string keyName(key.str());
        if (!value.is_number() && !value.is_boolean())
            throw Error(
                table.placeOf(value, table.pathOf(keyName)),
                fmt::format("expected a number, true or false, found {}", TomlTable::spell(value)));
        const double number =
            value.is_boolean() ? (*value.value<bool>() ? 1.0 : 0.0) : *value.value<double>();
        setting.settings.push_back({keyName, number, table.placeOf(keyName)});
    }
    return setting;
}

Techniques parseTechniques(TomlTable& root) {
    Techniques result;
    const auto folder = std::filesystem::path(root.place().file).parent_path();
    for (const PlacedText& included : root.texts("include", "names of files with techniques"))
        result.includedSha256 += includeFile(included, folder, result.techniques);
    if (root.has("techniques") || result.techniques.empty())
        addTechniques(root, result.techniques);
    return result;
}

std::string studySha256(const std::string& text, const std::string& includedSha256) {
    return sha256(text + includedSha256);
}

Normals parseNormals(TomlTable& root) {
    return static_cast<Normals>(
        root.choice("normals", normalsNames(), static_cast<std::size_t>(Normals::smooth)));
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
