#pragma once

#include <cstddef>
#include <thread>

namespace obscura::builtin {

// Work on item 0 ... count - 1, half of them on another core. Each stands alone, so that the result
// does not depend on who does what.
template <typename Work>
void onBothCores(std::size_t count, const Work& work) {
    const auto half = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            work(i);
    };
    const std::jthread other(half, count / 2, count);
    half(0, count / 2);
}

} // namespace obscura::builtin
