#include "protocols/reader/stimuli.h"

#include "base/error.h"
#include "base/files.h"
#include "protocols/reader/design.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace obscura {

namespace fs = std::filesystem;

namespace {

std::string remedy(const Protocol& protocol, const fs::path& stimuli) {
    return fmt::format("make them: obscura-stimuli {} --out {}", protocol.path.string(),
                       stimuli.string());
}

void checkBelongTogether(const Protocol& protocol, const Manifest& manifest) {
    const std::string place = (manifest.folder / "manifest.json").string();
    const bool same = manifest.stimuliSha256.empty() // written by an earlier version
                          ? manifest.protocolSha256 == protocol.sha256
                          : manifest.stimuliSha256 == sha256(partsOf(protocol).stimuli);
    if (!same)
        throw Error({place, 0, 0, {}},
                    fmt::format("these stimuli were made from another version of {}, whose scenes, "
                                "levels, techniques, conditions, image or seed have changed; {}",
                                protocol.path.string(), remedy(protocol, manifest.folder)));
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i)
        if (i >= manifest.conditions.size() ||
            manifest.conditions[i].condition != protocol.conditions[i].id)
            throw Error({place, 0, 0, fmt::format("conditions[{}]", i)},
                        fmt::format("expected the images of condition \"{}\"; {}",
                                    protocol.conditions[i].id, remedy(protocol, manifest.folder)));
}

} // namespace

Manifest readStimuli(const Protocol& protocol, const fs::path& folder) {
    if (!fs::exists(folder / "manifest.json"))
        throw Error({folder.string(), 0, 0, {}},
                    "expected a folder with stimuli, found no manifest.json in it; " +
                        remedy(protocol, folder));
    Manifest manifest = readManifest(folder / "manifest.json");
    // The manifest's order of conditions is its writer's affair; ours is the protocol's.
    std::vector<ConditionRecord> ordered;
    for (const Condition& condition : protocol.conditions)
        for (const ConditionRecord& record : manifest.conditions)
            if (record.condition == condition.id)
                ordered.push_back(record);
    manifest.conditions = std::move(ordered);
    checkBelongTogether(protocol, manifest);
    return manifest;
}

std::string designOf(const Protocol& protocol, const Manifest& manifest) {
    nlohmann::json design = nlohmann::json::parse(designOf(protocol));
    for (const ConditionRecord& condition : manifest.conditions)
        for (const ImageRecord& image : condition.images)
            design["images"][condition.condition][image.role] = image.image.sha256;
    return design.dump();
}

double predictedJod(const Manifest& manifest, std::string_view condition, std::string_view role) {
    const std::string file = (manifest.folder / "manifest.json").string();
    const auto record = std::find_if(
        manifest.conditions.begin(), manifest.conditions.end(),
        [&](const ConditionRecord& candidate) { return candidate.condition == condition; });
    if (record == manifest.conditions.end())
        throw Error({file, 0, 0, "conditions"},
                    fmt::format("expected the images of condition \"{}\"", condition));
    const ImageRecord& image = record->image(role);
    if (!image.quality)
        throw Error({file, 0, 0, fmt::format("{}.{}.quality", condition, role)},
                    "expected the predicted JOD of each image, by which an observer with eyes "
                    "answers, found none: these stimuli were made by an earlier version; generate "
                    "them anew with obscura-stimuli");
    return image.quality->jod;
}

bool asksForWorse(const Protocol& protocol, const Condition& condition, const Manifest& manifest) {
    if (!isOrdered(protocol.trial, condition.correct))
        return protocol.boost && !isOrdered(protocol.trial, protocol.boost->reference);
    const double right = predictedJod(manifest, condition.id, condition.correct);
    return std::any_of(condition.roles.begin(), condition.roles.end(), [&](const Role& role) {
        return isOrdered(protocol.trial, role.name) &&
               predictedJod(manifest, condition.id, role.name) > right;
    });
}

} // namespace obscura
