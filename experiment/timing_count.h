#pragma once

#include <vector>

namespace obscura {

// For how many refreshes a mask has been on the screen, by the times at which its swaps came on.
// Each swap is one refresh; a swap that comes late has let refreshes pass, which count too. A
// single late stamp is no late swap, though: nothing may be counted that was not, or the mask would
// end too early. So a refresh that passed counts once two swaps in a row say so.
class RefreshCount {
  public:
    explicit RefreshCount(double hz) : hz_(hz) {}

    void add(double time); // a swap of the mask came on; the first is its onset. Seconds
    void end(double time); // what follows the mask came on

    int refreshes() const; // so far; after end(), altogether
    int missed() const { return missed_; }
    double seconds() const { return last_ - onset_; }
    const std::vector<double>& intervals() const { return intervals_; } // between swaps, seconds

  private:
    void note(double time);

    double hz_;
    int swaps_ = 0, missed_ = 0;
    double onset_ = 0, last_ = 0;
    double behind_ = 0, behindBefore_ = 0; // refreshes by which the last two swaps came late
    std::vector<double> intervals_;
};

} // namespace obscura
