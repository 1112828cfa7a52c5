#include "inference/pwcmp.h"

#include "base/error.h"

#include "inference/link.h"
#include "inference/optimise.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

constexpr double sigma = 1.4826; // pwcmp's rounding of 1 / probit(0.75)

// The pairs compared, each once; a reversed pair sees the same with the signs changed. `pulled` are
// the wins of i over j as the prior sees them: a unanimous pair is one vote from it.
struct Pairs {
    std::vector<std::pair<int, int>> items;
    Eigen::ArrayXd won, lost, pulledWon, pulledLost;

    explicit Pairs(const Wins& wins) {
        for (int i = 0; i < wins.rows(); ++i)
            for (int j = 0; j < i; ++j)
                if (wins(i, j) + wins(j, i) > 0)
                    items.emplace_back(i, j);
        for (auto* column : {&won, &lost, &pulledWon, &pulledLost})
            column->resize(static_cast<Eigen::Index>(items.size()));
        Eigen::Index row = 0;
        for (const auto& [i, j] : items) {
            won(row) = wins(i, j);
            lost(row) = wins(j, i);
            const double total = won(row) + lost(row);
            pulledWon(row) = won(row) == 0 ? 1 : lost(row) == 0 ? total - 1 : won(row);
            pulledLost(row) = total - pulledWon(row);
            ++row;
        }
    }
};

// log P and log(1 - P) at the distance of each pair, and their slopes.
struct Distances {
    Eigen::ArrayXd logP, logQ, slopeP, slopeQ;

    Distances(const Pairs& pairs, const Eigen::VectorXd& q) {
        for (auto* column : {&logP, &logQ, &slopeP, &slopeQ})
            column->resize(pairs.won.size());
        Eigen::Index row = 0;
        for (const auto& [i, j] : pairs.items) {
            const double z = (q(i) - q(j)) / sigma;
            const Evidence win = evidence(Link::probit, z, 1, 1);
            const Evidence loss = evidence(Link::probit, z, 0, 1);
            logP(row) = win.value;
            logQ(row) = loss.value;
            slopeP(row) = win.slope / sigma;
            slopeQ(row) = loss.slope / sigma;
            ++row;
        }
    }
};

// The share that a distance (row), forward and reversed, has in the likelihood of a pair's votes
// (column) over all distances.
struct Shares {
    Eigen::ArrayXXd forward, reversed;

    Shares(const Distances& at, const Pairs& pairs)
        : forward(outer(at.logP, pairs.pulledWon) + outer(at.logQ, pairs.pulledLost)),
          reversed(outer(at.logQ, pairs.pulledWon) + outer(at.logP, pairs.pulledLost)) {
        const Eigen::ArrayXXd largest =
            forward.colwise().maxCoeff().max(reversed.colwise().maxCoeff());
        const auto rows = forward.rows();
        forward = (forward - largest.replicate(rows, 1)).exp();
        reversed = (reversed - largest.replicate(rows, 1)).exp();
        const Eigen::ArrayXXd sums = forward.colwise().sum() + reversed.colwise().sum();
        forward /= sums.replicate(rows, 1);
        reversed /= sums.replicate(rows, 1);
    }

    static Eigen::ArrayXXd outer(const Eigen::ArrayXd& column, const Eigen::ArrayXd& row) {
        return (column.matrix() * row.matrix().transpose()).array();
    }
};

// Minus the objective of shared golden/human/README.md, with its gradient.
double objective(const Pairs& pairs, const Eigen::VectorXd& q, Eigen::VectorXd& gradient) {
    const Distances at(pairs, q);
    const Shares shares(at, pairs);
    const Eigen::ArrayXd prior =
        shares.forward.rowwise().sum() + shares.reversed.rowwise().sum() + 0.1;
    // Derivatives of the sum of log(prior), over forward and reversed distances, by the log
    // likelihood of each pair's votes at each distance.
    const Eigen::ArrayXd weight = prior.inverse();
    const Eigen::MatrixXd both = (shares.forward + shares.reversed).matrix();
    const Eigen::RowVectorXd mean = weight.matrix().transpose() * both;
    const auto pull = [&](const Eigen::ArrayXXd& part, const Eigen::ArrayXd& votes) {
        const Eigen::ArrayXXd scaled =
            part * (weight.replicate(1, part.cols()) - mean.array().replicate(part.rows(), 1));
        return Eigen::ArrayXd((scaled.matrix() * votes.matrix()).array());
    };
    const Eigen::ArrayXd pulledP =
        pull(shares.forward, pairs.pulledWon) + pull(shares.reversed, pairs.pulledLost);
    const Eigen::ArrayXd pulledQ =
        pull(shares.forward, pairs.pulledLost) + pull(shares.reversed, pairs.pulledWon);
    const Eigen::ArrayXd slope =
        at.slopeP * (pairs.won + pulledP) + at.slopeQ * (pairs.lost + pulledQ);
    gradient.setConstant(q.size(), -0.02 * q.mean() / static_cast<double>(q.size()));
    Eigen::Index row = 0;
    for (const auto& [i, j] : pairs.items) {
        gradient(i) += 2 * slope(row);
        gradient(j) -= 2 * slope(row);
        ++row;
    }
    return 2 * (pairs.won * at.logP + pairs.lost * at.logQ + prior.log()).sum() -
           0.01 * q.mean() * q.mean();
}

// MATLAB's and Octave's quantile (Hyndman and Fan 1996, type 5).
double quantile5(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double last = static_cast<double>(values.size()) - 1;
    const double place = std::clamp(share * static_cast<double>(values.size()) - 0.5, 0.0, last);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    const double part = place - static_cast<double>(below);
    return values[below] + part * (values[above] - values[below]);
}

// Log of the binomial probability of an observer's wins under a scale.
double logLikelihood(const Wins& wins, const Eigen::VectorXd& jods) {
    double sum = 0;
    for (int i = 0; i < wins.rows(); ++i)
        for (int j = 0; j < i; ++j) {
            const double total = wins(i, j) + wins(j, i), z = (jods(i) - jods(j)) / sigma;
            if (total > 0)
                sum += std::lgamma(total + 1) - std::lgamma(wins(i, j) + 1) -
                       std::lgamma(wins(j, i) + 1) +
                       evidence(Link::probit, z, wins(i, j), total).value;
        }
    return sum;
}

void checkScenes(std::span<const std::vector<Wins>> scenes) {
    for (const auto& observers : scenes) {
        if (observers.size() < 2 || observers.size() != scenes.front().size())
            throw Error(
                fmt::format("expected the same observers, at least 2, in every scene, found "
                            "{} and {}",
                            scenes.front().size(), observers.size()));
        for (const Wins& wins : observers) {
            checkWins(wins);
            if (wins.rows() != observers.front().rows())
                throw Error(fmt::format("expected {} items for every observer, found {}",
                                        observers.front().rows(), wins.rows()));
        }
    }
}

} // namespace

std::optional<Eigen::VectorXd> pwcmpScale(const Wins& wins) {
    const auto scale = thurstone(wins);
    if (!scale)
        return std::nullopt;
    return Eigen::VectorXd(scale->values * (jodUnit * sigma));
}

std::optional<Eigen::VectorXd> pwcmpScaleWithPrior(const Wins& wins) {
    if (connection(wins).groups.size() > 1)
        return std::nullopt;
    const auto near = thurstone(wins, 3.0); // a scale with about the right distances and errors
    if (!near)
        return std::nullopt;
    const Pairs pairs(wins);
    const Objective climb = [&](const Eigen::VectorXd& q, Eigen::VectorXd& gradient) {
        return objective(pairs, q, gradient);
    };
    const auto items = wins.rows();
    const Eigen::MatrixXd guess =
        near->covariance + Eigen::MatrixXd::Ones(items, items) / static_cast<double>(items);
    // There may be several maxima: one is sought from zero, as pwcmp does, one from nearby.
    Maximum best = maximise(climb, Eigen::VectorXd::Zero(items), guess);
    const Maximum other = maximise(climb, near->values, guess);
    if (!best.reached || (other.reached && other.value > best.value))
        best = other;
    if (!best.reached)
        return std::nullopt;
    return Eigen::VectorXd(best.at.array() - best.at.mean());
}

std::optional<std::vector<Outlyingness>> outlyingness(std::span<const std::vector<Wins>> scenes) {
    checkScenes(scenes);
    if (scenes.empty())
        return std::nullopt;
    std::vector<Outlyingness> result(scenes.front().size());
    for (const auto& observers : scenes) {
        Wins all = Wins::Zero(observers.front().rows(), observers.front().cols());
        for (const Wins& wins : observers)
            all += wins;
        for (std::size_t observer = 0; observer < observers.size(); ++observer) {
            if (observers[observer].isZero())
                continue;
            const auto others = pwcmpScaleWithPrior(all - observers[observer]);
            if (!others)
                return std::nullopt;
            result[observer].logLikelihood += logLikelihood(observers[observer], *others);
        }
    }
    std::vector<double> values;
    for (const Outlyingness& one : result)
        values.push_back(one.logLikelihood);
    const double lower = quantile5(values, 0.25), range = quantile5(values, 0.75) - lower;
    for (Outlyingness& one : result)
        if (one.logLikelihood < lower && range > 0)
            one.distance = (lower - one.logLikelihood) / range;
    return result;
}

} // namespace obscura
