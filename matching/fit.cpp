#include "matching/fit.h"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <nlopt.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace obscura {

namespace {

// Of occlusion, so that half-float images lose nothing that matters.
constexpr double binsPerUnit = 1024;
constexpr std::size_t binCount = 16384;

// An unmet mean must cost more than any gain in squares, yet leave a slope towards it.
constexpr double meanPenalty = 100;

// Errors that differ by less are the same: where the data do not say, what was given stays.
constexpr double tie = 1e-9;

// What a remap is fitted by: logarithms of the values that are free.
class RemapObjective {
  public:
    RemapObjective(const Comparison& comparison, const Tunable& tunable, Criterion criterion)
        : comparison_(comparison), start_(tunable.start), criterion_(criterion) {
        if (tunable.intensity)
            free_.push_back({&Remap::intensity, *tunable.intensity});
        if (tunable.power)
            free_.push_back({&Remap::power, *tunable.power});
        // Mean occlusion grows with either value, so the first follows from the rest.
        if (criterion == Criterion::equalMean && !free_.empty()) {
            solved_ = free_.front();
            free_.erase(free_.begin());
        }
    }

    std::size_t dimensions() const { return free_.size(); }
    std::vector<double> bounds(double Range::*end) const {
        std::vector<double> result;
        for (const Free& value : free_)
            result.push_back(std::log(value.range.*end));
        return result;
    }
    std::vector<double> start() const {
        std::vector<double> result;
        for (const Free& value : free_)
            result.push_back(
                std::log(std::clamp(start_.*value.member, value.range.low, value.range.high)));
        return result;
    }

    Remap remap(const std::vector<double>& logarithms) const {
        Remap result = start_;
        for (std::size_t i = 0; i < free_.size(); ++i)
            result.*free_[i].member = std::exp(logarithms[i]);
        if (solved_)
            result.*solved_->member = solve(result);
        return result;
    }

    double operator()(const std::vector<double>& logarithms) const {
        const Remap tried = remap(logarithms);
        double error = comparison_.meanSquare(tried);
        if (criterion_ == Criterion::equalMean) {
            const double difference = comparison_.meanDifference(tried);
            error += meanPenalty * difference * difference;
        }
        return error;
    }

  private:
    struct Free {
        double Remap::*member;
        Range range;
    };

    // The value that gives the target's mean, or the end of the range that comes nearest.
    double solve(Remap remap) const {
        const auto difference = [&](double logarithm) {
            remap.*solved_->member = std::exp(logarithm);
            return comparison_.meanDifference(remap);
        };
        const double low = std::log(solved_->range.low), high = std::log(solved_->range.high);
        const double atLow = difference(low), atHigh = difference(high);
        if (atLow * atHigh >= 0)
            return std::abs(atLow) < std::abs(atHigh) ? solved_->range.low : solved_->range.high;
        std::uintmax_t steps = 60;
        const auto [left, right] =
            boost::math::tools::toms748_solve(difference, low, high, atLow, atHigh,
                                              boost::math::tools::eps_tolerance<double>(30), steps);
        return std::exp((left + right) / 2);
    }

    const Comparison& comparison_;
    Remap start_;
    Criterion criterion_;
    std::vector<Free> free_;
    std::optional<Free> solved_;
};

// The best point of a grid over the bounds, and the start.
std::vector<double> coarsely(const RemapObjective& objective) {
    constexpr int steps = 9;
    const auto low = objective.bounds(&Range::low), high = objective.bounds(&Range::high);
    std::vector<double> best = objective.start();
    double least = objective(best);
    int points = 1;
    for (std::size_t i = 0; i < low.size(); ++i)
        points *= steps;
    for (int point = 0; point < points; ++point) {
        std::vector<double> at = low;
        int digits = point;
        for (std::size_t i = 0; i < at.size(); ++i, digits /= steps)
            at[i] += (high[i] - low[i]) * (digits % steps) / (steps - 1);
        if (const double error = objective(at); error < least - tie) {
            least = error;
            best = at;
        }
    }
    return best;
}

} // namespace

double remapped(double visibility, const Remap& remap) {
    return std::min(std::pow(std::max(1 - remap.intensity * (1 - visibility), 0.0), remap.power),
                    1.0);
}

void Comparison::add(const Image& image, double probe, const Image& target,
                     const std::vector<bool>& shown) {
    assert(image.pixels.size() == target.pixels.size());
    const auto pixels = static_cast<double>(std::count(shown.begin(), shown.end(), true));
    bins_.resize(binCount);
    ++views_;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (!shown[i])
            continue;
        const double occlusion = (1 - static_cast<double>(image.pixels[i])) / probe;
        const double wanted = static_cast<double>(target.pixels[i]);
        const double at = std::clamp(occlusion * binsPerUnit + 0.5, 0.0, binCount - 1.0);
        Bin& bin = bins_[static_cast<std::size_t>(at)];
        bin.weight += 1 / pixels;
        bin.occlusion += occlusion / pixels;
        bin.target += wanted / pixels;
        squares_ += wanted * wanted / pixels;
    }
}

double Comparison::meanSquare(const Remap& remap) const {
    double sum = squares_;
    for (const Bin& bin : bins_)
        if (bin.weight > 0) {
            const double value = remapped(1 - bin.occlusion / bin.weight, remap);
            sum += value * (value * bin.weight - 2 * bin.target);
        }
    return views_ ? std::max(sum, 0.0) / views_ : 0;
}

double Comparison::meanDifference(const Remap& remap) const {
    double sum = 0;
    for (const Bin& bin : bins_)
        if (bin.weight > 0)
            sum += remapped(1 - bin.occlusion / bin.weight, remap) * bin.weight - bin.target;
    return views_ ? sum / views_ : 0;
}

bool Comparison::constant() const {
    const auto used = [](const Bin& bin) { return bin.weight > 0; };
    const auto first = std::find_if(bins_.begin(), bins_.end(), used);
    const auto last = std::find_if(bins_.rbegin(), bins_.rend(), used);
    return first == bins_.end() || last.base() - first <= 2; // two neighbours: rounding
}

FittedRemap fitRemap(const Comparison& comparison, const Tunable& tunable, Criterion criterion) {
    RemapObjective objective(comparison, tunable, criterion);
    std::vector<double> at = coarsely(objective);
    if (objective.dimensions() > 0) {
        nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(objective.dimensions()));
        search.set_min_objective(
            [](const std::vector<double>& x, std::vector<double>&, void* data) {
                return (*static_cast<RemapObjective*>(data))(x);
            },
            &objective);
        const auto low = objective.bounds(&Range::low), high = objective.bounds(&Range::high);
        search.set_lower_bounds(low);
        search.set_upper_bounds(high);
        search.set_initial_step(0.3);
        search.set_xtol_abs(1e-4);
        search.set_maxeval(500);
        std::vector<double> moved = at;
        for (std::size_t i = 0; i < at.size(); ++i) // a grid's end, rounded, may lie outside
            moved[i] = std::clamp(at[i], low[i], high[i]);
        double error = 0;
        search.optimize(moved, error);
        if (error < objective(at) - tie)
            at = moved;
    }
    return {objective.remap(at), objective(at)};
}

double fitMultiplier(const std::function<double(double)>& error, double start, Range range) {
    std::map<double, double> known; // error by logarithm to base 2, relative to the start
    const double low = std::log2(range.low / start), high = std::log2(range.high / start);
    const auto at = [&](double octave) {
        const auto found = known.find(octave);
        return found != known.end()
                   ? found->second
                   : known[octave] =
                         error(std::clamp(start * std::exp2(octave), range.low, range.high));
    };
    const auto least = [&] {
        const auto nearer = [](const auto& a, const auto& b) { // the start wins a tie
            return a.second < b.second - tie ||
                   (a.second < b.second + tie && std::abs(a.first) < std::abs(b.first));
        };
        return std::min_element(known.begin(), known.end(), nearer)->first;
    };
    for (const double octave : {0, -1, 1, -2, 2})
        if (octave >= low && octave <= high)
            at(octave);
    while (known.begin()->first > low && least() == known.begin()->first)
        at(std::max(known.begin()->first - 1, low));
    while (known.rbegin()->first < high && least() == known.rbegin()->first)
        at(std::min(known.rbegin()->first + 1, high));
    std::uintmax_t evaluations = 8;
    const double centre = least();
    // Brent's tolerance is relative to the argument, which may be 0: shifted to be near 1.
    boost::math::tools::brent_find_minima([&](double shifted) { return at(shifted - 16); },
                                          std::max(centre - 1, low) + 16,
                                          std::min(centre + 1, high) + 16, 10, evaluations);
    return std::clamp(start * std::exp2(least()), range.low, range.high);
}

} // namespace obscura
