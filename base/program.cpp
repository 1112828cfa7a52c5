#include "base/program.h"

#include "base/argument_table.h"
#include "base/error.h"
#include "base/files.h"
#include "base/manual.h"
#include "base/version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace obscura {

namespace {

namespace fs = std::filesystem;

void describe(const CLI::App& app, const char* about, const fs::path& share) {
    writeFile(share / "man/man1" / (app.get_name() + ".1"), manualOf(app, about));
    writeFile(argumentTableFile(share / "obscura", app.get_name()), argumentTable(app, about));
}

} // namespace

int runProgram(const char* name, const char* about,
               int (*body)(CLI::App& app, int argc, char** argv), int argc, char** argv) {
    CLI::App app(about, name);
    app.set_version_flag("--version", fmt::format("{} {} ({})", name, version(), commit()),
                         "Print version and commit, and end");
    // Before what is required is asked for, as with --version.
    app.add_option_function<std::string>("--describe-into",
                                         [&](const std::string& share) {
                                             describe(app, about, share);
                                             throw CLI::Success();
                                         })
        ->group("");
    try {
        return body(app, argc, argv);
    } catch (const CLI::ParseError& end) {
        return app.exit(end);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", name, error.what());
        return 1;
    }
}

} // namespace obscura
