#include "base/error.h"
#include "bench/commands.h"

namespace {

int run(int argc, char** argv) {
    using namespace obscura;
    CLI::App app("obscura-bench: how fast, how right and how steady techniques are");
    app.require_subcommand(1);
    std::vector<Command> commands;
    for (auto* add :
         {viewCommands, sweepCommands, chooseCommands, stabilityCommands, statusCommands})
        for (Command& command : add(app))
            commands.push_back(std::move(command));
    CLI11_PARSE(app, argc, argv);
    for (const Command& command : commands)
        if (command.parsed->parsed())
            return command.run();
    return 0;
}

} // namespace

int main(int argc, char** argv) { return obscura::runProgram("obscura-bench", run, argc, argv); }
