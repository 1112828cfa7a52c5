#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// Whether any of these files is in the folder of a result. Results that are kept for their numbers
// alone, as in docs/results, have no pictures, and a page that is made of them has none either;
// where there are some, a page refuses one that is missing.
inline bool keepsPictures(const std::filesystem::path& folder,
                          const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return std::filesystem::exists(folder / name);
    });
}

} // namespace obscura
