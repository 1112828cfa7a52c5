#include "bench/choose/study_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace obscura {

namespace {

using fmt::format;

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::string triple(const Vec3& v) { return format("[{}, {}, {}]", v[0], v[1], v[2]); }

std::string size(const ImageSize& size) { return format("[{}, {}]", size.width, size.height); }

// A name for each view that no other has.
std::string keyOf(const View& view, const MatchStudy& study) {
    const auto alike = [&](const View& other) { return other.name == view.name; };
    const auto count = std::count_if(study.train.begin(), study.train.end(), alike) +
                       std::count_if(study.test.begin(), study.test.end(), alike);
    return count > 1 ? format("{}-{}", view.name, view.radius) : view.name;
}

std::string listOf(const std::vector<View>& views, const MatchStudy& study) {
    std::string text;
    for (const View& view : views)
        text += (text.empty() ? "" : ", ") + quoted(keyOf(view, study));
    return "[" + text + "]";
}

std::string tableOf(const View& view, const MatchStudy& study) {
    std::string text = format("\n[scenes.{}]\n{} = {}\nradius = {}\n", quoted(keyOf(view, study)),
                              view.file.empty() ? "builtin" : "file",
                              quoted(view.file.empty() ? view.builtin : view.file), view.radius);
    if (view.exposure != 0)
        text += format("exposure = {}\n", view.exposure);
    return text + format("camera = {}\n", toToml(view.camera));
}

std::string tableOf(const Level& light, const std::string& folder) {
    std::string text = "\n[light]\n";
    if (light.ambient)
        text += format("ambient = {}\nbackground = {}\n", triple(*light.ambient),
                       triple(light.background));
    else if (light.sky)
        text += format("sky = {{ zenith = {}, horizon = {}, ground = {} }}\n",
                       triple(light.sky->zenith), triple(light.sky->horizon),
                       triple(light.sky->ground));
    else
        text += format(
            "environment = {}\n",
            quoted(std::filesystem::absolute(std::filesystem::path(folder) / light.environment)
                       .lexically_normal()
                       .string()));
    if (light.sun)
        text += format("sun = {{ azimuthDegrees = {}, elevationDegrees = {}, irradiance = {} }}\n",
                       light.sun->azimuthDegrees, light.sun->elevationDegrees,
                       triple(light.sun->irradiance));
    return text + format("curve = \"{}\"\nwhite = {}\noccludeDirect = {}\n",
                         light.curve == Curve::clamp ? "clamp" : "reinhard", light.white,
                         light.occludeDirect);
}

std::string tableOf(const Display& display) {
    if (!display.name.empty())
        return format("\n[display]\nname = {}\n", quoted(display.name));
    std::string text = "\n[display]\n";
    for (const auto& [key, value] : numbersOf(display))
        text += format("{} = {}\n", key, value);
    return text;
}

std::string tableOf(const TechniqueSetting& technique) {
    std::string text = format("\n[techniques.{}]\ntechnique = {}\n", quoted(technique.name),
                              quoted(technique.technique));
    if (technique.preset)
        text += format("preset = {}\n", quoted(technique.preset->name));
    for (const Setting& setting : technique.settings)
        text += format("{} = {}\n", setting.name, setting.value);
    return text;
}

} // namespace

const std::string_view studyTextHead =
    "# Written by obscura-bench choose, which measured this; to check it, measure all:\n"
    "# obscura-bench sweep THIS_FILE --out SWEEP, and obscura-bench choose THIS_FILE --sweep "
    "SWEEP\n";

std::string studyText(const SweepStudy& study, const std::string& folder) {
    const MatchStudy& match = study.match;
    std::string text = format(
        "{}name = {}\nseed = {}\n{} = {}\nrays = {}\nnormals = {}\ntrain = {}\ntest = {}\n"
        "sizes = [{}]\nframes = {}\nseconds = {}\ntraining = {{ width = {}, height = {} }}\n",
        studyTextHead, quoted(match.name), match.seed,
        match.partner.empty() ? "reference" : "partner",
        quoted(match.partner.empty() ? truthNames()[static_cast<std::size_t>(match.truth)]
                                     : match.partner),
        match.rays, quoted(normalsNames()[static_cast<std::size_t>(match.normals)]),
        listOf(match.train, match), listOf(match.test, match), size(study.sizes.front()),
        study.frames, study.seconds, match.training.width, match.training.height);
    if (study.light)
        text += tableOf(*study.light, folder) + tableOf(study.display);
    for (const std::vector<View>* views : {&match.train, &match.test})
        for (const View& view : *views)
            text += tableOf(view, match);
    std::vector<TechniqueSetting> techniques =
        match.techniques; // in the order in which TOML is read
    std::sort(techniques.begin(), techniques.end(),
              [](const TechniqueSetting& a, const TechniqueSetting& b) { return a.name < b.name; });
    for (const TechniqueSetting& technique : techniques)
        text += tableOf(technique);
    return text;
}

} // namespace obscura
