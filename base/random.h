#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace obscura {

// Philox 4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011): a block
// cipher of a counter. Any number of any stream can be computed directly, and it is the same
// everywhere; the standard library's distributions and std::shuffle do not promise that across
// compilers.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

// A stream of random numbers named by a seed and a purpose ("order", "choice/P03"): different
// purposes never share numbers, so adding one does not disturb another.
class Random {
  public:
    Random(std::uint64_t seed, std::string_view purpose);

    std::uint32_t bits();
    double uniform();                         // [0, 1), 53 bits
    double normal();                          // mean 0, standard deviation 1 (Box and Muller 1958)
    double exponential();                     // mean 1
    std::uint32_t below(std::uint32_t bound); // 0 ... bound - 1, unbiased; bound >= 1

    // Fisher and Yates, from the end.
    template <typename T>
    void shuffle(std::vector<T>& items) {
        for (std::size_t i = items.size(); i > 1; --i)
            std::swap(items[i - 1], items[below(static_cast<std::uint32_t>(i))]);
    }

  private:
    std::array<std::uint32_t, 2> key_;
    std::uint32_t stream_;
    std::uint64_t counter_ = 0;
    std::array<std::uint32_t, 4> block_{};
    int used_ = 4;
};

} // namespace obscura
