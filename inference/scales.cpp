#include "inference/scales.h"

#include "base/error.h"

#include "inference/glm.h"
#include "inference/tails.h"
#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace obscura {

void checkWins(const Wins& wins) {
    const auto rows = wins.rows();
    if (rows < 2 || rows != wins.cols())
        throw Error(
            fmt::format("expected a square matrix of wins of at least 2 items, found {} x {}", rows,
                        wins.cols()));
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < rows; ++j)
            if (!(wins(i, j) >= 0) || std::isinf(wins(i, j)) || (i == j && wins(i, j) != 0))
                throw Error(fmt::format("wins({}, {}): expected a number of votes, 0 or more (an "
                                        "item cannot win against itself), found {}",
                                        i, j, wins(i, j)));
}

namespace {

using Reach = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;

// From which items which others can be reached along the edges (Warshall 1962).
Reach closure(Reach reach) {
    for (int k = 0; k < reach.rows(); ++k)
        for (int i = 0; i < reach.rows(); ++i)
            if (reach(i, k))
                for (int j = 0; j < reach.rows(); ++j)
                    reach(i, j) = reach(i, j) || reach(k, j);
    return reach;
}

// Sets of items that reach one another.
std::vector<std::vector<int>> mutual(const Reach& reach) {
    std::vector<std::vector<int>> sets;
    std::vector<bool> isTaken(static_cast<std::size_t>(reach.rows()));
    for (int i = 0; i < reach.rows(); ++i) {
        if (isTaken[static_cast<std::size_t>(i)])
            continue;
        auto& set = sets.emplace_back();
        for (int j = i; j < reach.rows(); ++j)
            if (i == j || (reach(i, j) && reach(j, i))) {
                set.push_back(j);
                isTaken[static_cast<std::size_t>(j)] = true;
            }
    }
    return sets;
}

// Fitting would never end without: one tier, or a prior and one group.
bool isFinite(const Wins& wins, bool hasPrior) {
    const Connection connected = connection(wins);
    return hasPrior ? connected.groups.size() == 1 : connected.tiers.size() == 1;
}

std::optional<double> checkedPrior(std::optional<double> sd) {
    if (sd && !(*sd > 0 && std::isfinite(*sd)))
        throw Error(fmt::format("expected a prior's standard deviation above 0, found {}", *sd));
    return sd;
}

// Every pair compared is a row of tallies. Without a prior item 0 stays at 0 and item i is
// coefficient i - 1; with one, which ties the level down, it is i.
BinomialData pairRows(const Wins& wins, bool hasPrior) {
    const auto items = static_cast<int>(wins.rows());
    const int first = hasPrior ? 0 : 1, rows = items * (items - 1) / 2;
    BinomialData data{.design = Eigen::MatrixXd::Zero(rows, items - first),
                      .successes = Eigen::VectorXd(rows),
                      .trials = Eigen::VectorXd(rows)};
    int row = 0;
    for (int i = 0; i < items; ++i)
        for (int j = 0; j < i; ++j, ++row) {
            data.design(row, i - first) = 1;
            if (j >= first)
                data.design(row, j - first) = -1;
            data.successes(row) = wins(i, j);
            data.trials(row) = wins(i, j) + wins(j, i);
        }
    return data;
}

void addDeviances(Scale& scale, const Wins& wins, Link link) {
    double saturated = 0, equal = 0;
    int pairs = 0;
    for (int i = 0; i < wins.rows(); ++i)
        for (int j = 0; j < i; ++j) {
            const double total = wins(i, j) + wins(j, i);
            if (total == 0)
                continue;
            ++pairs;
            scale.logLikelihood +=
                evidence(link, scale.values(i) - scale.values(j), wins(i, j), total).value;
            saturated +=
                xLogX(wins(i, j), wins(i, j) / total) + xLogX(wins(j, i), wins(j, i) / total);
            equal -= total * std::numbers::ln2;
        }
    scale.deviance = std::max(0.0, 2 * (saturated - scale.logLikelihood));
    scale.nullDeviance = std::max(0.0, 2 * (saturated - equal));
    scale.freedom = pairs - static_cast<int>(wins.rows()) + 1;
}

std::optional<Scale> pairScale(const Wins& wins, Link link, std::optional<double> priorSd) {
    checkWins(wins);
    if (!isFinite(wins, checkedPrior(priorSd).has_value()))
        return std::nullopt;
    GlmOptions options{.link = link};
    const auto items = wins.rows();
    if (priorSd)
        options.priorPrecision = Eigen::MatrixXd::Identity(items, items) / (*priorSd * *priorSd);
    const GlmFit fit = fitGlm(pairRows(wins, priorSd.has_value()), options);
    if (!fit.converged)
        return std::nullopt;
    const auto fixed = items - fit.coefficients.size();
    Eigen::VectorXd values = Eigen::VectorXd::Zero(items);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(items, items);
    values.tail(items - fixed) = fit.coefficients;
    covariance.bottomRightCorner(items - fixed, items - fixed) = fit.covariance;
    Scale scale{.values = values.array() - values.mean(), .covariance = centred(covariance)};
    addDeviances(scale, wins, link);
    return scale;
}

Test chiSquareTest(double statistic, int freedom) {
    return {statistic, freedom, chiSquareP(statistic, freedom)};
}

void checkItem(const Scale& scale, int item) {
    if (item < 0 || item >= scale.values.size())
        throw Error(
            fmt::format("expected an item from 0 to {}, found {}", scale.values.size() - 1, item));
}

} // namespace

double xLogX(double x, double y) { return x == 0 ? 0 : x * std::log(y); }

Connection connection(const Wins& wins) {
    checkWins(wins);
    const Reach beats = wins.array() > 0;
    const Reach compared = beats.array() || beats.transpose().array();
    const Reach above = closure(beats);
    Connection result{mutual(closure(compared)), mutual(above)};
    // A tier above another reaches more items: everything that the other reaches, and the other.
    const auto reached = [&](const std::vector<int>& tier) {
        std::ptrdiff_t count = 0;
        for (int j = 0; j < above.cols(); ++j)
            count += above(tier.front(), j) || j == tier.front() ? 1 : 0;
        return count;
    };
    std::stable_sort(result.tiers.begin(), result.tiers.end(),
                     [&](const auto& a, const auto& b) { return reached(a) > reached(b); });
    return result;
}

Eigen::MatrixXd centred(const Eigen::MatrixXd& covariance) {
    const Eigen::MatrixXd rows = covariance.rowwise() - covariance.colwise().mean();
    return rows.colwise() - rows.rowwise().mean();
}

Scale inUnits(Scale scale, double unit) {
    scale.values /= unit;
    scale.covariance /= unit * unit;
    return scale;
}

std::optional<Scale> bradleyTerry(const Wins& wins, std::optional<double> priorSd) {
    return pairScale(wins, Link::logit, priorSd);
}

std::optional<Scale> thurstone(const Wins& wins, std::optional<double> priorSd) {
    if (priorSd)
        priorSd = *priorSd * jodUnit;
    const auto scale = pairScale(wins, Link::probit, priorSd);
    return scale ? std::optional(inUnits(*scale, jodUnit)) : std::nullopt;
}

std::optional<Eigen::VectorXd> thurstoneLeastSquares(const Wins& wins) {
    if (connection(wins).groups.size() > 1)
        return std::nullopt;
    const auto items = wins.rows();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Ones(items, items); // the sum is 0
    Eigen::VectorXd right = Eigen::VectorXd::Zero(items);
    for (int i = 0; i < items; ++i)
        for (int j = 0; j < items; ++j) {
            const double total = wins(i, j) + wins(j, i);
            if (total == 0)
                continue;
            if (wins(i, j) == 0 || wins(j, i) == 0)
                return std::nullopt;
            normal(i, i) += 1;
            normal(i, j) -= 1;
            const double tail = quantile(Link::probit, std::min(wins(i, j), wins(j, i)) / total);
            right(i) += wins(i, j) < wins(j, i) ? tail : -tail;
        }
    return normal.llt().solve(right) / jodUnit;
}

std::optional<Test> mosteller(const Wins& wins, const Eigen::VectorXd& jods) {
    checkWins(wins);
    if (jods.size() != wins.rows())
        throw Error(fmt::format("expected {} values, one for each item, found {}", wins.rows(),
                                jods.size()));
    double statistic = 0;
    int freedom = 1 - static_cast<int>(wins.rows());
    for (int i = 0; i < wins.rows(); ++i)
        for (int j = 0; j < i; ++j) {
            const double total = wins(i, j) + wins(j, i);
            if (total == 0)
                continue;
            const double predicted =
                distribution(Link::probit, jodUnit * (jods(i) - jods(j))).below;
            const double apart =
                std::asin(std::sqrt(wins(i, j) / total)) - std::asin(std::sqrt(predicted));
            statistic += 4 * total * apart * apart;
            ++freedom;
        }
    return freedom > 0 ? std::optional(chiSquareTest(statistic, freedom)) : std::nullopt;
}

Scale relativeTo(const Scale& scale, int reference) {
    checkItem(scale, reference);
    Scale result = scale;
    result.values.array() -= scale.values(reference);
    const Eigen::MatrixXd rows = scale.covariance.rowwise() - scale.covariance.row(reference);
    result.covariance = rows.colwise() - rows.col(reference);
    return result;
}

Estimate difference(const Scale& scale, int item, int other) {
    checkItem(scale, item);
    checkItem(scale, other);
    const double variance = scale.covariance(item, item) + scale.covariance(other, other) -
                            2 * scale.covariance(item, other);
    return {scale.values(item) - scale.values(other), std::sqrt(std::max(0.0, variance))};
}

Test differenceTest(const Scale& scale, int item, int other) {
    if (item == other)
        throw Error(fmt::format("expected two items to compare, found item {} twice", item));
    const Estimate estimate = difference(scale, item, other);
    const double z = estimate.value / estimate.standardError;
    return {z, {}, normalP(z)};
}

std::optional<Test> fitTest(const Scale& scale) {
    if (scale.freedom <= 0)
        return std::nullopt;
    return chiSquareTest(scale.deviance, scale.freedom);
}

Test equalityTest(const Scale& scale) {
    return chiSquareTest(std::max(0.0, scale.nullDeviance - scale.deviance),
                         static_cast<int>(scale.values.size()) - 1);
}

} // namespace obscura
