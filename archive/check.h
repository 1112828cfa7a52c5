#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace obscura {

// An archive read again, and everything in it that this machine can make once more, made once more.

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

// `archive`: a folder, or a zip, which is unpacked into a temporary one. Nothing else is written.
// An Error where it is no archive, or one that is damaged or made to do harm, so that nothing in it
// can be looked at; all else is told in the result.
std::vector<Checked> checkArchive(const std::filesystem::path& archive,
                                  const CheckOptions& options);

// Whether nothing differs that should be the same.
bool isSound(const std::vector<Checked>& all);

// The table, and below it a line for each thing that differs or could not be looked at.
std::string textOf(const std::vector<Checked>& all);

} // namespace obscura
