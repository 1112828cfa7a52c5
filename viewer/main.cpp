#include "base/program.h"
#include "viewer/application.h"
#include "viewer/command_line.h"
#include "viewer/test_command.h"

namespace {

int run(CLI::App& app, int argc, char** argv) {
    const obscura::CommandLine line = obscura::parseCommandLine(app, argc, argv);
    return line.test ? obscura::runTestCommand(line) : obscura::runWindow(line);
}

} // namespace

int main(int argc, char** argv) {
    return obscura::runProgram("obscura-view",
                               "see, compare and tune ambient occlusion, and take it to a study",
                               run, argc, argv);
}
