#include "experiment/timing_priority.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace obscura {

namespace {

std::string reason() { return std::strerror(errno); }

// The lowest real-time priority already goes before every usual thread.
bool setRealTime(int flags) {
    sched_param parameters{};
    parameters.sched_priority = 1;
    return ::sched_setscheduler(0, SCHED_FIFO | flags, &parameters) == 0;
}

std::string askForScheduling() {
    if (setRealTime(0))
        return "real-time (SCHED_FIFO, 1)";
    return fmt::format("usual: real-time priority is refused ({}; ulimit -r)", reason());
}

// Where there is a limit, memory asked for later would be refused at it: better not locked. Pages
// are locked once they are touched, for threads' stacks are much larger than what they use.
std::string lockMemory() {
    rlimit limit{};
    ::getrlimit(RLIMIT_MEMLOCK, &limit);
    if (limit.rlim_cur != RLIM_INFINITY && ::geteuid() != 0)
        return fmt::format("not locked: the system's limit is {} KiB (ulimit -l)",
                           limit.rlim_cur / 1024);
    if (::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0)
        return "locked";
    return fmt::format("not locked: {}", reason());
}

} // namespace

Priority askForPriority() {
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL); // nanoseconds; usually 50000
    return {askForScheduling(), lockMemory()};
}

void keepPriorityFromNewThreads() {
    if (::sched_getscheduler(0) == SCHED_FIFO)
        setRealTime(SCHED_RESET_ON_FORK);
}

} // namespace obscura
