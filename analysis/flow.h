#pragma once

#include "analysis/answers.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// From those who began to those whose answers count (CONSORT's flow diagram: Schulz, Altman, Moher,
// BMJ 340 (2010) c332), as far as the study's folder knows. How many were invited it does not.
struct Flow {
    struct Loss {
        std::string reason;
        int count = 0;
    };
    std::optional<int> begun;     // sessions, by the ledger; absent without one
    std::vector<Loss> unanswered; // of those, sessions without any answer
    std::vector<Loss> excluded;   // whole sessions, by reason; numbers in it are left out
    std::vector<Loss> leftOut;    // single trials, by reason
    int participants = 0, sessions = 0, trials = 0; // whose answers count

    static int sum(const std::vector<Loss>& losses);
};

// `participants` and `sessions`: those whose answers count.
Flow flowOf(const Answers& answers, int participants, int sessions);

} // namespace obscura
