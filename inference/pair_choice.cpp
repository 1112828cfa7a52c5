#include "inference/pair_choice.h"

#include "inference/glm.h"
#include "inference/tails.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace obscura {

namespace {

double negativeXLogX(double x) { return x > 0 ? -x * std::log(x) : 0; }

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

// An answer depends on the difference d of the two alone. What it says of all items is therefore
// what it says of d: the entropy of the answer less its mean entropy where d is known. The mean
// over d, a normal curve, is a sum at equal steps, exact to more than ten digits for a curve so
// smooth.
double expectedGain(const PairPosterior& posterior, int item, int other) {
    constexpr double reach = 7; // standard deviations
    constexpr int steps = 56;
    const auto& covariance = posterior.covariance;
    const double mean = jodUnit * (posterior.mean(item) - posterior.mean(other));
    const double sd = jodUnit * std::sqrt(covariance(item, item) + covariance(other, other) -
                                          2 * covariance(item, other));
    double success = 0, noise = 0, weights = 0;
    for (int i = -steps; i <= steps; ++i) {
        const double z = reach * i / steps, weight = std::exp(-z * z / 2);
        const Distribution at = distribution(Link::probit, mean + sd * z);
        weights += weight;
        success += weight * at.below;
        noise += weight * (negativeXLogX(at.below) + negativeXLogX(at.above));
    }
    success /= weights;
    return negativeXLogX(success) + negativeXLogX(1 - success) - noise / weights;
}

std::vector<int> nextBatch(const PairPosterior& posterior, std::span<const ItemPair> pairs) {
    std::vector<double> gains;
    for (const auto& [item, other] : pairs)
        gains.push_back(expectedGain(posterior, item, other));
    std::vector<int> order(pairs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int one, int other) {
        return gains[static_cast<std::size_t>(one)] > gains[static_cast<std::size_t>(other)];
    });
    Sets sets(posterior.mean.size()); // Kruskal, Proc. Am. Math. Soc. 7 (1956) 48
    std::erase_if(order, [&](int index) {
        const auto& [item, other] = pairs[static_cast<std::size_t>(index)];
        return !sets.join(item, other);
    });
    return order;
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
