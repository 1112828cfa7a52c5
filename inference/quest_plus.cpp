#include "inference/quest_plus.h"

#include "base/error.h"

#include "inference/psychometric.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using Eigen::Index;

void checkList(const std::vector<double>& values, const char* name, double least, double below) {
    const auto inRange = [&](double value) { return value >= least && value < below; };
    if (values.empty() || !std::all_of(values.begin(), values.end(), inRange) ||
        std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) != values.end())
        throw Error(fmt::format("{} of a grid: expected numbers that rise, from {} on and below {}",
                                name, least, below));
}

void check(const QuestGrid& grid) {
    constexpr double most = 1e300, tiny = 1e-300;
    const double least = grid.curve == Sigmoid::weibull ? tiny : -most;
    checkList(grid.levels, "levels", grid.curve == Sigmoid::weibull ? 0 : -most, most);
    checkList(grid.thresholds, "thresholds", least, most);
    checkList(grid.slopes, "slopes", tiny, most);
    checkList(grid.guesses, "guesses", 0, 1);
    checkList(grid.lapses, "lapses", 0, 1);
    if (grid.guesses.back() + grid.lapses.back() >= 1)
        throw Error("expected rates of guesses and lapses of less than 1 together");
}

double negativeXLogX(double x) { return x > 0 ? -x * std::log(x) : 0; }

double entropyOf(double success) { return negativeXLogX(success) + negativeXLogX(1 - success); }

// `count` values from `low` to `high`, each as much more than the one before.
std::vector<double> evenly(double low, double high, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i)
        values.push_back(low + (high - low) * i / (count - 1));
    return values;
}

// Borders of the values' cells: midway, and as far beyond the first and the last.
std::vector<double> bordersOf(const std::vector<double>& values) {
    std::vector<double> borders(values.size() + 1, values.front());
    for (std::size_t i = 1; i < values.size(); ++i)
        borders[i] = (values[i - 1] + values[i]) / 2;
    if (values.size() > 1)
        borders.front() = 2 * values.front() - borders[1];
    borders.back() = values.size() > 1 ? 2 * values.back() - borders[values.size() - 1] //
                                       : values.back();
    return borders;
}

double quantileOf(const std::vector<double>& borders, const std::vector<double>& mass, double p) {
    double below = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) {
        if (below + mass[i] >= p && mass[i] > 0)
            return borders[i] + (borders[i + 1] - borders[i]) * (p - below) / mass[i];
        below += mass[i];
    }
    return borders.back();
}

} // namespace

QuestGrid questGrid(const std::vector<double>& levels, double guess) {
    QuestGrid grid{.levels = levels,
                   .thresholds = evenly(levels.front(), levels.back(), 61),
                   .slopes = {},
                   .guesses = {guess},
                   .lapses = {0, 0.03, 0.06}};
    const double range = levels.back() - levels.front();
    for (const double octaves : evenly(1, 6, 11))
        grid.slopes.push_back(std::exp2(octaves) / range);
    return grid;
}

QuestPlus::QuestPlus(QuestGrid grid) : grid_(std::move(grid)) {
    check(grid_);
    const auto levels = static_cast<Index>(grid_.levels.size());
    const auto combinations = static_cast<Index>(grid_.thresholds.size() * grid_.slopes.size() *
                                                 grid_.guesses.size() * grid_.lapses.size());
    success_.resize(levels, combinations);
    noise_.resize(levels, combinations);
    const auto value = [&](QuestParameter parameter, Index combination) {
        return valuesOf(parameter)[static_cast<std::size_t>(indexOf(parameter, combination))];
    };
    for (Index i = 0; i < combinations; ++i) {
        const PsychometricModel model{grid_.curve, value(QuestParameter::guess, i), {}};
        const Psychometric parameters{value(QuestParameter::threshold, i),
                                      value(QuestParameter::slope, i),
                                      value(QuestParameter::lapse, i)};
        for (Index level = 0; level < levels; ++level) {
            const double p =
                probability(model, parameters, grid_.levels[static_cast<std::size_t>(level)]);
            success_(level, i) = p;
            noise_(level, i) = entropyOf(p);
        }
    }
    posterior_.setConstant(combinations, 1.0 / static_cast<double>(combinations));
}

const std::vector<double>& QuestPlus::valuesOf(QuestParameter parameter) const {
    switch (parameter) {
    case QuestParameter::threshold:
        return grid_.thresholds;
    case QuestParameter::slope:
        return grid_.slopes;
    case QuestParameter::guess:
        return grid_.guesses;
    case QuestParameter::lapse:
        break;
    }
    return grid_.lapses;
}

// Combinations are counted with the threshold going round slowest.
int QuestPlus::indexOf(QuestParameter parameter, Index combination) const {
    Index rest = combination;
    for (const QuestParameter faster : {QuestParameter::lapse, QuestParameter::guess,
                                        QuestParameter::slope, QuestParameter::threshold}) {
        const auto count = static_cast<Index>(valuesOf(faster).size());
        if (faster == parameter)
            return static_cast<int>(rest % count);
        rest /= count;
    }
    return 0;
}

// The mutual information of the answer and the combination: the entropy of the answer, less what
// of it would remain if the combination were known.
Eigen::VectorXd QuestPlus::gains() const {
    return (success_ * posterior_).unaryExpr(&entropyOf) - noise_ * posterior_;
}

int QuestPlus::next() const {
    const Eigen::VectorXd gain = gains();
    return static_cast<int>(std::max_element(gain.begin(), gain.end()) - gain.begin());
}

double QuestPlus::expectedEntropy(int level) const {
    return posterior_.unaryExpr(&negativeXLogX).sum() - gains()[level];
}

void QuestPlus::answer(int level, bool success) {
    const auto likelihood = success_.row(level).transpose().array();
    if (success)
        posterior_.array() *= likelihood;
    else
        posterior_.array() *= 1 - likelihood;
    const double sum = posterior_.sum();
    if (!(sum > 0))
        throw Error("an answer that no combination of the grid allows; give it lapses");
    posterior_ /= sum;
}

QuestEstimate QuestPlus::estimate(QuestParameter parameter, double confidence) const {
    std::vector<double> values = valuesOf(parameter);
    if (parameter == QuestParameter::threshold && grid_.curve == Sigmoid::weibull)
        for (double& value : values)
            value = std::log10(value);
    std::vector<double> mass(values.size());
    for (Index i = 0; i < posterior_.size(); ++i)
        mass[static_cast<std::size_t>(indexOf(parameter, i))] += posterior_[i];
    const std::vector<double> borders = bordersOf(values);
    QuestEstimate estimate;
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double middle = (borders[i] + borders[i + 1]) / 2,
                     width = borders[i + 1] - borders[i];
        mean += mass[i] * middle;
        square += mass[i] * (middle * middle + width * width / 12);
    }
    estimate.sd = std::sqrt(std::max(0.0, square - mean * mean));
    estimate.median = quantileOf(borders, mass, 0.5);
    estimate.interval = {quantileOf(borders, mass, (1 - confidence) / 2),
                         quantileOf(borders, mass, (1 + confidence) / 2)};
    return estimate;
}

double QuestPlus::mode(QuestParameter parameter) const {
    const Index best = std::max_element(posterior_.begin(), posterior_.end()) - posterior_.begin();
    return valuesOf(parameter)[static_cast<std::size_t>(indexOf(parameter, best))];
}

} // namespace obscura
