#pragma once

#include <vector>

namespace obscura {

// For how many refreshes a mask has been on the screen, by the times at which its swaps came on.
// Each swap is one refresh or, when the next comes late, more. While the mask lasts, refreshes that
// passed without a swap count once two stamps in a row say so: one alone may itself be late, and
// counting a refresh that was none would end the mask too early.
class RefreshCount {
  public:
    // No more than `planned` swaps and their end are added without allocating.
    RefreshCount(double hz, int planned) : hz_(hz) {
        intervals_.reserve(static_cast<std::size_t>(planned));
    }

    void restart(); // counts from nothing, in the same memory

    void add(double time); // a swap of the mask came on; the first is its onset. Seconds
    void end(double time); // what follows the mask came on

    int refreshes() const;                 // so far; after end(), altogether
    int missed() const { return missed_; } // intervals above 1.2 refreshes
    double seconds() const { return last_ - onset_; }
    const std::vector<double>& intervals() const { return intervals_; } // between swaps, seconds

  private:
    void note(double time);

    double hz_;
    int swaps_ = 0, missed_ = 0;
    double onset_ = 0, last_ = 0;
    double behind_ = 0; // refreshes by which the last swap came late
    int passed_ = 0;    // refreshes without a swap
    std::vector<double> intervals_;
};

} // namespace obscura
