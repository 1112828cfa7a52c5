#include "viewer/seen.h"

#include "viewer/technique_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace obscura {

namespace fs = std::filesystem;

namespace {

using fmt::format;

double toDecimals(double value, int decimals) {
    if (decimals <= 0)
        return std::round(value * std::pow(10, decimals)) * std::pow(10, -decimals);
    // By way of its text, for 3 * 0.1 is not what a person writes.
    const std::string text = format("{:.{}f}", value, decimals);
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

int digitsBefore(double value) { return static_cast<int>(std::floor(std::log10(value))) + 1; }

double toDigits(double value, int digits) {
    return value == 0 ? 0 : toDecimals(value, digits - digitsBefore(std::abs(value)));
}

// Beneath a folder relative to it, else absolute: what is opened does not depend on where a program
// is started.
std::string seenFrom(const fs::path& folder, const fs::path& file) {
    const fs::path whole = fs::absolute(file).lexically_normal(),
                   relative = whole.lexically_relative(fs::absolute(folder).lexically_normal());
    return relative.empty() || *relative.begin() == ".." ? whole.string() : relative.string();
}

View roundedOnce(View view) {
    const Vec3 p = view.camera.position, t = view.camera.target;
    const double distance = std::hypot(t[0] - p[0], t[1] - p[1], t[2] - p[2]);
    const int decimals = distance > 0 ? 6 - digitsBefore(distance) : 6;
    for (std::size_t i = 0; i < 3; ++i) {
        view.camera.position[i] = toDecimals(p[i], decimals);
        view.camera.target[i] = toDecimals(t[i], decimals);
        view.camera.up[i] = toDecimals(view.camera.up[i], 6);
    }
    view.camera.fovDegrees = toDigits(view.camera.fovDegrees, 5);
    view.camera.near = toDigits(view.camera.near, 2);
    view.radius = toDigits(view.radius, 4);
    view.exposure = toDecimals(view.exposure, 3);
    return view;
}

} // namespace

std::string inScenesFolder(const fs::path& file, const fs::path& scenesFolder) {
    return seenFrom(scenesFolder, file);
}

View rounded(View view) {
    // Twice, for what is rounded up to a distance of ten has a digit less.
    return roundedOnce(roundedOnce(std::move(view)));
}

Level levelIn(const fs::path& folder, Level level) {
    if (!level.environment.empty())
        level.environment = seenFrom(folder, level.environment);
    return level;
}

std::string newName(const std::string& wish, const std::vector<std::string>& taken) {
    std::string name = wish;
    for (int i = 2; std::find(taken.begin(), taken.end(), name) != taken.end(); ++i)
        name = format("{}-{}", wish, i);
    return name;
}

std::string sceneName(const View& view) {
    const std::string scene =
        slug(view.file.empty() ? view.builtin : fs::path(view.file).stem().string());
    const std::string camera = slug(view.name);
    if (scene.empty() || camera.starts_with(scene))
        return camera.empty() ? "scene" : camera;
    return camera.empty() ? scene : scene + "-" + camera;
}

std::string levelName(const Level& level) {
    const std::string name = slug(level.name);
    return name.empty() ? "light" : name;
}

TomlFields techniqueFields(const TechniqueSetting& setting) {
    return fieldsOf(setting, flagsOf(setting));
}

// Names of studies are lower-case letters, digits and hyphens.
std::string studyName(const fs::path& file) {
    const std::string name = slug(file.stem().string());
    return name.empty() ? "study" : name;
}

std::string tablesText(const Seen& seen) {
    const View view = rounded(seen.view);
    std::string text = tomlTable("scenes", sceneName(view), fieldsOf(view));
    const Level level = levelIn(fs::current_path(), seen.level);
    text += "\n" + tomlTable("levels", levelName(level), fieldsOf(level));
    std::vector<std::string> names;
    for (const Settings& pane : seen.panes) {
        const TechniqueSetting setting = settingOf(pane, seen.view.radius);
        names.push_back(newName(setting.name, names));
        text += "\n" + tomlTable("techniques", names.back(), techniqueFields(setting));
    }
    return text;
}

} // namespace obscura
