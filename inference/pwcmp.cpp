#include "inference/pwcmp.h"
#include "base/error.h"
#include "inference/newton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

constexpr double sigma = 1.4826; // pwcmp's rounding of 1 / probit(0.75)

// An ordered pair that was compared.
struct Pair {
    int i, j;
    double wins, total; // of i over j
    double pulled;      // the wins as the prior sees them: a unanimous pair is one vote from it
};

std::vector<Pair> orderedPairs(const Wins& wins) {
    std::vector<Pair> pairs;
    for (int j = 0; j < wins.cols(); ++j)
        for (int i = 0; i < wins.rows(); ++i) {
            const double won = wins(i, j), total = won + wins(j, i);
            if (total == 0)
                continue;
            const double pulled = won == 0 ? 1 : won == total ? total - 1 : won;
            pairs.push_back({i, j, won, total, pulled});
        }
    return pairs;
}

// For each pair log P and log(1 - P) at the distance between its members, and their slopes.
struct Distances {
    Eigen::VectorXd logP, logQ, slopeP, slopeQ;

    Distances(const std::vector<Pair>& pairs, const Eigen::VectorXd& q) {
        const auto count = static_cast<Eigen::Index>(pairs.size());
        for (auto* column : {&logP, &logQ, &slopeP, &slopeQ})
            column->resize(count);
        Eigen::Index row = 0;
        for (const Pair& pair : pairs) {
            const double z = (q(pair.i) - q(pair.j)) / sigma;
            const auto p = logProbabilityWithDerivatives(Noise::normal, z);
            const auto complement = logProbabilityWithDerivatives(Noise::normal, -z);
            logP(row) = p.value;
            logQ(row) = complement.value;
            slopeP(row) = p.first / sigma;
            slopeQ(row) = -complement.first / sigma;
            ++row;
        }
    }
};

// Votes as the prior sees them: `pulled` for, the rest of `total` against.
struct PulledVotes {
    Eigen::VectorXd pro, con;
};

// Share of each distance (row) in the likelihood of each pair's votes (column).
Eigen::MatrixXd sharesOf(const Distances& at, const PulledVotes& votes) {
    Eigen::MatrixXd shares =
        at.logP * votes.pro.transpose() + at.logQ * votes.con.transpose();
    shares.rowwise() -= shares.colwise().maxCoeff().eval();
    shares = shares.array().exp();
    shares.array().rowwise() /= shares.colwise().sum().array().eval();
    return shares;
}

Objective priorObjective(const Wins& wins) {
    const std::vector<Pair> pairs = orderedPairs(wins);
    const auto count = static_cast<Eigen::Index>(pairs.size());
    PulledVotes votes{Eigen::VectorXd(count), Eigen::VectorXd(count)};
    Eigen::VectorXd won(count), lost(count);
    for (Eigen::Index row = 0; row < count; ++row) {
        const Pair& pair = pairs[static_cast<std::size_t>(row)];
        votes.pro(row) = pair.pulled;
        votes.con(row) = pair.total - pair.pulled;
        won(row) = pair.wins;
        lost(row) = pair.total - pair.wins;
    }
    return [=](const Eigen::VectorXd& q, Eigen::VectorXd& gradient, Eigen::MatrixXd&) {
        const Distances at(pairs, q);
        const Eigen::MatrixXd shares = sharesOf(at, votes);
        const Eigen::VectorXd prior = shares.rowwise().sum().array() + 0.1;
        const Eigen::VectorXd weight = prior.cwiseInverse();
        // Derivative of the sum of log(prior) by each distance's likelihood of each pair's votes.
        Eigen::MatrixXd pull = (-(weight.transpose() * shares)).replicate(count, 1);
        pull.colwise() += weight;
        pull.array() *= shares.array();
        const Eigen::VectorXd slope = at.slopeP.cwiseProduct(won + pull * votes.pro) +
                                      at.slopeQ.cwiseProduct(lost + pull * votes.con);
        for (Eigen::Index row = 0; row < count; ++row) {
            gradient(pairs[static_cast<std::size_t>(row)].i) -= slope(row);
            gradient(pairs[static_cast<std::size_t>(row)].j) += slope(row);
        }
        gradient.array() += 0.02 * q.mean() / static_cast<double>(q.size());
        return 0.01 * q.mean() * q.mean() - won.dot(at.logP) - lost.dot(at.logQ) -
               prior.array().log().sum();
    };
}

// MATLAB's and Octave's quantile (Hyndman and Fan 1996, type 5).
double quantile5(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double last = static_cast<double>(values.size()) - 1;
    const double place =
        std::clamp(share * static_cast<double>(values.size()) - 0.5, 0.0, last);
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
            if (total == 0)
                continue;
            const double choices = std::lgamma(total + 1) - std::lgamma(wins(i, j) + 1) -
                                   std::lgamma(wins(j, i) + 1);
            sum += choices + wins(i, j) * logProbability(Noise::normal, z) +
                   wins(j, i) * logProbability(Noise::normal, -z);
        }
    return sum;
}

void checkScenes(std::span<const std::vector<Wins>> scenes) {
    for (const auto& observers : scenes) {
        if (observers.size() < 2 || observers.size() != scenes.front().size())
            throw Error(fmt::format("expected the same observers, at least 2, in every scene, found "
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
    const Objective objective = priorObjective(wins);
    // Not convex: from zero, as pwcmp does, and from near the likelihood's maximum.
    auto best = minimiseByGradient(objective, Eigen::VectorXd::Zero(wins.rows()));
    if (const auto near = thurstone(wins, 3.0)) {
        auto other = minimiseByGradient(objective, near->values);
        if (other && (!best || other->value < best->value))
            best = std::move(other);
    }
    if (!best || best->at.maxCoeff() - best->at.minCoeff() > 50)
        return std::nullopt;
    return Eigen::VectorXd(best->at.array() - best->at.mean());
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
