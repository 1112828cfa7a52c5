#pragma once

#include <string>

namespace obscura {

// A signal asked the program to end: SIGINT (Ctrl-C), SIGTERM (kill, a shutdown) or SIGHUP (the
// terminal was closed). No Error, since nothing is wrong: a session that meets it ends as if the
// person had left, and the program with the status that shells expect.
struct EndedBySignal {
    int signal = 0;

    std::string name() const; // "SIGTERM"
    int exitStatus() const { return 128 + signal; }
};

// From now on these signals are only noted; SIGHUP stays ignored where it was (nohup).
void heedSignals();

// Throws EndedBySignal once a signal has been noted. Whatever waits calls it again and again.
void throwIfEnded();

} // namespace obscura
