// obscura-validity: simulated studies with known answers, through presenter and analysis.

#include "analysis/plan/plan.h"
#include "base/arguments.h"
#include "base/files.h"
#include "base/process.h"
#include "base/program.h"
#include "base/progress.h"

#include "validity/tallying.h"
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>

namespace obscura {

namespace {

namespace fs = std::filesystem;

// What is planned for people who choose as those of a world do.
std::map<std::string, double> plannedPower(const World& world, int studies) {
    Protocol protocol = world.protocol();
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i)
        protocol.conditions[i].simulated.chooseB = world.truth.shares[i];
    PlanOptions options;
    options.participants = world.people;
    options.spread = world.truth.spread;
    options.studies = studies;
    const Plan plan = planOf(protocol, options);
    std::map<std::string, double> planned;
    for (const StatedPower& stated : plan.stated)
        for (std::size_t i = 0; stated.people == world.people && i < plan.tests.size(); ++i)
            planned[plan.tests[i].claim.name] = stated.supported[i].share;
    return planned;
}

int run(CLI::App& app, int argc, char** argv) {
    int studies = 10000, threads = 0;
    std::uint64_t seed = 1;
    fs::path out = "validity.md", folder = "/dev/shm";
    app.add_option("--studies", studies, "In each state of the world; of scales a tenth")
        ->option_text("N=10000")
        ->check(CLI::Range(1, 10000000));
    app.add_option("--seed", seed)->option_text("N=1");
    app.add_option("--threads", threads, "0: one for each core")->option_text("N=0");
    app.add_option("--out", out, "The page that is written")->option_text("FILE=validity.md");
    app.add_option("--folder", folder,
                   "Where each study's CSV lies while it is read, best in memory")
        ->option_text("DIR=/dev/shm");
    app.parse(argc, argv);

    folder /= fmt::format("obscura-validity.{}", ProcessId::current().text());
    fs::create_directories(folder);
    const std::vector<World> all = worlds();
    std::vector<Outcomes> outcomes;
    std::map<std::string, double> planned;
    for (const World& world : all) {
        Progress progress(std::string(world.name), 1);
        outcomes.push_back(outcomesOf(StudySimulator(world.protocol()), world,
                                      world.studies(studies), seed, folder.string(), threads,
                                      [&](double done) { progress.update(done); }));
        if (world.name == "effect")
            planned = plannedPower(world, 2000);
    }
    fs::remove_all(folder);
    writeFile(out, validityPage(all, outcomes, planned, studies, seed));
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
