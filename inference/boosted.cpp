#include "inference/boosted.h"

#include "base/error.h"

#include "inference/likelihood.h"
#include "inference/newton.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

double valueOf(const Predictor& predictor, const Eigen::VectorXd& parameters) {
    double value = 0;
    for (const Term& term : predictor)
        value += parameters(term.parameter) * term.factor;
    return value;
}

// Parameters: x of all items but the source, then the polynomial's two.
class Model {
  public:
    Model(const Wins& boosted, const Wins& plain, int source) : boosted_(boosted), plain_(plain) {
        for (int item = 0; item < boosted.rows(); ++item) {
            items_.emplace_back();
            if (item != source)
                items_.back().push_back({item < source ? item : item - 1, 1});
        }
        const int others = static_cast<int>(boosted.rows()) - 1;
        linear_ = {{others, 1}};
        quadratic_ = {{others + 1, 1}};
    }

    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient,
                      Eigen::MatrixXd& hessian) const {
        double value = 0;
        for (std::size_t i = 0; i < items_.size(); ++i)
            for (std::size_t j = 0; j < items_.size(); ++j)
                value += addPair(i, j, x, gradient, hessian);
        return value;
    }

    // d y / d parameters, a row for each item.
    Eigen::MatrixXd slopes(const Eigen::VectorXd& x) const {
        const auto others = static_cast<Eigen::Index>(items_.size()) - 1;
        Eigen::MatrixXd result = Eigen::MatrixXd::Zero(others + 1, others + 2);
        for (std::size_t item = 0; item < items_.size(); ++item) {
            const auto row = static_cast<Eigen::Index>(item);
            const double at = valueOf(items_[item], x);
            for (const Term& term : items_[item])
                result(row, term.parameter) = x(others) + 2 * x(others + 1) * at;
            result(row, others) = at;
            result(row, others + 1) = at * at;
        }
        return result;
    }

    Eigen::VectorXd boostedValues(const Eigen::VectorXd& x) const {
        Eigen::VectorXd values(static_cast<Eigen::Index>(items_.size()));
        for (std::size_t item = 0; item < items_.size(); ++item)
            values(static_cast<Eigen::Index>(item)) = valueOf(items_[item], x);
        return values;
    }

  private:
    double addPair(std::size_t i, std::size_t j, const Eigen::VectorXd& x,
                   Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) const {
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        const double seen = boosted_(row, column), seenPlain = plain_(row, column);
        if (seen + seenPlain == 0)
            return 0;
        using Local = Jet<4>;
        const Local xi = Local::variable(valueOf(items_[i], x), 0);
        const Local xj = Local::variable(valueOf(items_[j], x), 1);
        const Local linear = Local::variable(valueOf(linear_, x), 2);
        const Local quadratic = Local::variable(valueOf(quadratic_, x), 3);
        const Local apart = xi - xj;
        const Local plainApart = linear * apart + quadratic * (apart * (xi + xj));
        const Local log = seen * logProbability(Link::probit, jodUnit * apart) +
                          seenPlain * logProbability(Link::probit, jodUnit * plainApart);
        return add<4>(-log, {&items_[i], &items_[j], &linear_, &quadratic_}, gradient, hessian);
    }

    const Wins& boosted_;
    const Wins& plain_;
    std::vector<Predictor> items_;
    Predictor linear_, quadratic_;
};

Eigen::VectorXd startOf(const Scale& boosted, int source) {
    const auto others = boosted.values.size() - 1;
    Eigen::VectorXd start = Eigen::VectorXd::Zero(others + 2);
    const Eigen::VectorXd values = boosted.values.array() - boosted.values(source);
    start.head(source) = values.head(source);
    start.segment(source, others - source) = values.tail(others - source);
    start(others) = 1;
    return start;
}

double logLikelihoodLimit(const Wins& wins) {
    double sum = 0;
    for (int i = 0; i < wins.rows(); ++i)
        for (int j = 0; j < wins.cols(); ++j)
            sum += xLogX(wins(i, j), wins(i, j) / (wins(i, j) + wins(j, i)));
    return sum;
}

int pairsOf(const Wins& wins) {
    return static_cast<int>(((wins + wins.transpose()).array() > 0).count() / 2);
}

} // namespace

std::optional<BoostedScale> boostedScale(const Wins& boosted, const Wins& plain, int source) {
    checkWins(boosted);
    checkWins(plain);
    if (plain.rows() != boosted.rows() || source < 0 || source >= boosted.rows())
        throw Error(fmt::format("expected plain and boosted votes of the same items and a source "
                                "among them, found {} and {} items and source {}",
                                plain.rows(), boosted.rows(), source));
    const auto alone = thurstone(boosted);
    if (!alone)
        return std::nullopt;
    const Model model(boosted, plain, source);
    const auto minimum = minimise(model, startOf(*alone, source));
    if (!minimum)
        return std::nullopt;

    const auto last = minimum->at.size() - 1;
    const auto estimate = [&](Eigen::Index parameter) {
        return Estimate{minimum->at(parameter),
                        std::sqrt(minimum->inverseHessian(parameter, parameter))};
    };
    BoostedScale result;
    result.boosted = model.boostedValues(minimum->at);
    result.linear = estimate(last - 1);
    result.quadratic = estimate(last);
    const Eigen::MatrixXd slopes = model.slopes(minimum->at);
    const auto& x = result.boosted.array();
    result.scale.values = result.linear.value * x + result.quadratic.value * x.square();
    result.scale.covariance = slopes * minimum->inverseHessian * slopes.transpose();
    result.scale.logLikelihood = -minimum->value;
    const double limit = logLikelihoodLimit(boosted) + logLikelihoodLimit(plain);
    result.scale.deviance = std::max(0.0, 2 * (limit + minimum->value));
    result.scale.freedom = pairsOf(boosted) + pairsOf(plain) - static_cast<int>(last) - 1;
    result.scale.nullDeviance = 2 * (limit + std::log(2.0) * (boosted.sum() + plain.sum()));
    const auto slopeAt = [&](double at) {
        return result.linear.value + 2 * result.quadratic.value * at;
    };
    result.isMonotone = slopeAt(x.minCoeff()) > 0 && slopeAt(x.maxCoeff()) > 0;
    return result;
}

} // namespace obscura
