#include "inference/ties.h"

#include "base/error.h"

#include "inference/likelihood.h"
#include "inference/newton.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace obscura {
namespace {

void checkTies(const Wins& wins, const Eigen::MatrixXd& ties) {
    checkWins(wins);
    checkWins(ties);
    if (ties.rows() != wins.rows())
        throw Error(fmt::format("expected ties of {} items, found {}", wins.rows(), ties.rows()));
    if (ties != ties.transpose())
        throw Error("expected as many ties of i and j as of j and i, found others");
}

// Log probability that the first of a pair wins, that the second does, and of a tie, by the
// difference of their values and the (unbounded) parameter of ties.
using Outcome = Jet<2>;
struct Outcomes {
    Outcome first, second, tie;
};
using TieModel = std::function<Outcomes(const Outcome& difference, const Outcome& tie)>;

Outcomes davidsonOutcomes(const Outcome& difference, const Outcome& logNu) {
    const Outcome half = 0.5 * difference;
    const Outcome terms[] = {half, -half, logNu};
    double largest = terms[0].value;
    for (const Outcome& term : terms)
        largest = std::max(largest, term.value);
    Outcome sum;
    for (const Outcome& term : terms)
        sum = sum + exp(term - largest);
    const Outcome logSum =
        sum.through(std::log(sum.value), 1 / sum.value, -1 / (sum.value * sum.value)) + largest;
    return {half - logSum, -half - logSum, logNu - logSum};
}

Outcomes thresholdOutcomes(Link link, const Outcome& difference, const Outcome& logThreshold) {
    const Outcome threshold = exp(logThreshold);
    // F(t - d) - F(-t - d), by logarithms, which are precise in both tails.
    const Outcome upper = logProbability(link, threshold - difference);
    const Outcome lower = logProbability(link, -threshold - difference);
    return {logProbability(link, difference - threshold),
            logProbability(link, -difference - threshold), upper + log1mExp(lower - upper)};
}

CurvedObjective tieObjective(const Wins& wins, const Eigen::MatrixXd& ties, const TieModel& model) {
    return [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) {
        const auto items = static_cast<int>(wins.rows());
        const Predictor tie = {{items, 1}};
        double value = 0;
        for (int i = 0; i < items; ++i)
            for (int j = 0; j < i; ++j) {
                if (wins(i, j) + wins(j, i) + ties(i, j) == 0)
                    continue;
                const Predictor apart = {{i, 1}, {j, -1}};
                const Outcomes log =
                    model(Outcome::variable(x(i) - x(j), 0), Outcome::variable(x(items), 1));
                const Outcome sum =
                    wins(i, j) * log.first + wins(j, i) * log.second + ties(i, j) * log.tie;
                value += add<2>(-sum, {&apart, &tie}, gradient, hessian);
            }
        const double sum = x.head(items).sum(); // which no outcome depends on, is tied to 0
        gradient.head(items).array() += sum;
        hessian.topLeftCorner(items, items).array() += 1;
        return value + sum * sum / 2;
    };
}

struct PairCounts {
    double wins, losses, ties;
    double total() const { return wins + losses + ties; }
    double logLikelihood(double tieShare, double winShare, double lossShare) const {
        return xLogX(wins, winShare) + xLogX(losses, lossShare) + xLogX(ties, tieShare);
    }
};

// Against free shares of the three outcomes for each pair; items equal: half of what is no tie.
void addDeviances(Scale& scale, const Wins& wins, const Eigen::MatrixXd& ties) {
    double saturated = 0, equal = 0;
    int pairs = 0;
    const double tieShare = ties.sum() / 2 / (wins.sum() + ties.sum() / 2);
    for (int i = 0; i < wins.rows(); ++i)
        for (int j = 0; j < i; ++j) {
            const PairCounts pair{wins(i, j), wins(j, i), ties(i, j)};
            const double total = pair.total();
            if (total == 0)
                continue;
            ++pairs;
            saturated +=
                pair.logLikelihood(pair.ties / total, pair.wins / total, pair.losses / total);
            equal += pair.logLikelihood(tieShare, (1 - tieShare) / 2, (1 - tieShare) / 2);
        }
    scale.deviance = std::max(0.0, 2 * (saturated - scale.logLikelihood));
    scale.nullDeviance = std::max(0.0, 2 * (saturated - equal));
    scale.freedom = 2 * pairs - static_cast<int>(wins.rows());
}

// Without ties the maximum lies at the edge, where the model is that without ties.
std::optional<TieScale> withoutTies(std::optional<Scale> scale, const Wins& wins) {
    if (!scale)
        return std::nullopt;
    addDeviances(*scale, wins, Eigen::MatrixXd::Zero(wins.rows(), wins.cols()));
    return TieScale{std::move(*scale), std::nullopt};
}

// `parameter` is the logarithm of what is reported: its standard error is relative.
std::optional<TieScale> tieScale(const Wins& wins, const Eigen::MatrixXd& ties,
                                 const TieModel& model) {
    if (connection(wins + ties).tiers.size() > 1 || wins.isZero())
        return std::nullopt;
    const auto items = wins.rows();
    const auto minimum =
        minimise(tieObjective(wins, ties, model), Eigen::VectorXd::Zero(items + 1));
    if (!minimum)
        return std::nullopt;
    const Eigen::VectorXd values = minimum->at.head(items);
    Scale scale{.values = values.array() - values.mean(),
                .covariance = centred(minimum->inverseHessian.topLeftCorner(items, items)),
                .logLikelihood = -minimum->value};
    addDeviances(scale, wins, ties);
    const double tendency = std::exp(minimum->at(items));
    const double error = std::sqrt(minimum->inverseHessian(items, items));
    return TieScale{std::move(scale), Estimate{tendency, tendency * error}};
}

} // namespace

std::optional<TieScale> davidson(const Wins& wins, const Eigen::MatrixXd& ties) {
    checkTies(wins, ties);
    if (ties.isZero())
        return withoutTies(bradleyTerry(wins), wins);
    return tieScale(wins, ties, davidsonOutcomes);
}

std::optional<TieScale> thresholdScale(const Wins& wins, const Eigen::MatrixXd& ties, Link link) {
    checkTies(wins, ties);
    const bool isNormal = link == Link::probit;
    if (ties.isZero())
        return withoutTies(isNormal ? thurstone(wins) : bradleyTerry(wins), wins);
    auto result = tieScale(wins, ties, [link](const Outcome& difference, const Outcome& tie) {
        return thresholdOutcomes(link, difference, tie);
    });
    if (result && isNormal) {
        result->scale = inUnits(std::move(result->scale), jodUnit);
        result->ties->value /= jodUnit;
        result->ties->standardError /= jodUnit;
    }
    return result;
}

} // namespace obscura
