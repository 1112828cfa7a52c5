#pragma once

#include <chrono>
#include <cstdint>

namespace obscura {

// A clock in place of vertical blanks. Its ticks are counted from where it was made, so that errors
// do not add up.
class Ticks {
  public:
    explicit Ticks(double hz) : hz_(hz) {}

    // Waits for the next tick and returns its number: sleeps until shortly before it, then watches
    // the clock. A tick that is there before the program is, is skipped, as a vertical blank would
    // be.
    std::int64_t await() const;

    std::int64_t after(double seconds) const; // the first tick later than that since the beginning
    double timeOf(std::int64_t tick) const { return static_cast<double>(tick) / hz_; }

  private:
    double now() const;

    double hz_;
    std::chrono::steady_clock::time_point origin_ = std::chrono::steady_clock::now();
};

} // namespace obscura
