#include "renderer/techniques/settings.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace obscura {

Settings::Settings(const Technique& technique) : technique_(&technique) {
    for (const Parameter& parameter : technique.parameters)
        values_.push_back(parameter.value);
}

std::size_t Settings::index(std::string_view name) const {
    std::size_t i = 0;
    while (i < technique_->parameters.size() && technique_->parameters[i].name != name)
        ++i;
    return i;
}

bool Settings::has(std::string_view name) const { return index(name) < values_.size(); }

float Settings::operator[](std::string_view name) const {
    assert(has(name));
    return values_[index(name)];
}

void Settings::set(std::string_view name, double value, const Place& place) {
    const std::size_t i = index(name);
    if (i == values_.size()) {
        std::vector<std::string> names;
        for (const Parameter& parameter : technique_->parameters)
            names.emplace_back(parameter.name);
        throw Error(place, names.empty()
                               ? fmt::format("technique \"{}\" has no settings, found \"{}\"",
                                             technique_->id, name)
                               : fmt::format("technique \"{}\" has no setting \"{}\"{}",
                                             technique_->id, name, suggestion(name, names)));
    }
    const Parameter& parameter = technique_->parameters[i];
    const bool whole = isWhole(parameter);
    if (!(value >= parameter.low && value <= parameter.high) ||
        (whole && value != std::floor(value)))
        throw Error(place, fmt::format("expected {} from {} to {} for \"{}\", found {}",
                                       whole ? "a whole number" : "a number", parameter.low,
                                       parameter.high, name, value));
    values_[i] = static_cast<float>(value);
}

void Settings::apply(std::string_view preset, const Place& place) {
    std::vector<std::string> names;
    for (const Preset& row : technique_->presets) {
        if (row.name == preset) {
            for (const PresetValue& given : row.values)
                values_[index(given.name)] = given.value; // wellFormed() has checked them
            return;
        }
        names.emplace_back(row.name);
    }
    throw Error(place, names.empty()
                           ? fmt::format("technique \"{}\" has no presets, found \"{}\"",
                                         technique_->id, preset)
                           : fmt::format("technique \"{}\" has no preset \"{}\"{}", technique_->id,
                                         preset, suggestion(preset, names)));
}

std::map<std::string, double> Settings::named() const {
    std::map<std::string, double> result;
    for (std::size_t i = 0; i < values_.size(); ++i)
        result[std::string(technique_->parameters[i].name)] = static_cast<double>(values_[i]);
    return result;
}

Settings settingsOf(const TechniqueSetting& setting, double radius) {
    const Technique* found = nullptr;
    try {
        found = &technique(setting.technique);
    } catch (const Error& error) {
        throw Error(setting.place, error.what());
    }
    Settings settings(*found);
    if (setting.preset)
        settings.apply(setting.preset->name, setting.preset->place);
    if (settings.has("radius"))
        settings.set("radius", radius, setting.place);
    for (const Setting& given : setting.settings)
        settings.set(given.name, given.value, given.place);
    return settings;
}

} // namespace obscura
