#include "inference/power.h"

#include "inference/equivalence.h"
#include "inference/tails.h"

#include <cassert>
#include <cmath>
#include <functional>

namespace obscura {

namespace {

constexpr std::int64_t mostPeople = 1 << 20;

// The first of 0 ... end - 1 that holds, or end; from there on all hold.
std::int64_t firstOf(std::int64_t end, const std::function<bool(std::int64_t)>& holds) {
    std::int64_t begin = 0;
    while (begin < end)
        if (const std::int64_t middle = begin + (end - begin) / 2; holds(middle))
            end = middle;
        else
            begin = middle + 1;
    return begin;
}

// The teeth of a saw are never longer than `reach` people. So behind one n that is enough, which
// doubling and halving find, all are from n + reach on; from there back to the last that is not.
std::optional<std::int64_t> lastingSize(const std::function<bool(std::int64_t)>& isEnough,
                                        double reach) {
    std::int64_t above = 1;
    while (!isEnough(above))
        if ((above *= 2) > mostPeople)
            return std::nullopt;
    const std::int64_t low = above / 2 + 1;
    const std::int64_t crossing =
        low + firstOf(above - low, [&](std::int64_t more) { return isEnough(low + more); });
    std::int64_t size = crossing + static_cast<std::int64_t>(std::ceil(reach));
    while (size > 1 && isEnough(size - 1))
        --size;
    return size <= mostPeople ? std::optional(size) : std::nullopt;
}

} // namespace

double power(PofVotes test, std::int64_t n, double share, double level) {
    assert(n >= 1 && share >= 0 && share <= 1);
    // Uneven counts reject: fewer than `kept` votes for one of the two.
    const std::int64_t kept = firstOf(n / 2 + 1, [&](std::int64_t k) {
        return test({k, n - k}) > level;
    });
    if (kept > n / 2)
        return 1;
    return binomialLower(kept - 1, n, share) + binomialUpper(n - kept + 1, n, share);
}

double equivalencePower(std::int64_t n, double margin, double share, double level) {
    assert(n >= 1 && share >= 0 && share <= 1);
    const std::int64_t least = firstOf(n / 2 + 1, [&](std::int64_t k) {
        return equivalenceP({k, n - k}, margin) < level;
    });
    if (least > n / 2)
        return 0;
    return 1 - binomialLower(least - 1, n, share) - binomialUpper(n - least + 1, n, share);
}

// From n to n + 1 the count that rejects moves by 0 or 1 where its ideal moves by about 1/2; so
// the power at n is that of at most one count more or less, which 1 / |share - 1/2| people bring
// and, as the ideal itself moves with n, twice as many at a target of 1/2. Twice that is safe.
std::optional<std::int64_t> sampleSize(PofVotes test, double share, double target, double level) {
    assert(target >= 0.5 && target < 1);
    if (share == 0.5)
        return std::nullopt;
    return lastingSize([&](std::int64_t n) { return power(test, n, share, level) >= target; },
                       10 + 4 / std::abs(share - 0.5));
}

std::optional<std::int64_t> equivalenceSampleSize(double margin, double share, double target,
                                                  double level) {
    assert(target >= 0.5 && target < 1);
    const double distance = margin - std::abs(share - 0.5);
    if (distance <= 0)
        return std::nullopt;
    return lastingSize(
        [&](std::int64_t n) { return equivalencePower(n, margin, share, level) >= target; },
        10 + 4 / distance);
}

std::optional<double> approximateSampleSize(double share, double target, double level) {
    assert(target >= 0.5 && target < 1);
    if (share == 0.5)
        return std::nullopt;
    const double deviation = std::sqrt(share * (1 - share));
    const double root = (probit(1 - level / 2) / 2 + probit(target) * deviation) / (share - 0.5);
    return root * root;
}

} // namespace obscura
