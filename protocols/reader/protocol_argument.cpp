#include "protocols/reader/protocol_argument.h"

#include "base/error.h"
#include "base/shipped.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace obscura {

namespace {

namespace fs = std::filesystem;

// Puts the file's path for a name; what is wrong with it, or "". What looks like a path is left to
// who opens it.
std::string findProtocol(std::string& text) {
    if (text.find_first_of("/.") != text.npos || fs::is_regular_file(text))
        return "";
    const std::vector<std::string> names = shippedProtocols();
    if (std::find(names.begin(), names.end(), text) == names.end())
        return fmt::format(
            "expected a TOML file, or the name of one that comes with Obscura, found "
            "\"{}\"{}",
            text, suggestion(text, names));
    text = (shipped("protocols") / (text + ".toml")).string();
    return "";
}

} // namespace

CLI::Option* takesProtocol(CLI::Option* option) {
    return option->type_name("PROTOCOL")->transform(CLI::Validator(findProtocol, ""));
}

std::vector<std::string> shippedProtocols() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(shipped("protocols")))
        if (entry.path().extension() == ".toml")
            names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace obscura
