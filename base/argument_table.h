#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace obscura {

// The arguments of a program as a table, read off its own declaration: what completion offers
// (entry/completion.h), and the list of programs that `obscura` prints.

struct Argument {
    enum class Kind {
        program, // the first row: the program itself
        command,
        option,
        positional,
    };
    Kind kind;
    std::string command; // to which it belongs; "" for the program itself
    std::string name;    // "obscura-bench", "sweep", "--level", "protocol"
    int values = 0;      // at most, that follow it on the command line; 0: a flag, or no option
    // What a value can be: FILE, DIR, PROTOCOL (a file, or the name of one that comes with the
    // programs), the words of a closed set between blanks, or "" for what nobody can know.
    std::string takes;
    std::string about;
};

// What an option or positional takes, as in Argument.
std::string takenBy(const CLI::Option& option);

// Of a program, what it is for (runProgram()), and its commands, one deep, as CSV; and back.
std::string argumentTable(const CLI::App& app, const std::string& about);
std::vector<Argument> readArgumentTable(const std::filesystem::path& file);

// Where a program's table lies in the folder of what comes with the programs (base/shipped.h).
std::filesystem::path argumentTableFile(const std::filesystem::path& shipped,
                                        const std::string& program);

} // namespace obscura
