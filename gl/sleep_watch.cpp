#include "gl/sleep_watch.h"

#include <ctime>

namespace obscura::gl {

namespace {

constexpr double noticeable = 0.1, close = 0.01; // seconds

template <clockid_t clock>
double secondsOf() {
    timespec time{};
    ::clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

SleepWatch::SleepWatch() : SleepWatch(secondsOf<CLOCK_BOOTTIME>, secondsOf<CLOCK_MONOTONIC>) {}

SleepWatch::SleepWatch(Clock boot, Clock steady) : boot_(boot), steady_(steady), ahead_(ahead()) {}

bool SleepWatch::slept() {
    const double before = ahead_;
    ahead_ = ahead();
    return ahead_ > before + noticeable;
}

// A busy machine may set this process aside between two readings; then they are taken again.
double SleepWatch::ahead() const {
    for (;;) {
        const double before = steady_(), boot = boot_(), after = steady_();
        if (after - before < close)
            return boot - after;
    }
}

} // namespace obscura::gl
