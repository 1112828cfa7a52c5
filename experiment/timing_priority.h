#pragma once

#include <string>

namespace obscura {

// What the system grants a program that must not be late, in words for the session file.
struct Priority {
    std::string scheduling; // "real-time (SCHED_FIFO, 1)", or "usual: " and why
    std::string memory;     // "locked", or "not locked: " and why
};

// Asks that the calling thread, and those that it starts, go before all usual ones, that its timers
// are exact, and that no memory of the program, now or later, is swapped out. What is not permitted
// is not needed: the program goes on.
Priority askForPriority();

// From now on, threads that the calling one starts are usual ones.
void keepPriorityFromNewThreads();

} // namespace obscura
