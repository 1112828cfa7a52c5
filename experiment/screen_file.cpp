#include "experiment/screen_file.h"

#include "base/error.h"
#include "base/files.h"
#include "experiment/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace obscura {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr int newest = 1;                  // format_version
constexpr double fewest = 0.5, most = 100; // pixels per mm that a screen may have

std::string fileName(std::string name) {
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '-'; }, '-');
    return name.empty() ? "unnamed" : name;
}

std::string modeOf(const gl::Monitor& monitor) {
    return fmt::format("{}x{}", monitor.width, monitor.height);
}

[[noreturn]] void refuse(const fs::path& file, const std::string& expected) {
    throw Error({file.string(), 0, 0, {}},
                fmt::format("expected {}; measure the screen again (obscura-experiment card or "
                            "calibrate) after removing the file",
                            expected));
}

ordered_json readAll(const fs::path& file) {
    if (!fs::exists(file))
        return ordered_json::object();
    ordered_json json = ordered_json::parse(readFile(file), nullptr, false);
    if (!json.is_object() || !json.contains("format_version") ||
        !json["format_version"].is_number_integer())
        refuse(file, "measurements of a screen in JSON, with a format_version");
    if (json["format_version"] > newest)
        refuse(file, fmt::format("format_version {} at most, found {}", newest,
                                 json["format_version"].dump()));
    return json;
}

} // namespace

fs::path screenFile(const fs::path& data, const gl::Monitor& monitor) {
    return data / "screens" /
           fmt::format("{}_{}.json", fileName(machineName()), fileName(monitor.name));
}

void keepMeasured(const fs::path& file, const gl::Monitor& monitor, const std::string& key,
                  const ordered_json& measured) {
    ordered_json json = readAll(file);
    json["format_version"] = newest;
    json["machine"] = machineName();
    json["monitor"] = monitor.name;
    json["reported_mm"] = fmt::format("{}x{}", monitor.widthMm, monitor.heightMm);
    json[key] = measured;
    json[key]["mode"] = modeOf(monitor);
    json[key]["time"] = utcNow();
    fs::create_directories(file.parent_path());
    writeFile(file, json.dump(2) + "\n");
}

ordered_json measured(const fs::path& file, const gl::Monitor& monitor, const std::string& key) {
    const ordered_json json = readAll(file);
    const auto found = json.find(key);
    if (found == json.end())
        return nullptr;
    if (!found->is_object() || !found->contains("mode") || !found->contains("time"))
        refuse(file, fmt::format("\"{}\" to be an object with \"mode\" and \"time\"", key));
    return (*found)["mode"] == modeOf(monitor) ? *found : ordered_json(nullptr);
}

ordered_json calibrationOf(const fs::path& data, const gl::Monitor& monitor) {
    ordered_json found = ordered_json::object();
    for (const char* key : {"gamma_by_eye", "luminance"})
        if (ordered_json one = measured(screenFile(data, monitor), monitor, key); !one.is_null())
            found[key] = std::move(one);
    return found;
}

std::optional<ScreenSize> cardSize(const fs::path& data, const gl::Monitor& monitor) {
    const fs::path file = screenFile(data, monitor);
    const ordered_json card = measured(file, monitor, "card");
    if (card.is_null())
        return std::nullopt;
    const auto value = card.find("pixels_per_mm");
    if (value == card.end() || !value->is_number() || !(value->get<double>() >= fewest) ||
        !(value->get<double>() <= most) || !card["time"].is_string())
        refuse(file, fmt::format("\"card.pixels_per_mm\" to be a number from {} to {}, and "
                                 "\"card.time\" a text",
                                 fewest, most));
    return ScreenSize{value->get<double>(), "card on " + card["time"].get<std::string>()};
}

} // namespace obscura
