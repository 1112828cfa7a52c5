#pragma once

#include <string>

namespace CLI {
class App;
}

namespace obscura {

// A program's page for man(1), in the language of man(7): what it is for (`about`, as in
// runProgram()), then all that its --help and that of its commands say, read off the same
// declaration.
std::string manualOf(const CLI::App& app, const std::string& about);

} // namespace obscura
