#include "experiment/timing_ticks.h"

#include <cmath>
#include <thread>

namespace obscura {

namespace {

// Sleepers wake late: by tens of microseconds on an idle machine, seldom by more than this.
constexpr double watched = 0.001; // seconds before a tick

// Who is later than this has missed the tick.
constexpr double soonest = 0.125; // of the time between ticks

} // namespace

double Ticks::now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - origin_).count();
}

std::int64_t Ticks::after(double seconds) const {
    return static_cast<std::int64_t>(std::floor(seconds * hz_)) + 1;
}

std::int64_t Ticks::await() const {
    for (;;) {
        const std::int64_t tick = after(now());
        const double time = timeOf(tick);
        std::this_thread::sleep_for(std::chrono::duration<double>(time - watched - now()));
        while (now() < time)
            ;
        if ((now() - time) * hz_ <= soonest)
            return tick;
    }
}

} // namespace obscura
