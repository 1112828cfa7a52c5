#include "experiment/study.h"

#include "base/error.h"
#include "base/files.h"
#include "protocols/reader/design.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace obscura {

namespace fs = std::filesystem;

namespace {

std::string remedy(const fs::path& protocol, const fs::path& stimuli) {
    return fmt::format("make them: obscura-stimuli {} --out {}", protocol.string(),
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
                                protocol.path.string(), remedy(protocol.path, manifest.folder)));
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i)
        if (i >= manifest.conditions.size() ||
            manifest.conditions[i].condition != protocol.conditions[i].id)
            throw Error({place, 0, 0, fmt::format("conditions[{}]", i)},
                        fmt::format("expected the images of condition \"{}\"; {}",
                                    protocol.conditions[i].id,
                                    remedy(protocol.path, manifest.folder)));
}

// The file's bytes.
std::string readVerified(const Manifest& manifest, const FileRecord& record) {
    const fs::path path = manifest.folder / record.path;
    std::string bytes = readFile(path);
    if (const std::string found = sha256(bytes); found != record.sha256)
        throw Error({path.string(), 0, 0, {}},
                    fmt::format("not the image that the manifest vouches for: expected SHA-256 "
                                "{:.12}..., found {:.12}...; run obscura-stimuli again",
                                record.sha256, found));
    return bytes;
}

} // namespace

const ConditionRecord& Study::condition(int index) const {
    return manifest.conditions.at(static_cast<std::size_t>(index));
}

const Texts& Study::texts() const {
    for (const Texts& translation : protocol.translations)
        if (translation.language == language)
            return translation;
    return protocol.texts;
}

std::string Study::design() const {
    nlohmann::json design = nlohmann::json::parse(designOf(protocol));
    for (const ConditionRecord& condition : manifest.conditions)
        for (const ImageRecord& image : condition.images)
            design["images"][condition.condition][image.role] = image.image.sha256;
    return design.dump();
}

Study openStudy(const fs::path& protocol, const fs::path& stimuli) {
    if (!fs::exists(stimuli / "manifest.json"))
        throw Error({stimuli.string(), 0, 0, {}},
                    "expected a folder with stimuli, found no manifest.json in it; " +
                        remedy(protocol, stimuli));
    Study study{readProtocol(protocol), readManifest(stimuli / "manifest.json")};
    // The manifest's order of conditions is its writer's affair; ours is the protocol's.
    std::vector<ConditionRecord> ordered;
    for (const Condition& condition : study.protocol.conditions)
        for (const ConditionRecord& record : study.manifest.conditions)
            if (record.condition == condition.id)
                ordered.push_back(record);
    study.manifest.conditions = std::move(ordered);
    checkBelongTogether(study.protocol, study.manifest);
    return study;
}

Image8 loadStimulus(const Manifest& manifest, const ImageRecord& record) {
    const std::string bytes = readVerified(manifest, record.image);
    Image8 image = readImage8(std::as_bytes(std::span(bytes)), record.image.path, 3);
    if (image.width != manifest.width || image.height != manifest.height)
        throw Error({(manifest.folder / record.image.path).string(), 0, 0, {}},
                    fmt::format("expected {}x{} pixels, found {}x{}; run obscura-stimuli again",
                                manifest.width, manifest.height, image.width, image.height));
    return image;
}

void verifyStimuli(const Manifest& manifest) {
    for (const ConditionRecord& condition : manifest.conditions)
        for (const ImageRecord& image : condition.images)
            readVerified(manifest, image.image);
}

} // namespace obscura
