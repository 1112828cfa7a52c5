#include "analysis/flow.h"

#include <utility>

namespace obscura {

int Flow::sum(const std::vector<Loss>& losses) {
    int total = 0;
    for (const Loss& loss : losses)
        total += loss.count;
    return total;
}

Flow flowOf(const Answers& answers, int participants, int sessions) {
    Flow flow;
    flow.participants = participants;
    flow.sessions = sessions;
    flow.trials = static_cast<int>(answers.counted.size());
    const LeftOut& out = answers.leftOut;
    for (const auto& [reason, count] :
         {std::pair("interrupted (the window lost the keyboard)", out.interrupted),
          std::pair("answered twice", out.duplicates), std::pair("simulated", out.simulated),
          std::pair("not simulated", out.real), std::pair("rehearsed", out.rehearsed),
          std::pair("unreadable", static_cast<int>(answers.bad.size()))})
        if (count > 0)
            flow.leftOut.push_back({reason, count});
    return flow;
}

} // namespace obscura
