#pragma once

#include <CLI/App.hpp>

namespace obscura {

// Runs a program: `body` declares its arguments on `app`, calls app.parse(argc, argv), and does
// what they say; its result is the exit status. `about` says in one line what the program is for,
// without a full stop: in its --help, its manual page and the list that `obscura` prints.
//
// Every program so has --version, and --describe-into FOLDER, which the build calls and --help
// leaves out: it writes the program's manual page (base/manual.h) and the table of its arguments
// (base/argument_table.h) to where they lie in FOLDER, a share folder. What CLI11 ends a program
// by (--help, a mistake on the command line) ends here; an Error, or any other exception, becomes
// one line on stderr and exit status 1.
int runProgram(const char* name, const char* about,
               int (*body)(CLI::App& app, int argc, char** argv), int argc, char** argv);

} // namespace obscura
