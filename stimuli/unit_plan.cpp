#include "stimuli/unit_plan.h"

#include "base/files.h"
#include "base/version.h"
#include "protocols/reader/design.h"

#include <fmt/format.h>

namespace obscura {

namespace {

std::string unitName(const std::string& words, const std::string& decides) {
    return fmt::format("{} {}", words, sha256(decides).substr(0, 16));
}

// Qualities are predicted for a display.
std::string displayOf(const Protocol& protocol) {
    Manifest manifest;
    manifest.display = protocol.display;
    return manifestText(manifest);
}

std::string nameOf(const PlannedCondition& planned, const Protocol& protocol) {
    std::string decides = displayOf(protocol);
    for (std::size_t i = 0; i < planned.images.size(); ++i)
        decides += fmt::format("{} {} {}\n", planned.images[i].file, planned.recipes[i].sha256(),
                               planned.exrs[i] ? "with EXRs" : "");
    return unitName("condition " + protocol.conditions[planned.condition].id, decides);
}

} // namespace

std::vector<Recipe> UnitPlan::recipes() const {
    std::vector<Recipe> all;
    for (const PlannedCondition& planned : conditions)
        all.insert(all.end(), planned.recipes.begin(), planned.recipes.end());
    return all;
}

UnitPlan unitPlan(const Protocol& protocol, const Folders& folders, bool layers,
                  const gl::Driver& driver, std::string_view code, const Earlier& earlier) {
    UnitPlan all;
    SceneHashes scenes(folders);
    for (const PlannedImage& image : plan(protocol)) {
        if (all.conditions.empty() || all.conditions.back().condition != image.condition)
            all.conditions.push_back({image.condition, {}, {}, {}, {}});
        PlannedCondition& planned = all.conditions.back();
        const ImageRecord* known = earlier.find(image.file);
        planned.images.push_back(image);
        planned.recipes.push_back(makeRecipe(protocol, protocol.conditions[image.condition],
                                             image.member, scenes, driver, code));
        planned.exrs.push_back(layers || (known && known->layers.contains("linear")));
    }
    std::string conditions;
    for (PlannedCondition& planned : all.conditions) {
        planned.unit = nameOf(planned, protocol);
        conditions += planned.unit + "\n";
    }
    Manifest header = emptyManifest(protocol, {});
    for (const Condition& condition : protocol.conditions)
        header.conditions.push_back(emptyCondition(protocol, condition));
    all.times = unitName("times", conditions);
    all.manifest = unitName("manifest", manifestText(header) + conditions);
    return all;
}

Manifest emptyManifest(const Protocol& protocol, const std::filesystem::path& folder) {
    Manifest manifest;
    manifest.study = protocol.name;
    manifest.title = protocol.title;
    manifest.protocolSha256 = protocol.sha256;
    manifest.stimuliSha256 = sha256(partsOf(protocol).stimuli);
    manifest.commit = std::string(commit());
    manifest.width = protocol.width;
    manifest.height = protocol.height;
    manifest.display = protocol.display;
    manifest.folder = folder;
    return manifest;
}

ConditionRecord emptyCondition(const Protocol& protocol, const Condition& condition) {
    ConditionRecord record;
    record.condition = condition.id;
    record.level = condition.level;
    record.view = condition.view;
    record.hypothesis = condition.hypothesis;
    record.radius = protocol.view(condition.view).radius;
    return record;
}

} // namespace obscura
