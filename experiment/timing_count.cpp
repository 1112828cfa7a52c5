#include "experiment/timing_count.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

// Bridges et al. 2020 and PsychoPy: an interval above 1.2 refreshes is a missed one.
constexpr double missedInterval = 1.2;

// A stamp is late rather than early. That of the onset may be late as well, by less than this.
constexpr double clockError = 0.25; // refreshes

} // namespace

void RefreshCount::restart() {
    swaps_ = missed_ = passed_ = 0;
    onset_ = last_ = behind_ = 0;
    intervals_.clear();
}

void RefreshCount::add(double time) {
    const double before = behind_;
    note(time);
    const double sure = std::floor(std::min(before, behind_) + clockError);
    passed_ = static_cast<int>(std::max(0.0, sure));
    ++swaps_;
}

// Nothing is decided by it any more: to the nearest refresh. A display that takes the first swaps
// ahead of the screen stamps them too early, so swaps still are refreshes where less time has
// passed.
void RefreshCount::end(double time) {
    note(time);
    passed_ = static_cast<int>(std::max(0L, std::lround(behind_)));
}

void RefreshCount::note(double time) {
    if (swaps_ == 0) {
        onset_ = time;
    } else {
        intervals_.push_back(time - last_);
        missed_ += intervals_.back() * hz_ > missedInterval;
    }
    last_ = time;
    behind_ = (time - onset_) * hz_ - swaps_;
}

int RefreshCount::refreshes() const { return swaps_ + passed_; }

} // namespace obscura
