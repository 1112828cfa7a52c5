#pragma once

namespace obscura::gl {

// Notices that the machine was suspended: meanwhile the clock since boot (CLOCK_BOOTTIME) goes on,
// while the steady clock (CLOCK_MONOTONIC), by which everything here is timed, stands still.
class SleepWatch {
  public:
    using Clock = double (*)(); // seconds

    SleepWatch(); // by these two clocks
    SleepWatch(Clock boot, Clock steady);

    bool slept(); // since it was made, or last asked

  private:
    double ahead() const;

    Clock boot_, steady_;
    double ahead_; // of the clock since boot
};

} // namespace obscura::gl
