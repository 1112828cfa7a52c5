#include "inference/plackett_luce.h"

#include "base/error.h"

#include "inference/newton.h"
#include <fmt/format.h>

#include <cmath>

namespace obscura {
namespace {

void checkRanking(int items, const Ranking& ranking) {
    std::vector<bool> isSeen(static_cast<std::size_t>(items));
    for (const int item : ranking) {
        if (item < 0 || item >= items)
            throw Error(
                fmt::format("expected items from 0 to {} in a ranking, found {}", items - 1, item));
        if (isSeen[static_cast<std::size_t>(item)])
            throw Error(fmt::format("expected each item once in a ranking, found {} twice", item));
        isSeen[static_cast<std::size_t>(item)] = true;
    }
}

// -log of the probability that the first of `rest` is chosen among them, with derivatives.
double addChoice(std::span<const int> rest, const Eigen::VectorXd& x, Eigen::VectorXd& gradient,
                 Eigen::MatrixXd& hessian) {
    double largest = x(rest.front());
    for (const int item : rest)
        largest = std::max(largest, x(item));
    double sum = 0;
    for (const int item : rest)
        sum += std::exp(x(item) - largest);
    gradient(rest.front()) -= 1;
    for (const int item : rest) {
        const double share = std::exp(x(item) - largest) / sum;
        gradient(item) += share;
        hessian(item, item) += share;
        for (const int other : rest)
            hessian(item, other) -= share * std::exp(x(other) - largest) / sum;
    }
    return std::log(sum) + largest - x(rest.front());
}

double addRankings(std::span<const Ranking> rankings, const Eigen::VectorXd& x,
                   Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) {
    double value = 0;
    for (const Ranking& ranking : rankings)
        for (std::size_t place = 0; place + 1 < ranking.size(); ++place)
            value += addChoice(std::span(ranking).subspan(place), x, gradient, hessian);
    const double sum = x.sum(); // which no choice depends on, is tied to 0
    gradient.array() += sum;
    hessian.array() += 1;
    return value + sum * sum / 2;
}

} // namespace

Wins winsOf(int items, std::span<const Ranking> rankings) {
    Wins wins = Wins::Zero(std::max(items, 0), std::max(items, 0));
    checkWins(wins);
    for (const Ranking& ranking : rankings) {
        checkRanking(items, ranking);
        for (std::size_t above = 0; above < ranking.size(); ++above)
            for (std::size_t below = above + 1; below < ranking.size(); ++below)
                wins(ranking[above], ranking[below]) += 1;
    }
    return wins;
}

std::optional<Scale> plackettLuce(int items, std::span<const Ranking> rankings) {
    if (connection(winsOf(items, rankings)).tiers.size() > 1)
        return std::nullopt;
    const auto objective = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient,
                               Eigen::MatrixXd& hessian) {
        return addRankings(rankings, x, gradient, hessian);
    };
    const auto minimum = minimise(objective, Eigen::VectorXd::Zero(items));
    if (!minimum)
        return std::nullopt;
    double equal = 0;
    for (const Ranking& ranking : rankings)
        equal += std::lgamma(static_cast<double>(ranking.size()) + 1);
    return Scale{.values = minimum->at.array() - minimum->at.mean(),
                 .covariance = centred(minimum->inverseHessian),
                 .logLikelihood = -minimum->value,
                 .deviance = 2 * minimum->value,
                 .freedom = 0,
                 .nullDeviance = 2 * equal};
}

} // namespace obscura
