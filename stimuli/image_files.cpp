#include "stimuli/image_files.h"

#include "base/files.h"

#include <fmt/format.h>

#include <array>

namespace obscura {

namespace fs = std::filesystem;

namespace {

FileRecord writtenExr(const fs::path& folder, const std::string& name, const Image& image) {
    writeExr(folder / name, image, channelNames(image.channels), true);
    return {name, sha256File(folder / name)};
}

} // namespace

bool intact(const fs::path& folder, const FileRecord& file) {
    return fs::is_regular_file(folder / file.path) && sha256File(folder / file.path) == file.sha256;
}

std::span<const std::string> channelNames(int count) {
    static const std::array<std::string, 4> colours{"R", "G", "B", "A"};
    static const std::array<std::string, 1> grey{"V"};
    return count == 1
               ? std::span<const std::string>(grey)
               : std::span<const std::string>(colours).first(static_cast<std::size_t>(count));
}

FileRecord writtenPng(const fs::path& folder, const std::string& name, const Image8& image) {
    writePng(folder / name, image);
    return {name, sha256File(folder / name)};
}

std::map<std::string, const Image*> exrsOf(const Rendering& rendering) {
    std::map<std::string, const Image*> all{{"visibility", &rendering.visibility}};
    for (const auto& [kind, image] : rendering.layers)
        all[kind] = &image;
    return all;
}

ImageRecord written(const Rendering& rendering, const std::string& file, const fs::path& folder,
                    bool layers) {
    const std::string stem = fs::path(file).stem().string();
    ImageRecord record;
    record.inputsSha256 = rendering.inputsSha256;
    record.meanOcclusion = rendering.meanOcclusion;
    record.image = writtenPng(folder, file, rendering.image);
    record.layers["ao"] = writtenPng(folder, stem + "_ao.png", quantised(rendering.visibility));
    if (layers)
        for (const auto& [kind, image] : exrsOf(rendering))
            record.layers[kind] = writtenExr(folder, fmt::format("{}_{}.exr", stem, kind), *image);
    return record;
}

void checkMatched(const ConditionRecord& condition, const Place& place) {
    const ImageRecord* first = nullptr;
    for (const ImageRecord& image : condition.images) {
        if (image.image.path.empty())
            continue;
        if (!first)
            first = &image;
        if (image.inputsSha256 != first->inputsSha256)
            throw Error(place,
                        fmt::format("the images are not matched: before occlusion, \"{}\" has "
                                    "the hash {} and \"{}\" {}. The driver does not repeat "
                                    "itself; render with another device of obscura-render "
                                    "--devices",
                                    first->name, first->inputsSha256, image.name,
                                    image.inputsSha256));
    }
}

} // namespace obscura
