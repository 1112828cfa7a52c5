#include "bench/choose/study_file.h"

#include "protocols/reader/study_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace obscura {

namespace {

using fmt::format;

std::string size(const ImageSize& size) { return format("[{}, {}]", size.width, size.height); }

// A name for each view that no other has.
std::string keyOf(const View& view, const MatchStudy& study) {
    const auto alike = [&](const View& other) { return other.name == view.name; };
    const auto count = std::count_if(study.train.begin(), study.train.end(), alike) +
                       std::count_if(study.test.begin(), study.test.end(), alike);
    return count > 1 ? format("{}-{}", view.name, view.radius) : view.name;
}

std::string listOf(const std::vector<View>& views, const MatchStudy& study) {
    std::vector<std::string> keys;
    for (const View& view : views)
        keys.push_back(keyOf(view, study));
    return tomlList(keys);
}

std::string tableOf(Level light, const std::string& folder) {
    if (!light.environment.empty())
        light.environment =
            std::filesystem::absolute(std::filesystem::path(folder) / light.environment)
                .lexically_normal()
                .string();
    return "\n[light]\n" + tomlLines(fieldsOf(light));
}

std::string tableOf(const Display& display) {
    if (!display.name.empty())
        return format("\n[display]\nname = {}\n", tomlText(display.name));
    std::string text = "\n[display]\n";
    for (const auto& [key, value] : numbersOf(display))
        text += format("{} = {}\n", key, value);
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
        studyTextHead, tomlText(match.name), match.seed,
        match.partner.empty() ? "reference" : "partner",
        tomlText(match.partner.empty() ? truthNames()[static_cast<std::size_t>(match.truth)]
                                       : match.partner),
        match.rays, tomlText(normalsNames()[static_cast<std::size_t>(match.normals)]),
        listOf(match.train, match), listOf(match.test, match), size(study.sizes.front()),
        study.frames, study.seconds, match.training.width, match.training.height);
    if (study.light)
        text += tableOf(*study.light, folder) + tableOf(study.display);
    for (const std::vector<View>* views : {&match.train, &match.test})
        for (const View& view : *views)
            text += "\n" + tomlTable("scenes", keyOf(view, match), fieldsOf(view));
    std::vector<TechniqueSetting> techniques =
        match.techniques; // in the order in which TOML is read
    std::sort(techniques.begin(), techniques.end(),
              [](const TechniqueSetting& a, const TechniqueSetting& b) { return a.name < b.name; });
    for (const TechniqueSetting& technique : techniques)
        text += "\n" + tomlTable("techniques", technique.name, fieldsOf(technique));
    return text;
}

} // namespace obscura
