#pragma once

#include "gl/object.h"

#include <chrono>
#include <string>
#include <vector>

namespace obscura::gl {

// Two ways to time the GPU. `queries` are its own time stamps and disturb nothing. `finish` waits
// until all work is done and reads a steady clock: the only honest way on software drivers, whose
// time stamps are those of submission.
enum class Timing { queries, finish };

struct TimingChoice {
    Timing timing;
    std::string reason; // a sentence: what was compared and found
};
// Draws a load of at least a few milliseconds under both and trusts queries where they agree to a
// tenth.
TimingChoice honestTiming();

// Times pieces of work that follow each other.
class Timer {
  public:
    explicit Timer(Timing timing) : timing_(timing) {}

    void start(); // waits for earlier work
    void mark();  // here a piece ends
    // Seconds of each piece since start(); waits.
    std::vector<double> pieces();

  private:
    Timing timing_;
    std::vector<QueryObject> queries_;
    std::size_t marks_ = 0; // used in queries_, the one at the start included
    std::vector<std::chrono::steady_clock::time_point> times_;
};

} // namespace obscura::gl
