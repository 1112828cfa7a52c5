// obscura-validity: simulated studies with known answers, through presenter and analysis.

#include "base/arguments.h"
#include "base/files.h"
#include "base/process.h"
#include "base/program.h"
#include "base/progress.h"

#include "validity/shared.h"
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>

namespace obscura {

namespace {

namespace fs = std::filesystem;

int run(CLI::App& app, int argc, char** argv) {
    ValidityOptions options;
    fs::path out = "validity.md", folder = "/dev/shm";
    app.add_option("--studies", options.studies, "In each state of the world; of scales a tenth")
        ->option_text("N=10000")
        ->check(CLI::Range(1, 10000000));
    app.add_option("--seed", options.seed)->option_text("N=1");
    app.add_option("--threads", options.threads, "0: one for each core")->option_text("N=0");
    app.add_option("--out", out, "The page that is written")->option_text("FILE=validity.md");
    app.add_option("--share", options.share,
                   "Folder in which finished studies stay; processes with the same studies and "
                   "seed, on any machines that see it, share the work")
        ->option_text("DIR");
    app.add_option("--folder", folder,
                   "Where each study's CSV lies while it is read, best in memory")
        ->option_text("DIR=/dev/shm");
    app.parse(argc, argv);

    options.memory = folder / fmt::format("obscura-validity.{}", ProcessId::current().text());
    if (options.share.empty())
        options.share = options.memory;
    fs::create_directories(options.memory);
    Progress progress("simulated studies", 1);
    const std::string page = sharedValidityPage(
        options, [&](double share, const std::string& note) { progress.update(share, note); });
    progress.update(1);
    fs::remove_all(options.memory);
    writeFile(out, page);
    fmt::print("written: {}\n", out.string());
    return 0;
}

} // namespace

} // namespace obscura

int main(int argc, char** argv) {
    return obscura::runProgram(
        "obscura-validity", "simulated studies with known answers, through presenter and analysis",
        obscura::run, argc, argv);
}
