#include "base/random.h"

#include <cmath>
#include <numbers>

namespace obscura {

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0];
        const std::uint64_t b = std::uint64_t{0xCD9E8D57} * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0],
                   static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1],
                   static_cast<std::uint32_t>(a)};
        key[0] += 0x9E3779B9;
        key[1] += 0xBB67AE85;
    }
    return counter;
}

namespace {

// FNV-1a: spreads a purpose's name over 64 bits.
std::uint64_t hashName(std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : name)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

} // namespace

Random::Random(std::uint64_t seed, std::string_view purpose) {
    const std::uint64_t name = hashName(purpose);
    key_ = {static_cast<std::uint32_t>(seed),
            static_cast<std::uint32_t>(seed >> 32) ^ static_cast<std::uint32_t>(name >> 32)};
    stream_ = static_cast<std::uint32_t>(name);
}

std::uint32_t Random::bits() {
    if (used_ == 4) {
        block_ = philox({static_cast<std::uint32_t>(counter_),
                         static_cast<std::uint32_t>(counter_ >> 32), stream_, 0},
                        key_);
        ++counter_;
        used_ = 0;
    }
    return block_[static_cast<std::size_t>(used_++)];
}

double Random::uniform() {
    const std::uint64_t high = bits() >> 5; // 27 bits
    const std::uint64_t low = bits() >> 6;  // 26 bits
    return static_cast<double>((high << 26) | low) * 0x1p-53;
}

double Random::normal() {
    const double radius = std::sqrt(2.0 * exponential());
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

double Random::exponential() { return -std::log1p(-uniform()); }

std::uint32_t Random::below(std::uint32_t bound) {
    // Reject the few top values that would make the remainder uneven.
    const std::uint32_t limit = 0xFFFFFFFF - 0xFFFFFFFF % bound;
    for (;;)
        if (const std::uint32_t value = bits(); value < limit)
            return value % bound;
}

} // namespace obscura
