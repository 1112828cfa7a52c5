// obscura: one name for all programs. `obscura stimuli ...` is obscura-stimuli ..., beside this
// one.

#include "base/argument_table.h"
#include "base/error.h"
#include "base/program.h"
#include "base/shipped.h"
#include "protocols/reader/protocol_argument.h"

#include "entry/completion.h"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>

namespace obscura {

namespace {

namespace fs = std::filesystem;

const std::string prefix = "obscura-";

// Each program that was installed with this one, "stimuli" and so on, and its arguments.
std::map<std::string, std::vector<Argument>> programs() {
    std::map<std::string, std::vector<Argument>> found;
    for (const auto& entry : fs::directory_iterator(shipped("programs")))
        if (const std::string name = entry.path().stem().string(); name.starts_with(prefix))
            found[name.substr(prefix.size())] = readArgumentTable(entry.path());
    return found;
}

int start(const std::string& name, char** argv) {
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / (prefix + name);
    if (fs::exists(program)) {
        std::string path = program.string();
        *argv = path.data();
        ::execv(path.c_str(), argv);
        throw Error({path, 0, 0, {}}, fmt::format("cannot be run: {}", std::strerror(errno)));
    }
    std::vector<std::string> names;
    for (const auto& [each, arguments] : programs())
        names.push_back(each);
    throw Error(fmt::format("expected the name of a program, found \"{}\"{}", name,
                            suggestion(name, names)));
}

// What the shell asks: the words from the name of the program to the cursor.
int complete(std::vector<std::string> words) {
    const auto all = programs();
    std::string program = fs::path(words.front()).filename().string();
    words.erase(words.begin());
    if (words.empty())
        words.emplace_back();
    if (program == "obscura" && words.size() > 1 && all.contains(words.front())) {
        program = prefix + words.front();
        words.erase(words.begin());
    }
    const std::vector<Argument> arguments =
        readArgumentTable(argumentTableFile(shipped("."), program));
    const Completion completion = completionOf(arguments, std::move(words), shippedProtocols());
    fmt::print("{}\n", completion.also);
    for (const auto& [text, about] : completion.words)
        fmt::print("{}\t{}\n", text, about);
    return 0;
}

int run(CLI::App& app, int argc, char** argv) {
    if (argc > 2 && std::string_view(argv[1]) == "--complete")
        return complete({argv + 2, argv + argc});
    if (argc > 1 && argv[1][0] != '-')
        return start(argv[1], argv + 1);
    for (const auto& [name, arguments] : programs())
        app.add_subcommand(name, arguments.front().about)->set_help_flag(); // its own has one
    app.footer(
        "Each program has its own --help and its own page: man obscura-stimuli.\n"
        "Where a protocol is asked for, its file will do, or the name of one that comes with "
        "Obscura, such as demo.\n"
        "OBSCURA_SCENES names the folder of glTF scenes, OBSCURA_CACHE that of traced "
        "references.");
    app.parse(argc, argv);
    fmt::print("{}", app.help());
    return 0;
}

} // namespace

} // namespace obscura

int main(int argc, char** argv) {
    return obscura::runProgram(
        "obscura", "how much ambient occlusion does a scene need? All programs by one name",
        obscura::run, argc, argv);
}
