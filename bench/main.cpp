#include "base/program.h"
#include "bench/commands.h"

namespace {

int run(CLI::App& app, int argc, char** argv) {
    using namespace obscura;
    app.require_subcommand(1);
    std::vector<Command> commands;
    for (auto* add :
         {viewCommands, sweepCommands, chooseCommands, stabilityCommands, statusCommands})
        for (Command& command : add(app))
            commands.push_back(std::move(command));
    app.parse(argc, argv);
    for (const Command& command : commands)
        if (command.parsed->parsed())
            return command.run();
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return obscura::runProgram("obscura-bench", "how fast, how right and how steady techniques are",
                               run, argc, argv);
}
