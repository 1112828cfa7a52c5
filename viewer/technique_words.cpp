#include "viewer/technique_words.h"

#include "base/arguments.h"
#include "base/error.h"

#include <fmt/format.h>

#include <cctype>
#include <sstream>

namespace obscura {

namespace {

// What `settings` has that `base` has not, in the table's order.
std::vector<Setting> differences(const Settings& settings, const Settings& base) {
    std::vector<Setting> result;
    for (std::size_t i = 0; i < settings.values().size(); ++i)
        if (settings.values()[i] != base.values()[i])
            result.push_back({std::string(settings.technique().parameters[i].name),
                              static_cast<double>(settings.values()[i]),
                              {}});
    return result;
}

} // namespace

TechniqueSetting settingOf(const Settings& settings, double sceneRadius) {
    const Technique& row = settings.technique();
    const auto base = [&](const Preset* preset) {
        Settings values(row);
        if (preset)
            values.apply(preset->name);
        if (values.has("radius"))
            values.set("radius", sceneRadius);
        return values;
    };
    TechniqueSetting result{"", std::string(row.id), differences(settings, base(nullptr)), {}};
    for (const Preset& preset : row.presets)
        if (auto left = differences(settings, base(&preset));
            left.size() < result.settings.size()) {
            result.settings = std::move(left);
            result.preset = PresetName{std::string(preset.name), {}};
        }
    result.name = nameOf(result);
    return result;
}

std::string nameOf(const TechniqueSetting& setting) {
    std::string name = slug(setting.technique);
    bool tuned = false;
    std::string half;
    if (setting.preset)
        name += "-" + slug(setting.preset->name);
    for (const Setting& each : setting.settings)
        if (each.name == "samples")
            name += fmt::format("{}{:g}", setting.preset || std::isdigit(name.back()) ? "-" : "",
                                each.value);
        else if (each.name == "downscale")
            half = each.value == 2 ? "-half" : fmt::format("-1-{:g}", each.value);
        else
            tuned = true;
    return name + half + (tuned ? "-tuned" : "");
}

TechniqueSetting techniqueIn(std::string_view words) {
    std::istringstream stream{std::string(words)};
    TechniqueSetting result;
    stream >> result.technique;
    Settings known(technique(result.technique));
    const Place place{"", 0, 0, std::string(words)};
    for (std::string word; stream >> word;) {
        if (word.find('=') == std::string::npos) {
            known.apply(word, place);
            result.preset = PresetName{word, place};
        } else {
            NamedNumber given = parseNamedNumber(result.technique, word);
            known.set(given.name, given.value, place);
            result.settings.push_back({std::move(given.name), given.value, place});
        }
    }
    result.name = nameOf(result);
    return result;
}

std::vector<std::string> flagsOf(const TechniqueSetting& setting) {
    std::vector<std::string> flags;
    for (const Parameter& parameter : technique(setting.technique).parameters)
        if (parameter.unit == Unit::flag)
            flags.emplace_back(parameter.name);
    return flags;
}

std::string slug(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 128 && std::isalnum(code))
            result += static_cast<char>(std::tolower(code));
        else if (!result.empty() && result.back() != '-')
            result += '-';
    }
    while (result.ends_with('-'))
        result.pop_back();
    return result;
}

} // namespace obscura
