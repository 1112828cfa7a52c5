#include "analysis/plan/simulation.h"

#include "base/parallel.h"

#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>

namespace obscura {

namespace {

// Mean 0, standard deviation 1: below `limit` with the probability that it is to have.
double limitOf(double share) {
    constexpr double sure = 1e-12;
    return probit(std::clamp(share, sure, 1 - sure));
}

Symbol personOf(int number) { return Symbol(fmt::format("P{}", number)); }

} // namespace

ClaimSimulation::ClaimSimulation(const Protocol& protocol, std::vector<Claim> claims)
    : claims_(std::move(claims)), repeats_(protocol.ordering.repeats) {
    std::set<std::string> named;
    for (const Claim& claim : claims_)
        named.insert(claim.conditions.begin(), claim.conditions.end());
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i) {
        const Condition& condition = protocol.conditions[i];
        if (!named.contains(condition.id))
            continue;
        Tally tally;
        tally.condition = condition.id;
        tally.level = condition.level;
        tally.scene = condition.view;
        tally.hypothesis = tally.family = condition.hypothesis;
        tally.techniqueA = condition.roles.at(0).technique;
        tally.techniqueB = condition.roles.at(1).technique;
        tallies_.push_back(tally);
        conditions_.push_back(i);
        Answer answer;
        answer.row.studyId = Symbol(protocol.name);
        answer.row.conditionId = Symbol(condition.id);
        row_.push_back(answer);
    }
}

std::vector<ClaimResult> ClaimSimulation::study(int people, const std::vector<Shares>& shares,
                                                double spread, Random& random) const {
    // P(leaning + noise > 0) has the mean share: the leaning's variance is added to the noise's.
    const double deviation = spread * probit(0.75);
    const double whole = std::sqrt(1 + deviation * deviation);
    std::vector<Tally> tallies = tallies_;
    std::vector<Answer> answers;
    answers.reserve(static_cast<std::size_t>(people * repeats_) * tallies.size());
    for (int person = 1; person <= people; ++person) {
        const Symbol name = personOf(person);
        const double leaning = deviation * random.normal();
        for (std::size_t i = 0; i < tallies.size(); ++i)
            for (int repeat = 1; repeat <= repeats_; ++repeat) {
                Answer answer = row_[i];
                answer.row.participantId = name;
                answer.row.repeatIndex = repeat;
                const Shares& here = shares[conditions_[i]];
                const double pull = leaning + random.normal();
                answer.row.choseB = limitOf(here.b) * whole + pull > 0;
                if (!answer.row.choseB && limitOf(here.b + here.unsure) * whole + pull > 0)
                    continue;
                ++(answer.row.choseB ? tallies[i].votes.b : tallies[i].votes.a);
                answers.push_back(answer);
            }
    }
    return testClaims(claims_, tallies, &answers);
}

std::vector<int> countStudies(const ClaimSimulation& simulation, int studies, std::uint64_t seed,
                              int people, const std::vector<Shares>& shares, double spread,
                              const std::function<bool(const ClaimResult&)>& holds) {
    std::vector<std::atomic<int>> counts(simulation.claims().size());
    forEachInParallel(studies, [&](int study) {
        Random random(seed, fmt::format("plan/study {}", study));
        const auto results = simulation.study(people, shares, spread, random);
        for (std::size_t i = 0; i < results.size(); ++i)
            counts[i] += holds(results[i]);
    });
    return {counts.begin(), counts.end()};
}

} // namespace obscura
