#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace obscura {

// Calls work(i) for i = 0 ... count - 1 on so many threads, 0 for all cores; `progress` is told the
// share done, from the calling thread. Work must not throw.
inline void forEachInParallel(int count, const std::function<void(int)>& work,
                              const std::function<void(double)>& progress = {}, int threads = 0) {
    std::atomic<int> next{0};
    const auto run = [&](bool tells) {
        for (int i = next++; i < count; i = next++) {
            work(i);
            if (tells && progress)
                progress(static_cast<double>(i + 1) / count);
        }
    };
    std::vector<std::jthread> others;
    const int all = static_cast<int>(std::thread::hardware_concurrency());
    for (int i = 1; i < (threads > 0 ? threads : all); ++i)
        others.emplace_back(run, false);
    run(true);
}

} // namespace obscura
