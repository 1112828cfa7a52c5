#pragma once

#include <string>

namespace obscura {

// What the machine says of itself, for ledgers and sidecars.

std::string machineName(); // host name
std::string systemName();  // "Linux 6.1.0-18-amd64 x86_64"
std::string utcNow();      // "2026-01-31T23:59:59Z"
int processId();
bool processRuns(int process); // on this machine

} // namespace obscura
