#include "inference/observers.h"

#include "base/error.h"

#include "inference/likelihood.h"
#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace obscura {
namespace {

// Parameters of observer o: bias, log precision, logit lapse.
using Triple = Eigen::Vector3d;

struct State {
    Eigen::VectorXd values;
    std::vector<Triple> observers;
};

struct Count {
    Choice choice;
    double times;
};

std::vector<Count> counted(std::span<const Choice> choices) {
    std::map<std::tuple<int, int, int, bool>, double> counts;
    for (const Choice& c : choices)
        counts[{c.observer, c.first, c.second, c.choseFirst}] += 1;
    std::vector<Count> result;
    for (const auto& [key, times] : counts) {
        const auto [observer, first, second, choseFirst] = key;
        result.push_back({{observer, first, second, choseFirst}, times});
    }
    return result;
}

// -log of an answer's probability by the items' difference, bias, log precision and logit lapse.
Jet<4> surprise(double apart, const Triple& observer, bool choseFirst) {
    using Local = Jet<4>;
    const Local difference = Local::variable(apart, 0), bias = Local::variable(observer(0), 1);
    const Local precision = exp(Local::variable(observer(1), 2));
    const Local logit = Local::variable(observer(2), 3);
    const Local evidence = precision * difference + bias;
    const Local lapse = exp(logProbability(Link::logit, logit));
    const Local attends = exp(logProbability(Link::logit, -logit));
    const Local p =
        0.5 * lapse + attends * exp(logProbability(Link::logit, choseFirst ? evidence : -evidence));
    return -p.through(std::log(p.value), 1 / p.value, -1 / (p.value * p.value));
}

// -log posterior with its gradient and Hessian, which has the shape of an arrow: observers touch
// each other only through the items.
struct Posterior {
    double value = 0;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd items;
    struct Block {
        Triple gradient = Triple::Zero();
        Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
        Eigen::Matrix<double, Eigen::Dynamic, 3> withItems;
    };
    std::vector<Block> blocks;

    Posterior(const State& at, std::span<const Count> counts, const ObserverPriors& priors)
        : gradient(Eigen::VectorXd::Zero(at.values.size())),
          items(Eigen::MatrixXd::Zero(at.values.size(), at.values.size())),
          blocks(at.observers.size()) {
        for (Block& block : blocks)
            block.withItems.setZero(at.values.size(), 3);
        for (const Count& count : counts)
            add(at, count);
        addPriors(at, priors);
    }

    void add(const State& at, const Count& count) {
        const auto [observer, first, second, choseFirst] = count.choice;
        const Triple& person = at.observers[static_cast<std::size_t>(observer)];
        const Jet<4> jet = Jet<4>(count.times) *
                           surprise(at.values(first) - at.values(second), person, choseFirst);
        value += jet.value;
        gradient(first) += jet.first(0);
        gradient(second) -= jet.first(0);
        items(first, first) += jet.second(0, 0);
        items(second, second) += jet.second(0, 0);
        items(first, second) -= jet.second(0, 0);
        items(second, first) -= jet.second(0, 0);
        Block& block = blocks[static_cast<std::size_t>(observer)];
        block.gradient += jet.first.tail<3>();
        block.own += jet.second.bottomRightCorner<3, 3>();
        block.withItems.row(first) += jet.second.topRightCorner<1, 3>();
        block.withItems.row(second) -= jet.second.topRightCorner<1, 3>();
    }

    void addPriors(const State& at, const ObserverPriors& priors) {
        const double precision = 1 / (priors.valueSd * priors.valueSd);
        value += precision * at.values.squaredNorm() / 2;
        gradient += precision * at.values;
        items.diagonal().array() += precision;
        const Triple mean(0, 0, priors.logitLapseMean);
        const Triple weight = Triple(priors.biasSd, priors.logPrecisionSd, priors.logitLapseSd)
                                  .cwiseAbs2()
                                  .cwiseInverse();
        for (std::size_t o = 0; o < blocks.size(); ++o) {
            const Triple away = at.observers[o] - mean;
            value += weight.dot(away.cwiseAbs2()) / 2;
            blocks[o].gradient += weight.cwiseProduct(away);
            blocks[o].own.diagonal() += weight;
        }
    }
};

// The Hessian with its diagonal raised, eliminated observer by observer (Schur's complement).
// Absent where it is not positive definite.
struct Elimination {
    Eigen::LLT<Eigen::MatrixXd> items;
    std::vector<Eigen::Matrix3d> inverses; // of the observers' own blocks

    static std::optional<Elimination> of(const Posterior& posterior, double damping) {
        Elimination result;
        Eigen::MatrixXd complement = posterior.items;
        complement.diagonal() *= 1 + damping;
        for (const Posterior::Block& block : posterior.blocks) {
            Eigen::Matrix3d own = block.own;
            own.diagonal() += damping * own.diagonal().cwiseAbs();
            const Eigen::LLT<Eigen::Matrix3d> factor(own);
            if (factor.info() != Eigen::Success)
                return std::nullopt;
            result.inverses.push_back(factor.solve(Eigen::Matrix3d::Identity()));
            complement -= block.withItems * result.inverses.back() * block.withItems.transpose();
        }
        result.items.compute(complement);
        if (result.items.info() != Eigen::Success)
            return std::nullopt;
        return result;
    }

    State step(const Posterior& posterior) const {
        Eigen::VectorXd right = -posterior.gradient;
        for (std::size_t o = 0; o < inverses.size(); ++o)
            right += posterior.blocks[o].withItems * (inverses[o] * posterior.blocks[o].gradient);
        State move{items.solve(right), {}};
        for (std::size_t o = 0; o < inverses.size(); ++o)
            move.observers.push_back(-inverses[o] *
                                     (posterior.blocks[o].gradient +
                                      posterior.blocks[o].withItems.transpose() * move.values));
        return move;
    }
};

State moved(const State& from, const State& move) {
    State to = from;
    to.values += move.values;
    for (std::size_t o = 0; o < to.observers.size(); ++o)
        to.observers[o] += move.observers[o];
    return to;
}

double descentOf(const Posterior& posterior, const State& move) {
    double sum = -posterior.gradient.dot(move.values);
    for (std::size_t o = 0; o < move.observers.size(); ++o)
        sum -= posterior.blocks[o].gradient.dot(move.observers[o]);
    return sum;
}

struct Mode {
    State at;
    Posterior posterior;
    Elimination elimination;
};

// Newton's steps as minimise() takes them, on a Hessian too large to store.
std::optional<Mode> findMode(State at, std::span<const Count> counts,
                             const ObserverPriors& priors) {
    Posterior posterior(at, counts, priors);
    double damping = 0;
    for (int step = 0; step < 200 && damping < 1e12; ++step) {
        auto elimination = Elimination::of(posterior, damping);
        if (elimination) {
            const State move = elimination->step(posterior);
            if (damping == 0 &&
                descentOf(posterior, move) < 1e-16 * (1 + std::abs(posterior.value)))
                return Mode{std::move(at), std::move(posterior), std::move(*elimination)};
            State next = moved(at, move);
            Posterior there(next, counts, priors);
            if (there.value <= posterior.value + 1e-13 * (1 + std::abs(posterior.value))) {
                at = std::move(next);
                posterior = std::move(there);
                damping = damping < 1e-6 ? 0 : damping / 10;
                continue;
            }
        }
        damping = std::max(1e-4, damping * 10);
    }
    return std::nullopt;
}

Wins winsOf(int items, std::span<const Choice> choices) {
    Wins wins = Wins::Zero(items, items);
    for (const Choice& choice : choices)
        wins(choice.choseFirst ? choice.first : choice.second,
             choice.choseFirst ? choice.second : choice.first) += 1;
    return wins;
}

void check(int items, int observers, std::span<const Choice> choices,
           const ObserverPriors& priors) {
    if (items < 2 || observers < 1)
        throw Error(fmt::format("expected at least 2 items and 1 observer, found {} and {}", items,
                                observers));
    for (const double sd :
         {priors.valueSd, priors.biasSd, priors.logPrecisionSd, priors.logitLapseSd})
        if (!(sd > 0 && std::isfinite(sd)))
            throw Error(fmt::format("expected priors' standard deviations above 0, found {}", sd));
    for (const Choice& c : choices)
        if (c.observer < 0 || c.observer >= observers || std::min(c.first, c.second) < 0 ||
            std::max(c.first, c.second) >= items || c.first == c.second)
            throw Error(fmt::format("expected a choice of an observer from 0 to {} between two of "
                                    "{} items, found observer {} and items {} and {}",
                                    observers - 1, items, c.observer, c.first, c.second));
}

ObserverTraits observerOf(const Triple& at, const Eigen::Matrix3d& covariance) {
    const Triple error = covariance.diagonal().cwiseSqrt();
    const double lapse = distribution(Link::logit, at(2)).below, precision = std::exp(at(1));
    return {{at(0), error(0)},
            {lapse, lapse * (1 - lapse) * error(2)},
            {precision, precision * error(1)}};
}

} // namespace

std::optional<ObserverModel> observerModel(int items, int observers,
                                           std::span<const Choice> choices,
                                           const ObserverPriors& priors) {
    check(items, observers, choices, priors);
    const Wins wins = winsOf(items, choices);
    if (connection(wins).groups.size() > 1)
        return std::nullopt;
    State start{Eigen::VectorXd::Zero(items), {}};
    if (const auto scale = bradleyTerry(wins, priors.valueSd))
        start.values = scale->values;
    start.observers.assign(static_cast<std::size_t>(observers),
                           Triple(0, 0, priors.logitLapseMean));
    const auto mode = findMode(std::move(start), counted(choices), priors);
    if (!mode)
        return std::nullopt;

    const Eigen::MatrixXd covariance =
        mode->elimination.items.solve(Eigen::MatrixXd::Identity(items, items));
    ObserverModel result;
    result.scale.values = mode->at.values.array() - mode->at.values.mean();
    result.scale.covariance = centred(covariance);
    result.logPosterior = -mode->posterior.value;
    for (std::size_t o = 0; o < mode->at.observers.size(); ++o) {
        const Eigen::Matrix3d& inverse = mode->elimination.inverses[o];
        const auto slope = inverse * mode->posterior.blocks[o].withItems.transpose();
        result.observers.push_back(
            observerOf(mode->at.observers[o], inverse + slope * covariance * slope.transpose()));
    }
    return result;
}

} // namespace obscura
