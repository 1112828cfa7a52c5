#include "protocols/reader/sweep.h"

#include "base/files.h"
#include "protocols/reader/study_parts.h"

#include <fmt/ranges.h>

namespace obscura {

namespace {

ImageSize sizeOf(const TomlTable& table, const std::string& path, const toml::node& node) {
    const toml::array* pair = node.as_array();
    ImageSize size;
    const auto number = [&](std::size_t i) {
        return pair && pair->size() == 2 && (*pair)[i].is_integer()
                   ? static_cast<int>(*(*pair)[i].value<std::int64_t>())
                   : 0;
    };
    size.width = number(0);
    size.height = number(1);
    if (std::min(size.width, size.height) < 16 || std::max(size.width, size.height) > 8192)
        throw Error(
            table.placeOf(node, path),
            fmt::format(
                "expected [width, height] in pixels, each 16 ... 8192, found {}",
                pair ? fmt::format("[{}]", fmt::join(std::vector{size.width, size.height}, ", "))
                     : TomlTable::spell(node)));
    return size;
}

std::vector<ImageSize> sizesOf(TomlTable& table) {
    std::vector<ImageSize> sizes;
    const toml::node* node = table.node("sizes");
    const toml::array* list = node ? node->as_array() : nullptr;
    if (!list || list->empty())
        throw Error(node ? table.placeOf(*node, table.pathOf("sizes")) : table.place(),
                    "expected \"sizes\", a list like [[960, 540], [1920, 1080]], found " +
                        (node ? TomlTable::spell(*node) : std::string("none")));
    for (const toml::node& each : *list)
        sizes.push_back(sizeOf(table, table.pathOf("sizes"), each));
    return sizes;
}

bool has(const std::vector<View>& views, const std::string& name) {
    return std::any_of(views.begin(), views.end(),
                       [&](const View& view) { return view.name == name; });
}

GrowthPlan parseGrowth(TomlTable table, const MatchStudy& study) {
    GrowthPlan growth;
    growth.view = table.text("view");
    if (!has(study.train, growth.view) && !has(study.test, growth.view))
        throw Error(
            table.placeOf("view"),
            fmt::format("expected the name of a scene under [scenes], found \"{}\"", growth.view));
    growth.radii = table.numbers("radii", lowestRadius, highestRadius);
    growth.sizes = sizesOf(table);
    for (const double poles : table.numbers("poles", 0, 4096))
        growth.poles.push_back(static_cast<int>(poles));
    for (auto& [name, technique] :
         table.tables("techniques", "at least one technique, [growth.techniques.NAME]"))
        for (TechniqueSetting& variant : parseVariants(name, std::move(technique)))
            growth.techniques.push_back(std::move(variant));
    table.finish();
    return growth;
}

} // namespace

SweepStudy parseSweepStudy(const std::string& text, const std::string& file) {
    const toml::table parsed = parseToml(text, file);
    TomlTable root(parsed, file, "");
    SweepStudy study;
    std::string includedSha256;
    study.match = parseComparison(root, Lists::varied, includedSha256);
    study.match.sha256 = studySha256(text, includedSha256);
    study.sizes = sizesOf(root);
    if (!root.has("training"))
        study.match.training = study.sizes.front();
    study.match.image = study.match.training; // fits are tested there; the sweep measures `sizes`
    if (auto light = root.table("light"))
        study.light = parseLevel("light", std::move(*light));
    if (auto display = root.table("display"))
        study.display = parseDisplay(std::move(*display));
    study.frames = root.integer("frames", 1, 100000, study.frames);
    study.seconds = root.number("seconds", 0, 3600, study.seconds);
    if (auto growth = root.table("growth"))
        study.growth = parseGrowth(std::move(*growth), study.match);
    root.finish();
    return study;
}

SweepStudy readSweepStudy(const std::filesystem::path& path) {
    return parseSweepStudy(readFile(path), path.string());
}

SweepStudy quick(SweepStudy study, std::size_t testViews) {
    study.match.train.resize(1);
    study.match.test.resize(std::min(study.match.test.size(), testViews));
    study.match.rays = std::min(study.match.rays, 64);
    study.match.training = study.match.image = {160, 90};
    study.sizes = {{320, 180}};
    study.frames = 3;
    study.seconds = 0.1;
    if (study.growth) {
        if (!has(study.match.train, study.growth->view) &&
            !has(study.match.test, study.growth->view))
            study.growth->view = study.match.train.front().name;
        study.growth->sizes = {{240, 135}, {480, 270}, {960, 540}};
        study.growth->radii.resize(std::min<std::size_t>(study.growth->radii.size(), 3));
    }
    return study;
}

std::string variedName(const std::string& configuration) {
    return configuration.substr(0, configuration.find(' '));
}

} // namespace obscura
