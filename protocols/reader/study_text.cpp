#include "protocols/reader/study_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace obscura {

namespace {

std::string floatNumber(double value) {
    const auto narrow = static_cast<float>(value);
    return static_cast<double>(narrow) == value ? fmt::format("{}", narrow) : tomlNumber(value);
}

TomlFields fieldsOf(const Ground& ground) {
    return {{"wall", tomlNumber(ground.wall)}, {"colour", tomlTriple(ground.colour)}};
}

TomlFields fieldsOf(const Sky& sky) {
    return {{"zenith", tomlTriple(sky.zenith)},
            {"horizon", tomlTriple(sky.horizon)},
            {"ground", tomlTriple(sky.ground)}};
}

TomlFields fieldsOf(const Sun& sun) {
    return {{"azimuthDegrees", tomlNumber(sun.azimuthDegrees)},
            {"elevationDegrees", tomlNumber(sun.elevationDegrees)},
            {"irradiance", tomlTriple(sun.irradiance)}};
}

} // namespace

std::string toToml(const Camera& camera) {
    TomlFields fields{{"position", tomlTriple(camera.position)},
                      {"target", tomlTriple(camera.target)}};
    if (camera.up != Camera().up)
        fields.emplace_back("up", tomlTriple(camera.up));
    fields.emplace_back("fovDegrees", tomlNumber(camera.fovDegrees));
    if (camera.near > 0)
        fields.emplace_back("near", tomlNumber(camera.near));
    return tomlInline(fields);
}

// Bindings name all members, so that a new one does not compile before it is written.
TomlFields fieldsOf(const View& view) {
    const auto& [name, file, builtin, camera, radius, exposure, ground, place] = view;
    TomlFields fields{file.empty() ? std::pair{std::string("builtin"), tomlText(builtin)}
                                   : std::pair{std::string("file"), tomlText(file)},
                      {"camera", toToml(camera)}};
    if (radius > 0)
        fields.emplace_back("radius", tomlNumber(radius));
    if (exposure != 0)
        fields.emplace_back("exposure", tomlNumber(exposure));
    if (ground)
        fields.emplace_back("ground", tomlInline(fieldsOf(*ground)));
    return fields;
}

TomlFields fieldsOf(const Level& level) {
    const auto& [name, ambient, background, sky, environment, sun, sceneLights, curve, white,
                 occludeDirect, place] = level;
    TomlFields fields;
    if (ambient) {
        fields.emplace_back("ambient", tomlTriple(*ambient));
        fields.emplace_back("background", tomlTriple(background));
    } else if (sky) {
        fields.emplace_back("sky", tomlInline(fieldsOf(*sky)));
    } else {
        fields.emplace_back("environment", tomlText(environment));
    }
    if (sun)
        fields.emplace_back("sun", tomlInline(fieldsOf(*sun)));
    if (sceneLights)
        fields.emplace_back("sceneLights", "true");
    if (curve != (ambient ? Curve::clamp : Curve::reinhard))
        fields.emplace_back("curve", tomlText(curveNames()[static_cast<std::size_t>(curve)]));
    if (white != Level().white)
        fields.emplace_back("white", tomlNumber(white));
    if (occludeDirect)
        fields.emplace_back("occludeDirect", "true");
    return fields;
}

TomlFields fieldsOf(const TechniqueSetting& technique, const std::vector<std::string>& flags) {
    TomlFields fields{{"technique", tomlText(technique.technique)}};
    if (technique.preset)
        fields.emplace_back("preset", tomlText(technique.preset->name));
    for (const Setting& setting : technique.settings) {
        const bool flag = std::find(flags.begin(), flags.end(), setting.name) != flags.end();
        fields.emplace_back(setting.name, flag ? (setting.value != 0 ? "true" : "false")
                                               : floatNumber(setting.value));
    }
    return fields;
}

std::string tomlText(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text)
        if (c == '"' || c == '\\')
            quoted += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            quoted += c;
    return quoted + "\"";
}

std::string tomlKey(std::string_view name) {
    const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_';
    });
    return bare ? std::string(name) : tomlText(name);
}

std::string tomlNumber(double value) { return fmt::format("{}", value == 0 ? 0.0 : value); }

std::string tomlTriple(const Vec3& values) {
    return fmt::format("[{}, {}, {}]", tomlNumber(values[0]), tomlNumber(values[1]),
                       tomlNumber(values[2]));
}

std::string tomlList(const std::vector<std::string>& texts) {
    std::vector<std::string> quoted;
    for (const std::string& text : texts)
        quoted.push_back(tomlText(text));
    return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string tomlLines(const TomlFields& fields) {
    std::string text;
    for (const auto& [key, value] : fields)
        text += fmt::format("{} = {}\n", tomlKey(key), value);
    return text;
}

std::string tomlTable(std::string_view parent, std::string_view name, const TomlFields& fields) {
    return fmt::format("[{}.{}]\n{}", parent, tomlKey(name), tomlLines(fields));
}

std::string tomlInline(const TomlFields& fields) {
    std::string text;
    for (const auto& [key, value] : fields)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", tomlKey(key), value);
    return text.empty() ? "{}" : "{ " + text + " }";
}

} // namespace obscura
