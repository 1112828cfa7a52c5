#include "archive/paths.h"

#include <algorithm>

namespace obscura {

namespace {

bool isPlain(unsigned char c) { return c >= 32 && c != 127 && c != '\\' && c != ':'; }

std::string faultOfPart(std::string_view part) {
    constexpr std::size_t longest = 255; // bytes, of a name on Linux
    if (part.empty())
        return "has an empty name between two slashes";
    if (part == "." || part == "..")
        return "leads out of its folder, or goes round";
    return part.size() > longest ? "has a name of more than 255 bytes" : "";
}

} // namespace

std::string faultOfPath(std::string_view path) {
    constexpr std::size_t longest = 1024; // bytes
    if (path.empty())
        return "is empty";
    if (path.front() == '/')
        return "is absolute";
    if (path.size() > longest)
        return "is longer than 1024 bytes";
    if (!std::all_of(path.begin(), path.end(), isPlain))
        return "has a backslash, a colon or a control character";
    while (true) {
        const std::size_t slash = path.find('/');
        if (std::string fault = faultOfPart(path.substr(0, slash)); !fault.empty())
            return fault;
        if (slash == path.npos)
            return "";
        path.remove_prefix(slash + 1);
    }
}

} // namespace obscura
