#include "stimuli/earlier.h"

#include "stimuli/boost.h"
#include "stimuli/image_files.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace fs = std::filesystem;

const ImageRecord* Earlier::find(const std::string& file) const {
    const auto found = images.find(file);
    return found == images.end() ? nullptr : &found->second;
}

Earlier earlierRun(const fs::path& folder, const Display& display,
                   std::vector<std::string>& warnings) {
    const fs::path path = folder / manifestName;
    Earlier earlier;
    if (!fs::exists(path))
        return earlier;
    try {
        earlier.manifest = readManifest(path);
    } catch (const Error&) {
        return earlier;
    }
    if (earlier.manifest->schemaVersion < 2)
        warnings.push_back(fmt::format("{} is of version {}, which does not name the code that "
                                       "rendered: its images are made anew",
                                       path.string(), earlier.manifest->schemaVersion));
    for (const ConditionRecord& condition : earlier.manifest->conditions)
        for (const ImageRecord& image : condition.images) {
            ImageRecord record = unboosted(image);
            if (earlier.manifest->display != display)
                record.quality.reset();
            record.milliseconds.reset(); // the business of all images of a view
            earlier.images[record.image.path] = record;
        }
    return earlier;
}

bool proves(const ImageRecord& earlier, const Recipe& recipe, const fs::path& folder, bool exrs) {
    return earlier.recipe.sha256() == recipe.sha256() && earlier.layers.contains("ao") &&
           (!exrs || earlier.layers.contains("linear")) && intact(folder, earlier);
}

bool intact(const fs::path& folder, const ImageRecord& image) {
    return intact(folder, image.image) &&
           std::all_of(image.layers.begin(), image.layers.end(),
                       [&](const auto& layer) { return intact(folder, layer.second); });
}

bool intact(const fs::path& folder, const Manifest& manifest) {
    const auto isIntact = [&](const auto& record) { return intact(folder, record); };
    return std::all_of(manifest.contactSheets.begin(), manifest.contactSheets.end(), isIntact) &&
           std::all_of(manifest.conditions.begin(), manifest.conditions.end(),
                       [&](const ConditionRecord& condition) {
                           return std::all_of(condition.images.begin(), condition.images.end(),
                                              isIntact);
                       });
}

} // namespace obscura
