#include "experiment/signals.h"

#include <csignal>

namespace obscura {

namespace {

// A handler can reach nothing else.
volatile std::sig_atomic_t noted = 0;

constexpr int heeded[] = {SIGINT, SIGTERM, SIGHUP};

} // namespace

std::string EndedBySignal::name() const {
    return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "SIGHUP";
}

void heedSignals() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { noted = signal; };
    action.sa_flags = SA_RESTART; // a row half written is written to its end
    for (const int signal : heeded) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        // Shells have programs in the background ignore SIGINT, yet whoever sends it to one means
        // it.
        if (signal != SIGHUP || before.sa_handler != SIG_IGN)
            ::sigaction(signal, &action, nullptr);
    }
}

void throwIfEnded() {
    if (noted)
        throw EndedBySignal{noted};
}

} // namespace obscura
