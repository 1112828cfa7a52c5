#include "experiment/refresh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace obscura {

Refresh judgeRefresh(std::vector<double> intervals, int reportedHz) {
    std::sort(intervals.begin(), intervals.end());
    const double median = intervals.empty() ? 0 : intervals[intervals.size() / 2];
    const auto near = std::count_if(intervals.begin(), intervals.end(), [&](double interval) {
        return std::abs(interval - median) <= 0.2 * median;
    });

    Refresh refresh;
    if (median <= 0)
        refresh.doubt = "no interval between swaps could be measured";
    else if (std::abs(1 / median - reportedHz) > 0.05 * reportedHz)
        refresh.doubt = fmt::format("a swap takes {:.2f} ms, but the system reports {} Hz",
                                    1000 * median, reportedHz);
    else if (10 * near < 9 * static_cast<std::ptrdiff_t>(intervals.size()))
        refresh.doubt = fmt::format("swaps take from {:.2f} to {:.2f} ms", 1000 * intervals.front(),
                                    1000 * intervals.back());
    else {
        // The mean of those near the median: finer than the median of stamps that jitter.
        const auto from = std::lower_bound(intervals.begin(), intervals.end(), 0.8 * median);
        const auto to = std::upper_bound(intervals.begin(), intervals.end(), 1.2 * median);
        refresh.hz = static_cast<double>(to - from) / std::accumulate(from, to, 0.0);
        refresh.source = "finish";
    }
    return refresh;
}

int maskRefreshes(double seconds, double hz) {
    return std::max(1, static_cast<int>(std::ceil(seconds * hz - 0.25)));
}

IntervalSummary summarise(const std::vector<double>& intervals, double hz) {
    IntervalSummary summary;
    summary.histogram.resize(31);
    if (intervals.empty())
        return summary;
    summary.count = static_cast<int>(intervals.size());
    summary.mean = std::accumulate(intervals.begin(), intervals.end(), 0.0) / summary.count;
    for (const double interval : intervals) {
        summary.deviation += (interval - summary.mean) * (interval - summary.mean);
        ++summary.histogram[static_cast<std::size_t>(std::clamp(interval * hz * 10, 0.0, 30.0))];
    }
    summary.deviation = std::sqrt(summary.deviation / std::max(1, summary.count - 1));
    const auto [least, most] = std::minmax_element(intervals.begin(), intervals.end());
    summary.least = *least;
    summary.most = *most;
    return summary;
}

} // namespace obscura
