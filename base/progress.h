#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace obscura {

// A progress line on stderr: what is done, how much, how long it will still take. On a terminal
// the line rewrites itself; elsewhere (a log) a new line appears at most every five seconds.
// Time left is estimated from the rate since the first update: what was done before, by an earlier
// run or by others, says nothing of it.
class Progress {
  public:
    Progress(std::string label, double total);
    ~Progress(); // ends the line

    // `done` counts in the units of `total`; `note` names the item at hand.
    void update(double done, const std::string& note = {});

  private:
    using Clock = std::chrono::steady_clock;

    void print(double done, const std::string& note, bool last);

    std::string label_;
    double total_;
    double done_ = 0;
    std::optional<double> found_; // done at the first update
    bool terminal_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point printed_{};
};

// "95 s", "2 min 05 s", "7 h 12 min"
std::string durationText(double seconds);

// Peak memory of this process, MiB, as Linux counts it; 0 where there is no /proc.
double peakMemory();

} // namespace obscura
