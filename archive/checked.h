#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace obscura {

// One kind of thing that was looked at.
struct Checked {
    std::string what;
    long same = 0;
    // Not to the last bit, as another driver, code or processor may round; never more than one code
    // value of 255 (RMSE) in pictures, or 1e-9 of a number.
    long nearly = 0;
    // Sentences, each with what and by how much.
    std::vector<std::string> differs, notHere, remarks;

    long count() const {
        return same + nearly + static_cast<long>(differs.size() + notHere.size());
    }
};

struct CheckOptions {
    std::filesystem::path scenes; // where scenes are that the archive has not
    std::string device;           // of obscura-render --devices; "" for the first
    // Told what is being done, and how many of how many pictures have been rendered.
    std::function<void(int done, int total, const std::string& what)> announce;
};

} // namespace obscura
