#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <functional>
#include <thread>
#include <vector>

namespace obscura {

// Calls work(i) for i = 0 ... count - 1 on so many `threads`; 0 means one for each core. `progress`
// is told the share done, always from the calling thread. Each thread takes some hundredths of the
// work at a time, so that small pieces cost no more than large ones. Work must not throw, and what
// it does for one i must not depend on another's.
template <std::integral Index, typename Work>
void forEachInParallel(Index count, const Work& work,
                       const std::function<void(double)>& progress = {}, int threads = 0) {
    const int all = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
    const Index chunk = std::max<Index>(count / static_cast<Index>(128 * std::max(all, 1)), 1);
    std::atomic<Index> next{0};
    const auto run = [&](bool tells) {
        for (Index first = next.fetch_add(chunk); first < count; first = next.fetch_add(chunk)) {
            const Index last = std::min<Index>(first + chunk, count);
            for (Index i = first; i < last; ++i)
                work(i);
            if (tells && progress)
                progress(static_cast<double>(last) / static_cast<double>(count));
        }
    };
    std::vector<std::jthread> others;
    for (int i = 1; i < all; ++i)
        others.emplace_back(run, false);
    run(true);
}

} // namespace obscura
