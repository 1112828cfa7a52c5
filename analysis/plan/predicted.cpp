#include "analysis/plan/predicted.h"

#include "protocols/reader/balance.h"
#include "protocols/reader/stimuli.h"

#include "inference/thurstone_observer.h"

namespace obscura {

namespace {

bool mayBeUnsure(const Protocol& protocol) {
    for (const Phase& phase : phasesOf(protocol.trial))
        for (const Question& question : phase.questions)
            if (question.images && !question.unsure.empty())
                return true;
    return false;
}

} // namespace

std::vector<PredictedPair> predictedPairs(const Protocol& protocol, const Manifest& stimuli) {
    const ThurstoneObserver observer{protocol.simulation.lapse, protocol.simulation.positionBias};
    const bool mayTie = mayBeUnsure(protocol);
    std::vector<PredictedPair> pairs;
    for (const int index : mainConditions(protocol)) {
        const Condition& condition = protocol.conditions[static_cast<std::size_t>(index)];
        if (condition.roles.size() != 2)
            continue;
        const double a = predictedJod(stimuli, condition.id, "a"),
                     b = predictedJod(stimuli, condition.id, "b");
        const double sign = asksForWorse(protocol, condition, stimuli) ? -1 : 1;
        const PairShares bSecond = observer.shares(sign * a, sign * b, mayTie),
                         bFirst = observer.shares(sign * b, sign * a, mayTie);
        pairs.push_back({condition.id, a, b, (bSecond.second + bFirst.first) / 2,
                         (bSecond.unsure + bFirst.unsure) / 2});
    }
    return pairs;
}

} // namespace obscura
