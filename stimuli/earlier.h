#pragma once

#include "protocols/reader/manifest.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What the manifest of an earlier run says of a stimulus folder.
struct Earlier {
    std::optional<Manifest> manifest;
    // By the file of the rendered image, before any boost; without its quality where that was
    // predicted for another display.
    std::map<std::string, ImageRecord> images;

    const ImageRecord* find(const std::string& file) const; // null when there is none
};

// A manifest that cannot be read proves nothing, which only costs time; one that names no code adds
// to `warnings`.
Earlier earlierRun(const std::filesystem::path& folder, const Display& display,
                   std::vector<std::string>& warnings);

// Whether a record proves that the image need not be rendered, or be given EXRs.
bool proves(const ImageRecord& earlier, const Recipe& recipe, const std::filesystem::path& folder,
            bool exrs);

// Whether all files of an image, of a manifest, are as recorded.
bool intact(const std::filesystem::path& folder, const ImageRecord& image);
bool intact(const std::filesystem::path& folder, const Manifest& manifest);

} // namespace obscura
