#include "experiment/machine.h"

#include <fmt/chrono.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>

namespace obscura {

std::string machineName() {
    utsname names{};
    ::uname(&names);
    return names.nodename[0] ? names.nodename : "unknown";
}

std::string systemName() {
    utsname names{};
    ::uname(&names);
    return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

std::string utcNow() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

int processId() { return ::getpid(); }

bool processRuns(int process) { return ::kill(process, 0) == 0 || errno == EPERM; }

} // namespace obscura
