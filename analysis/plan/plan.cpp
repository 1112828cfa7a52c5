#include "analysis/plan/plan.h"

#include "analysis/plan/simulation.h"
#include "analysis/verdict.h"
#include "protocols/reader/balance.h"

#include "inference/equivalence.h"
#include "inference/power.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace obscura {

namespace {

using Kind = Claim::Kind;

// Of the planned number: where claims are simulated, besides there.
constexpr double multiples[] = {0.5, 1, 1.5, 2, 3, 4};

bool isSupported(const ClaimResult& result) {
    return result.outcome == ClaimResult::Outcome::supported;
}

Chance chanceOf(int successes, int studies) {
    return {static_cast<double>(successes) / studies, clopperPearson(successes, studies)};
}

// Of one claim, as the first of its family.
class TestPlan {
  public:
    TestPlan(const Protocol& protocol, const Claim& claim, int family, const PlanOptions& options)
        : protocol_(protocol), claim_(claim), options_(options), level_(significance / family),
          simulation_(protocol, {claim}) {
        const bool once = protocol.ordering.repeats == 1;
        exact_ = once && (claim.kind == Kind::equivalent ||
                          (claim.kind == Kind::superior && claim.conditions.size() == 1));
    }

    bool exact() const { return exact_; }

    Chance power(int people, double share) const {
        if (!exact_) {
            const auto holds = [this](const ClaimResult& result) { return isFound(result); };
            return chanceOf(countStudies(simulation_, options_.studies, options_.seed, people,
                                         sharesFor(share), options_.spread, holds)
                                .front(),
                            options_.studies);
        }
        if (claim_.kind == Kind::superior)
            return {obscura::power(exactP, people, share, level_), {}};
        return {std::pow(equivalencePower(people, claim_.margin, share, level_), conditions()), {}};
    }

    // People from whom on the power is never below the target.
    std::optional<std::int64_t> needed(double share, double target) const {
        if (!exact_)
            return std::nullopt;
        if (claim_.kind == Kind::superior)
            return sampleSize(exactP, share, target, level_);
        return equivalenceSampleSize(claim_.margin, share, std::pow(target, 1 / conditions()),
                                     level_);
    }

    // The smallest share above 1/2 that is found with the wanted power.
    std::optional<double> detectable(int people) const {
        if (claim_.kind == Kind::equivalent || power(people, 1).share < options_.power)
            return std::nullopt;
        double low = 0.5, high = 1;
        while (high - low > 0.001) {
            const double middle = (low + high) / 2;
            (power(people, middle).share < options_.power ? low : high) = middle;
        }
        return high;
    }

    EffectPower at(int people, double share) const {
        return {share, power(people, share), needed(share, options_.power), needed(share, 0.9)};
    }

    // Of the claimed role, where the claim is exact, of one condition, and nobody is unsure.
    std::optional<double> predictedShare(const std::vector<PredictedPair>& pairs) const {
        for (const PredictedPair& pair : pairs)
            if (exact_ && claim_.conditions == std::vector{pair.condition} && pair.unsure == 0)
                return claim_.favours == "a" && claim_.kind != Kind::equivalent ? 1 - pair.shareB
                                                                                : pair.shareB;
        return std::nullopt;
    }

    std::vector<double> effects() const {
        if (claim_.kind == Kind::equivalent)
            return {0.5, 0.5 + claim_.margin / 4, 0.5 + claim_.margin / 2};
        return {0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85};
    }

  private:
    double conditions() const { return static_cast<double>(claim_.conditions.size()); }

    bool isFound(const ClaimResult& result) const {
        if (!result.test || result.test->p > level_)
            return false;
        const double even = result.measure.starts_with("share") ? 0.5 : 0;
        return claim_.kind == Kind::equivalent || result.estimate.value_or(even) > even;
    }

    // Of b in each of the protocol's conditions.
    std::vector<Shares> sharesFor(double share) const {
        const bool ofA = claim_.favours == "a" && claim_.kind != Kind::equivalent;
        std::vector<Shares> shares(protocol_.conditions.size());
        for (std::size_t i = 0; i < shares.size(); ++i)
            for (std::size_t j = 0; j < claim_.conditions.size(); ++j) {
                if (protocol_.conditions[i].id != claim_.conditions[j])
                    continue;
                double here = share;
                if (claim_.kind == Kind::trend) {
                    const auto [low, high] =
                        std::minmax_element(claim_.scores.begin(), claim_.scores.end());
                    here = 1 - share + (2 * share - 1) * (claim_.scores[j] - *low) / (*high - *low);
                }
                shares[i].b = ofA ? 1 - here : here;
            }
        return shares;
    }

    const Protocol& protocol_;
    const Claim& claim_;
    const PlanOptions& options_;
    double level_;
    bool exact_ = true;
    ClaimSimulation simulation_;
};

int familySize(const std::vector<Claim>& claims, const std::string& family) {
    return static_cast<int>(std::count_if(
        claims.begin(), claims.end(), [&](const Claim& claim) { return claim.family == family; }));
}

PlannedTest planTest(const Protocol& protocol, const std::vector<Claim>& claims, std::size_t index,
                     const Plan& whole) {
    PlannedTest test;
    test.claim = claims[index];
    test.family = familySize(claims, test.claim.family);
    const TestPlan plan(protocol, claims[index], test.family, whole.options);
    test.exact = plan.exact();
    for (const double share : plan.effects())
        test.effects.push_back(plan.at(whole.people, share));
    if (const auto share = plan.predictedShare(whole.predicted))
        test.predicted = plan.at(whole.people, *share);
    test.detectable = plan.detectable(whole.people);
    return test;
}

// In the order of the protocol's conditions.
std::vector<Shares> statedShares(const Protocol& protocol,
                                 const std::vector<PredictedPair>& predicted) {
    std::vector<Shares> shares;
    for (const Condition& condition : protocol.conditions) {
        shares.push_back({condition.simulated.chooseB, 0});
        for (const PredictedPair& pair : predicted)
            if (pair.condition == condition.id)
                shares.back() = {pair.shareB, pair.unsure};
    }
    return shares;
}

StatedPower statedPower(const std::vector<Shares>& shares, const ClaimSimulation& simulation,
                        int people, const PlanOptions& options) {
    StatedPower stated{people, {}};
    for (const int count : countStudies(simulation, options.studies, options.seed, people, shares,
                                        options.spread, isSupported))
        stated.supported.push_back(chanceOf(count, options.studies));
    return stated;
}

int roundedUp(int number, int step) { return (number + step - 1) / step * step; }

// Seconds for which a phase lasts on average, as simulated people have it (experiment/simulated.h).
double secondsOf(const Phase& phase, const Simulation& model) {
    const double decision = model.decision.mean + model.decision.tail;
    if (!phase.questions.empty())
        return decision * static_cast<double>(phase.questions.size());
    const double counted = phase.seconds + phase.frames / 60.0;
    if (counted > 0)
        return counted;
    return std::max(phase.atLeast,
                    phase.images.empty() ? decision : model.view.mean + model.view.tail);
}

int trialsOf(const Protocol& protocol) {
    const Ordering& ordering = protocol.ordering;
    const int main = ordering.scheme == OrderScheme::staircase
                         ? ordering.staircase.trials
                         : ordering.repeats * static_cast<int>(mainConditions(protocol).size());
    const int catches = ordering.catchEvery > 0 ? (main - 1) / ordering.catchEvery : 0;
    return main + catches + static_cast<int>(ordering.practice.size());
}

} // namespace

double jodOf(double share) { return probit(share) / probit(0.75); }

std::vector<Claim> plannedClaims(const Protocol& protocol) {
    if (!protocol.claims.empty())
        return protocol.claims;
    std::vector<Claim> claims;
    for (const int index : mainConditions(protocol)) {
        const Condition& condition = protocol.conditions[static_cast<std::size_t>(index)];
        if (condition.roles.size() != 2)
            continue;
        Claim claim;
        claim.name = fmt::format("{}: {} over {}", condition.id, condition.roles[1].technique,
                                 condition.roles[0].technique);
        claim.conditions = {condition.id};
        claim.family = condition.hypothesis;
        claims.push_back(claim);
    }
    return claims;
}

Plan planOf(const Protocol& protocol, PlanOptions options,
            const std::function<void(double)>& progress, const Manifest* stimuli) {
    const std::vector<Claim> claims = plannedClaims(protocol);
    if (claims.empty())
        throw Error({protocol.path.string(), 0, 0, {}},
                    "expected conditions that are pairs of a and b, whose power can be planned, "
                    "found none");
    Plan plan;
    plan.people = options.participants > 0 ? options.participants : protocol.ordering.participants;
    plan.balance = balancedSlots(protocol);
    plan.balanced = roundedUp(plan.people, plan.balance);
    plan.invited = static_cast<int>(std::ceil(plan.balanced / (1 - options.dropout) - 1e-9));
    plan.declared = !protocol.claims.empty();
    plan.trials = trialsOf(protocol);
    for (const Phase& phase : phasesOf(protocol.trial))
        plan.minutes += plan.trials * secondsOf(phase, protocol.simulation) / 60;
    plan.options = options;
    if (stimuli) {
        plan.predicted = predictedPairs(protocol, *stimuli);
        plan.predictedOn = stimuli->display ? inWords(*stimuli->display) : "a display unknown";
        plan.lapse = protocol.simulation.lapse;
        plan.positionBias = protocol.simulation.positionBias;
    }

    std::set<int> numbers = {plan.people};
    for (const double multiple : multiples)
        numbers.insert(
            roundedUp(static_cast<int>(std::ceil(plan.people * multiple)), plan.balance));
    const double steps = static_cast<double>(claims.size() + numbers.size());
    double done = 0;
    const auto step = [&] {
        if (progress)
            progress(++done / steps);
    };
    for (std::size_t i = 0; i < claims.size(); ++i) {
        plan.tests.push_back(planTest(protocol, claims, i, plan));
        step();
    }
    const ClaimSimulation simulation(protocol, claims);
    const std::vector<Shares> shares = statedShares(protocol, plan.predicted);
    for (const int people : numbers) {
        plan.stated.push_back(statedPower(shares, simulation, people, options));
        step();
    }
    return plan;
}

} // namespace obscura
