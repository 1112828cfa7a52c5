#include "archive/sums.h"

#include "archive/paths.h"
#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>

#include <set>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// "HASH  PATH", or "HASH *PATH" as for binary files.
bool isLine(std::string_view line) {
    constexpr std::size_t digits = 64;
    return line.size() > digits + 2 && line[digits] == ' ' &&
           (line[digits + 1] == ' ' || line[digits + 1] == '*') &&
           line.substr(0, digits).find_first_not_of("0123456789abcdef") == line.npos;
}

// Paths of all files, relative to the archive.
std::set<std::string> filesIn(const fs::path& archive) {
    std::set<std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(archive)) {
        const fs::file_status status = entry.symlink_status();
        if (fs::is_directory(status))
            continue;
        if (!fs::is_regular_file(status))
            throw Error({entry.path().string(), 0, 0, {}},
                        "expected a file, found a link, a device or the like, which no archive of "
                        "ours has; get it anew from where it came");
        files.insert(fs::relative(entry.path(), archive).generic_string());
    }
    return files;
}

} // namespace

std::string sumsOf(const NewFiles& files) {
    std::string text;
    for (const auto& [path, file] : files) {
        if (const std::string fault = faultOfPath(path); !fault.empty())
            throw Error({file.copyOf.string(), 0, 0, {}},
                        fmt::format("expected a name that every system can have: \"{}\" {}; rename "
                                    "the file",
                                    path, fault));
        text += fmt::format(
            "{}  {}\n", file.copyOf.empty() ? sha256(file.text) : sha256File(file.copyOf), path);
    }
    return text;
}

Sums readSums(const fs::path& archive) {
    const fs::path path = archive / sumsName;
    if (!fs::is_regular_file(fs::symlink_status(path)))
        throw Error(
            {archive.string(), 0, 0, {}},
            fmt::format("expected an archive of obscura-archive, found no {} in it", sumsName));
    const std::string text = readFile(path);
    Sums sums;
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        const Place place{path.string(), ++number, 0, {}};
        if (!isLine(line))
            throw Error(place, fmt::format("expected a SHA-256, two blanks and a path, found "
                                           "\"{:.80}\"; get the archive anew",
                                           line));
        const std::string file = line.substr(66);
        if (const std::string fault = faultOfPath(file); !fault.empty())
            throw Error(place, fmt::format("expected a path within the archive: \"{:.80}\" {}",
                                           file, fault));
        if (!sums.emplace(file, line.substr(0, 64)).second)
            throw Error(place, fmt::format("names \"{}\" a second time", file));
    }
    return sums;
}

std::vector<std::string> faultsOf(const fs::path& archive, const Sums& sums) {
    std::vector<std::string> faults;
    const std::set<std::string> there = filesIn(archive);
    for (const auto& [path, hash] : sums)
        if (!there.contains(path))
            faults.push_back(path + " is missing");
        else if (sha256File(archive / path) != hash)
            faults.push_back(path + " has changed: its SHA-256 is not that of the list");
    for (const std::string& path : there)
        if (path != sumsName && !sums.contains(path))
            faults.push_back(path + " is not in the list");
    return faults;
}

} // namespace obscura
