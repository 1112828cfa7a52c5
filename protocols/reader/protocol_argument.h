#pragma once

#include <string>
#include <vector>

namespace CLI {
class Option;
}

namespace obscura {

// Lets an option or positional take a protocol (or a study of techniques): a file, or "demo" for
// the demo.toml that comes with the programs. What it is bound to gets the file's path either way.
CLI::Option* takesProtocol(CLI::Option* option);

// Their names, in order.
std::vector<std::string> shippedProtocols();

} // namespace obscura
