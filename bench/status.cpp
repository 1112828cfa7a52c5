#include "bench/status.h"

#include "base/progress.h"
#include "bench/commands.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <set>
#include <thread>

namespace obscura {

namespace {

constexpr auto lookEvery = std::chrono::seconds(2);

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

// Refreshes one line until everything is done; in a log, a line at most as often as it changes.
void watch(const std::filesystem::path& folder) {
    const bool terminal = ::isatty(STDOUT_FILENO);
    std::string before;
    for (;;) {
        const UnitsState state = unitsState(folder);
        const std::string text = progressText(state);
        if (terminal || text != before)
            fmt::print("{}{}{}", terminal ? "\r\x1b[K" : "", text, terminal ? "" : "\n");
        std::fflush(stdout);
        before = text;
        if (state.done == state.units)
            break;
        std::this_thread::sleep_for(lookEvery);
    }
    if (terminal)
        fmt::print("\n");
}

} // namespace

std::string progressText(const UnitsState& state) {
    std::string text = fmt::format("{} of {} units, {:.0f} % of the work", state.done, state.units,
                                   state.cost > 0 ? 100 * state.costDone / state.cost : 100);
    if (state.done == state.units)
        return text + ": all is done";
    std::set<std::pair<std::string, long>> processes;
    for (const UnitsState::Held& held : state.held)
        processes.emplace(held.machine, held.pid);
    text += processes.empty() ? "; nobody works on it"
                              : "; " + counted(processes.size(), "process", "processes");
    if (state.secondsLeft)
        text += fmt::format(", about {} left", durationText(*state.secondsLeft));
    return text;
}

std::string statusText(const UnitsState& state) {
    std::string text = progressText(state) + "\n";
    for (const UnitsState::Held& held : state.held)
        text += fmt::format("  {}: {}, process {}, for {}\n", held.name,
                            held.machine.empty() ? "unknown machine" : held.machine, held.pid,
                            durationText(held.seconds));
    for (const std::string& name : state.broken)
        text += fmt::format("  {}: broken off, for its process is gone; the next one that comes "
                            "does it again\n",
                            name);
    if (state.held.empty() && state.done < state.units)
        text += "  To go on, give the command again that began it.\n";
    return text;
}

std::vector<Command> statusCommands(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "status", "how far a sweep, stability, stimuli or validity is, over all its processes");
    const auto folder = std::make_shared<std::filesystem::path>();
    const auto watching = std::make_shared<bool>(false);
    command->add_option("folder", *folder, "--out of the work")->required();
    command->add_flag("--watch", *watching, "refresh a line until all is done");
    return {{command, [folder, watching] {
                 if (*watching)
                     watch(*folder);
                 else
                     fmt::print("{}", statusText(unitsState(*folder)));
                 return 0;
             }}};
}

} // namespace obscura
