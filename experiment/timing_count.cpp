#include "experiment/timing_count.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

// Bridges et al. 2020 and PsychoPy: an interval above 1.2 refreshes is a missed one.
constexpr double missedInterval = 1.2;

// Stamps are late rather than early. That of the onset may be late, too, by less than this.
constexpr double tolerance = 0.25; // refreshes

} // namespace

void RefreshCount::add(double time) {
    note(time);
    behindBefore_ = behind_;
    behind_ = (time - onset_) * hz_ - swaps_;
    ++swaps_;
}

// No later swap will confirm that one was late.
void RefreshCount::end(double time) {
    note(time);
    behind_ = behindBefore_ = (time - onset_) * hz_ - swaps_;
}

void RefreshCount::note(double time) {
    if (swaps_ == 0) {
        onset_ = time;
    } else {
        intervals_.push_back(time - last_);
        missed_ += intervals_.back() * hz_ > missedInterval;
    }
    last_ = time;
}

int RefreshCount::refreshes() const {
    const double passed = std::floor(std::min(behind_, behindBefore_) + tolerance);
    return swaps_ + static_cast<int>(std::max(0.0, passed));
}

} // namespace obscura
