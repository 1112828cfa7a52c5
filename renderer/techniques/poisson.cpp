#include "renderer/techniques/poisson.h"

#include "base/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace obscura {

namespace {

constexpr int attempts = 4000; // darts at one distance before a smaller one is tried
constexpr int group = 8;       // points whose rotations are chosen together

glm::dvec2 rotated(glm::dvec2 p, int rotation) {
    const double angle = 2 * std::numbers::pi * rotation / poissonRotations;
    return {p.x * std::cos(angle) - p.y * std::sin(angle),
            p.x * std::sin(angle) + p.y * std::cos(angle)};
}

// What poisson_sets.h can hold; everything is decided on such numbers.
glm::dvec2 printed(glm::dvec2 p) {
    return {std::round(p.x * 1e6) / 1e6, std::round(p.y * 1e6) / 1e6};
}

// Throws as many points as fit, at most `size`. Points stay half a distance inside the rim, because
// a point on it would stand for area outside, and its line through the ball has no length.
std::vector<glm::dvec2> throwDarts(int size, double distance, Random& random) {
    std::vector<glm::dvec2> points, stored; // the latter with all rotations
    for (int dart = 0; dart < attempts && static_cast<int>(points.size()) < size; ++dart) {
        const double radius = std::sqrt(random.uniform()), angle = random.uniform();
        const glm::dvec2 p = printed(radius * glm::dvec2(std::cos(2 * std::numbers::pi * angle),
                                                         std::sin(2 * std::numbers::pi * angle)));
        const bool apart = std::all_of(stored.begin(), stored.end(), [&](glm::dvec2 other) {
            return glm::distance(p, other) >= distance;
        });
        if (!apart || glm::length(p) > 1 - distance / 2 ||
            glm::distance(p, rotated(p, 1)) < distance)
            continue;
        points.push_back(p);
        for (int r = 0; r < poissonRotations; ++r)
            stored.push_back(rotated(p, r));
    }
    return points;
}

// Chooses the rotations of points [first, last) so that the sum of all distances among points
// [0, last) is largest; the rotations of those before `first` are fixed. Tries all combinations but
// those that could not win even if every distance still to come were the largest it can be.
class Rotations {
  public:
    Rotations(std::vector<glm::dvec2>& points, int first, int last)
        : points_(points), first_(first), count_(last - first) {
        for (int i = 0; i < count_; ++i)
            for (int r = 0; r < poissonRotations; ++r)
                turned_[at(i)][at(r)] = rotated(points[at(first + i)], r);
        for (int i = count_ - 1; i >= 0; --i) {
            amongRest_[at(i)] = amongRest_[at(i + 1)];
            for (int j = i + 1; j < count_; ++j) {
                double largest = 0; // only the difference of two rotations matters
                for (const glm::dvec2& p : turned_[at(i)])
                    largest = std::max(largest, glm::distance(p, turned_[at(j)][0]));
                amongRest_[at(i)] += largest;
            }
        }
    }
    void choose() {
        Distances toFixed{};
        for (int i = 0; i < first_; ++i)
            add(toFixed, 0, points_[at(i)]);
        search(0, 0, toFixed);
        for (int i = 0; i < count_; ++i)
            points_[at(first_ + i)] = printed(turned_[at(i)][at(best_[at(i)])]);
    }

  private:
    template <typename T>
    using PerRotation = std::array<std::array<T, poissonRotations>, group>;
    using Distances = PerRotation<double>; // of each point, so turned, to all points decided on

    static std::size_t at(int i) { return static_cast<std::size_t>(i); }

    void add(Distances& distances, int from, glm::dvec2 point) const {
        for (int i = from; i < count_; ++i)
            for (int r = 0; r < poissonRotations; ++r)
                distances[at(i)][at(r)] += glm::distance(turned_[at(i)][at(r)], point);
    }
    void search(int depth, double sum, const Distances& decided) {
        double most = sum + amongRest_[at(depth)];
        for (int i = depth; i < count_; ++i)
            most += *std::max_element(decided[at(i)].begin(), decided[at(i)].end());
        if (most <= largest_ + 1e-9)
            return;
        if (depth == count_) {
            largest_ = sum;
            best_ = chosen_;
            return;
        }
        // Turning the whole set changes no distance, so its very first point may stay.
        const int choices = first_ + depth == 0 ? 1 : poissonRotations;
        for (int r = 0; r < choices; ++r) {
            chosen_[at(depth)] = r;
            Distances next = decided;
            add(next, depth + 1, turned_[at(depth)][at(r)]);
            search(depth + 1, sum + decided[at(depth)][at(r)], next);
        }
    }

    std::vector<glm::dvec2>& points_;
    int first_, count_;
    PerRotation<glm::dvec2> turned_{};
    std::array<double, group + 1> amongRest_{}; // at most, among the points from this one on
    std::array<int, group> chosen_{}, best_{};
    double largest_ = -1;
};

} // namespace

double leastDistance(std::span<const glm::dvec2> points) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i; j < points.size(); ++j)
            for (int r = i == j ? 1 : 0; r < poissonRotations; ++r)
                least = std::min(least, glm::distance(points[i], rotated(points[j], r)));
    return least;
}

std::uint32_t zOrder(glm::dvec2 point) {
    const auto cell = [](double value) {
        return static_cast<std::uint32_t>(std::clamp((value + 1) / 2, 0.0, 1.0) * 65535);
    };
    const std::uint32_t x = cell(point.x), y = cell(point.y);
    std::uint32_t result = 0;
    for (unsigned bit = 0; bit < 16; ++bit)
        result |= (x >> bit & 1U) << (2 * bit) | (y >> bit & 1U) << (2 * bit + 1);
    return result;
}

std::vector<glm::dvec2> poissonSet(int size, std::uint64_t seed) {
    Random random(seed, fmt::format("poisson set/{}", size));
    // More than fits: hexagonal packing of that many points would need at least this much.
    double distance = std::sqrt(4 / (poissonRotations * static_cast<double>(size)));
    std::vector<glm::dvec2> points;
    while (static_cast<int>((points = throwDarts(size, distance, random)).size()) < size)
        distance *= 0.99;
    for (int first = 0; first < size; first += group)
        Rotations(points, first, std::min(first + group, size)).choose();
    std::sort(points.begin(), points.end(),
              [](glm::dvec2 a, glm::dvec2 b) { return zOrder(a) < zOrder(b); });
    return points;
}

std::string poissonTable(std::uint64_t seed) {
    std::string text =
        fmt::format("// Made by `obscura-poisson-sets {} > renderer/techniques/poisson_sets.h`;\n"
                    "// renderer/techniques/poisson.h says what it is.\n"
                    "// clang-format off\n#pragma once\n\nnamespace obscura {{\n\n"
                    "constexpr unsigned poissonSeed = {};\n\n"
                    "// x, y; the sets one after another, so the set of n begins at n - 2.\n"
                    "constexpr double poissonSets[][2] = {{\n",
                    seed, seed);
    for (const int size : poissonSizes) {
        const std::vector<glm::dvec2> points = poissonSet(size, seed);
        text += fmt::format("    // {} points, no two closer than {:.4f} over all rotations\n",
                            size, std::floor(leastDistance(points) * 1e4) / 1e4);
        for (const glm::dvec2& p : points)
            text += fmt::format("    {{{:9.6f}, {:9.6f}}},\n", p.x, p.y);
    }
    return text + "};\n\n} // namespace obscura\n";
}

} // namespace obscura
