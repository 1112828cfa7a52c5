#include "inference/pair_choice.h"

#include "inference/glm.h"
#include "inference/link.h"
#include "inference/tails.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace obscura {

namespace {

// Items that pairs connect have the same root.
class Sets {
  public:
    explicit Sets(Eigen::Index items) : parent_(static_cast<std::size_t>(items)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int root(int item) const {
        while (at(item) != item)
            item = at(item);
        return item;
    }
    // False where they were one already.
    bool join(int item, int other) {
        const int from = root(item), to = root(other);
        parent_[static_cast<std::size_t>(from)] = to;
        return from != to;
    }

  private:
    int at(int item) const { return parent_[static_cast<std::size_t>(item)]; }
    std::vector<int> parent_;
};

// In the mean over both answers, the covariance falls by this vector's product with itself. An
// answer depends on the difference d of the two alone, in units of its noise. Let d have the mean m
// and the variance v; with t = m / sqrt(1 + v), p = F(t) and f = F'(t) / sqrt(1 + v), its mean
// after the answer has the variance (v f)^2 / (p (1 - p)) over both answers (Rasmussen and
// Williams, "Gaussian Processes for Machine Learning", 2006, eq. 3.85). By as much the variance of
// d falls, and all else by its regression on d.
Eigen::VectorXd effectOf(const PairPosterior& posterior, const ItemPair& pair) {
    const auto& [item, other] = pair;
    const Eigen::VectorXd shared =
        jodUnit * (posterior.covariance.col(item) - posterior.covariance.col(other));
    const double spread = std::sqrt(1 + jodUnit * (shared(item) - shared(other)));
    const double t = jodUnit * (posterior.mean(item) - posterior.mean(other)) / spread;
    const LogTails tails = logTails(Link::probit, t);
    const double slope = std::exp(-(t * t + tails.below + tails.above) / 2);
    return shared * slope / (spread * std::sqrt(2 * std::numbers::pi));
}

} // namespace

PairPosterior pairPosterior(const Wins& wins, double priorSd) {
    checkWins(wins);
    const auto items = wins.rows();
    std::vector<ItemPair> compared;
    for (int i = 0; i < items; ++i)
        for (int j = 0; j < i; ++j)
            if (wins(i, j) + wins(j, i) > 0)
                compared.emplace_back(i, j);
    PairPosterior posterior{Eigen::VectorXd::Zero(items),
                            Eigen::MatrixXd::Identity(items, items) * (priorSd * priorSd)};
    if (compared.empty())
        return posterior;
    const auto rows = static_cast<Eigen::Index>(compared.size());
    BinomialData data{.design = Eigen::MatrixXd::Zero(rows, items),
                      .successes = Eigen::VectorXd(rows),
                      .trials = Eigen::VectorXd(rows)};
    for (Eigen::Index row = 0; row < rows; ++row) {
        const auto [i, j] = compared[static_cast<std::size_t>(row)];
        data.design(row, i) = jodUnit;
        data.design(row, j) = -jodUnit;
        data.successes(row) = wins(i, j);
        data.trials(row) = wins(i, j) + wins(j, i);
    }
    const GlmFit fit = fitGlm(
        data, {.link = Link::probit,
               .priorPrecision = Eigen::MatrixXd::Identity(items, items) / (priorSd * priorSd)});
    posterior.mean = fit.coefficients;
    posterior.covariance = fit.covariance;
    return posterior;
}

double expectedReduction(const PairPosterior& posterior, int item, int other) {
    return effectOf(posterior, {item, other}).squaredNorm();
}

std::vector<int> nextBatch(PairPosterior posterior, std::span<const ItemPair> pairs) {
    Sets sets(posterior.mean.size());
    const auto size = static_cast<std::size_t>(
        std::count_if(pairs.begin(), pairs.end(),
                      [&](const ItemPair& pair) { return sets.join(pair.first, pair.second); }));
    std::vector<int> batch, left(pairs.size());
    std::iota(left.begin(), left.end(), 0);
    while (batch.size() < size) {
        std::vector<double> reductions;
        for (const int index : left) {
            const auto& [item, other] = pairs[static_cast<std::size_t>(index)];
            reductions.push_back(expectedReduction(posterior, item, other));
        }
        const auto best = left.begin() + (std::max_element(reductions.begin(), reductions.end()) -
                                          reductions.begin());
        const Eigen::VectorXd effect = effectOf(posterior, pairs[static_cast<std::size_t>(*best)]);
        posterior.covariance -= effect * effect.transpose();
        batch.push_back(*best);
        left.erase(best);
    }
    return batch;
}

double widestInterval(const PairPosterior& posterior, std::span<const ItemPair> pairs,
                      double confidence) {
    Sets sets(posterior.mean.size());
    for (const auto& [item, other] : pairs)
        sets.join(item, other);
    std::map<int, std::vector<int>> scales;
    for (int item = 0; item < posterior.mean.size(); ++item)
        scales[sets.root(item)].push_back(item);
    double largest = 0; // variance
    for (const auto& [root, items] : scales)
        largest =
            std::max(largest, centred(posterior.covariance(items, items)).diagonal().maxCoeff());
    return 2 * probit((1 + confidence) / 2) * std::sqrt(largest);
}

} // namespace obscura
