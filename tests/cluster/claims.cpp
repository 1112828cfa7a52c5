#include "base/error.h"
#include "base/units.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <exception>
#include <string>
#include <vector>

// What sharing work costs on a disk: `claims FOLDER UNITS PROCESSES [GROUPS]` lets so many
// processes share units that are no work at all, in a new folder, and prints how fast they were
// through. docs/cluster.md has figures; run it on a cluster's own file system before trusting a
// thousand workers to it.

namespace obscura {
namespace {

std::vector<WorkUnit> planOf(int units, int groups) {
    std::vector<WorkUnit> plan;
    for (int i = 0; i < units; ++i)
        plan.push_back({fmt::format("configuration {} in view {}", i / groups, i % groups),
                        fmt::format("view {}", i % groups)});
    return plan;
}

int work(const std::string& folder, const std::vector<WorkUnit>& plan) {
    Units units(folder, "claims", plan);
    int finished = 0;
    std::string group;
    while (const auto name = units.claimNext(group)) {
        units.finish(*name, *name + "\n");
        group = name->substr(name->find("view"));
        ++finished;
    }
    return finished;
}

void run(const std::string& folder, int units, int processes, int groups) {
    const std::vector<WorkUnit> plan = planOf(units, groups);
    const auto begin = std::chrono::steady_clock::now();
    std::vector<pid_t> children;
    for (int i = 0; i < processes; ++i) {
        children.push_back(::fork());
        if (children.back() == 0) {
            work(folder, plan);
            ::_exit(0);
        }
    }
    for (const pid_t child : children)
        ::waitpid(child, nullptr, 0);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const UnitsState state = unitsState(folder);
    fmt::print("{} processes, {} of {} units: {:.2f} s, {:.0f} units per second\n", processes,
               state.done, state.units, seconds.count(),
               static_cast<double>(state.done) / seconds.count());
}

} // namespace
} // namespace obscura

int main(int count, char** arguments) {
    if (count < 4) {
        fmt::print(stderr, "usage: claims FOLDER UNITS PROCESSES [GROUPS]\n");
        return 2;
    }
    try {
        obscura::run(arguments[1], std::stoi(arguments[2]), std::stoi(arguments[3]),
                     count > 4 ? std::stoi(arguments[4]) : 1);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
