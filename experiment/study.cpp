#include "experiment/study.h"

#include "base/error.h"
#include "base/files.h"
#include "protocols/reader/stimuli.h"

#include <fmt/format.h>

#include <span>
#include <utility>

namespace obscura {

namespace fs = std::filesystem;

namespace {

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

std::string Study::design() const { return designOf(protocol, manifest); }

Study openStudy(const fs::path& protocol, const fs::path& stimuli) {
    Protocol read = readProtocol(protocol);
    Manifest manifest = readStimuli(read, stimuli);
    return {std::move(read), std::move(manifest)};
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
