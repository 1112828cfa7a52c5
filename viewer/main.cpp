#include "base/error.h"
#include "viewer/application.h"
#include "viewer/command_line.h"
#include "viewer/test_command.h"

namespace {

int run(int argc, char** argv) {
    const obscura::Parsed parsed = obscura::parseCommandLine(argc, argv);
    if (!parsed.line)
        return parsed.status;
    return parsed.line->test ? obscura::runTestCommand(*parsed.line)
                             : obscura::runWindow(*parsed.line);
}

} // namespace

int main(int argc, char** argv) { return obscura::runProgram("obscura-view", run, argc, argv); }
