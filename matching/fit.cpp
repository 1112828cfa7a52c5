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

// A curve that flattens must save a tenth of the mean square. What it saves less than that on
// training views, it often loses on others (docs/techniques.md).
constexpr double flatteningCost = 1 / 0.9;

// Those of powers above 0 and below; exp() is between, and among both.
enum class Curves { toBlack, flattening };

// What a remap is fitted by: the logarithm of the one value that is free; or, where both are, the
// logarithm of intensity x |power| (how fast visibility falls at first) and asinh(1 / power) (how
// it goes on: above 0 to black, at 0 as exp(), below 0 flattening).
class RemapObjective {
  public:
    RemapObjective(const Comparison& comparison, const Tunable& tunable, Curves curves,
                   Criterion criterion)
        : comparison_(comparison), tunable_(tunable), criterion_(criterion) {
        const Remap& start = tunable.start;
        if (bothFree()) {
            const double bend = std::asinh(1 / tunable.power->low);
            axes_ = {{std::log(0.01), std::log(1000), std::log(start.intensity * size(start))},
                     {curves == Curves::flattening ? -bend : 0.0,
                      curves == Curves::toBlack ? bend : 0.0, std::asinh(1 / start.power)}};
        } else if (const auto& range = tunable.intensity ? tunable.intensity : tunable.power) {
            axes_ = {{std::log(range->low), std::log(range->high),
                      std::log(tunable.intensity ? start.intensity : size(start))}};
        }
        for (Axis& axis : axes_) {
            startsInside_ &= axis.low <= axis.start && axis.start <= axis.high;
            axis.start = std::clamp(axis.start, axis.low, axis.high);
        }
        // Mean occlusion grows along the first axis, so that follows from the rest.
        if (criterion == Criterion::equalMean && !axes_.empty()) {
            solved_ = axes_.front();
            axes_.erase(axes_.begin());
        }
    }

    std::size_t dimensions() const { return axes_.size(); }
    std::vector<double> low() const { return ofAxes(&Axis::low); }
    std::vector<double> high() const { return ofAxes(&Axis::high); }
    std::vector<double> start() const { return ofAxes(&Axis::start); }

    Remap remap(const std::vector<double>& at) const {
        if (!solved_)
            return startsInside_ && at == start() ? tunable_.start : remapOf(at);
        std::vector<double> all{0};
        all.insert(all.end(), at.begin(), at.end());
        all[0] = solve(all);
        return remapOf(all);
    }

    double operator()(const std::vector<double>& at) const {
        const Remap tried = remap(at);
        double error = comparison_.meanSquare(tried);
        if (criterion_ == Criterion::equalMean) {
            const double difference = comparison_.meanDifference(tried);
            error += meanPenalty * difference * difference;
        }
        return error;
    }

  private:
    struct Axis {
        double low, high, start;
    };

    static double size(const Remap& remap) { return std::abs(remap.power); }
    bool bothFree() const { return tunable_.intensity && tunable_.power; }
    std::vector<double> ofAxes(double Axis::*value) const {
        std::vector<double> result;
        for (const Axis& axis : axes_)
            result.push_back(axis.*value);
        return result;
    }

    // Of all axes, the solved one included.
    Remap remapOf(const std::vector<double>& at) const {
        Remap result = tunable_.start;
        if (bothFree()) {
            double inverse = std::sinh(at[1]);
            inverse = std::copysign(std::max(std::abs(inverse), 1 / tunable_.power->high), inverse);
            result.power = 1 / inverse;
            result.intensity = std::clamp(std::exp(at[0]) * std::abs(inverse),
                                          tunable_.intensity->low, tunable_.intensity->high);
        } else if (tunable_.intensity) {
            result.intensity = std::exp(at[0]);
        } else if (tunable_.power) {
            result.power = std::copysign(std::exp(at[0]), result.power);
        }
        return result;
    }

    // Where on the solved axis the target's mean is met, or the end that comes nearest.
    double solve(std::vector<double> at) const {
        const auto difference = [&](double value) {
            at[0] = value;
            return comparison_.meanDifference(remapOf(at));
        };
        const double atLow = difference(solved_->low), atHigh = difference(solved_->high);
        if (atLow * atHigh >= 0)
            return std::abs(atLow) < std::abs(atHigh) ? solved_->low : solved_->high;
        std::uintmax_t steps = 60;
        const auto [left, right] = boost::math::tools::toms748_solve(
            difference, solved_->low, solved_->high, atLow, atHigh,
            boost::math::tools::eps_tolerance<double>(30), steps);
        return (left + right) / 2;
    }

    const Comparison& comparison_;
    Tunable tunable_;
    Criterion criterion_;
    std::vector<Axis> axes_;
    std::optional<Axis> solved_;
    bool startsInside_ = true;
};

// The best point of a grid over the bounds, and the start.
std::vector<double> coarsely(const RemapObjective& objective) {
    constexpr int steps = 13;
    const std::vector<double> low = objective.low(), high = objective.high();
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

FittedRemap fitAmong(Curves curves, const Comparison& comparison, const Tunable& tunable,
                     Criterion criterion) {
    RemapObjective objective(comparison, tunable, curves, criterion);
    std::vector<double> at = coarsely(objective);
    if (objective.dimensions() > 0) {
        nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(objective.dimensions()));
        search.set_min_objective(
            [](const std::vector<double>& x, std::vector<double>&, void* data) {
                return (*static_cast<RemapObjective*>(data))(x);
            },
            &objective);
        const std::vector<double> low = objective.low(), high = objective.high();
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

} // namespace

double remapped(double visibility, const Remap& remap) {
    const double occlusion = std::copysign(remap.intensity, remap.power) * (1 - visibility);
    return std::min(std::pow(std::max(1 - occlusion, 0.0), remap.power), 1.0);
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
    FittedRemap best = fitAmong(Curves::toBlack, comparison, tunable, criterion);
    if (!tunable.intensity || !tunable.power)
        return best;
    FittedRemap flat = fitAmong(Curves::flattening, comparison, tunable, criterion);
    flat.error *= flatteningCost;
    return flat.error < best.error - tie ? flat : best;
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

std::vector<double> fitScales(const std::function<double(const std::vector<double>&)>& error,
                              const std::vector<double>& start, const std::vector<Range>& ranges) {
    std::vector<double> best = start;
    double least = error(start);
    std::function<double(const std::vector<double>&)> atOctaves = [&](const auto& x) {
        std::vector<double> at;
        for (std::size_t i = 0; i < x.size(); ++i)
            at.push_back(std::clamp(std::exp2(x[i]), ranges[i].low, ranges[i].high));
        const double found = error(at);
        if (found < least - tie) {
            least = found;
            best = at;
        }
        return found;
    };
    std::vector<double> octaves, low, high;
    for (std::size_t i = 0; i < start.size(); ++i) {
        octaves.push_back(std::log2(start[i]));
        low.push_back(std::log2(ranges[i].low));
        high.push_back(std::log2(ranges[i].high));
    }
    nlopt::opt search(nlopt::LN_NELDERMEAD, static_cast<unsigned>(start.size()));
    search.set_min_objective(
        [](const std::vector<double>& x, std::vector<double>&, void* data) {
            return (*static_cast<decltype(atOctaves)*>(data))(x);
        },
        &atOctaves);
    search.set_lower_bounds(low);
    search.set_upper_bounds(high);
    search.set_initial_step(0.5);
    search.set_xtol_abs(0.03);
    search.set_maxeval(fitScalesEvaluations);
    double unused = 0;
    try {
        search.optimize(octaves, unused);
    } catch (const nlopt::roundoff_limited&) { // flat: what was found stands
    }
    return best;
}

} // namespace obscura
