#pragma once

#include "analysis/votes.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// A p below this is called a difference, or an equivalence.
constexpr double significance = 0.05;

// Without a declared margin, a split is called even where it is shown to be within 1/2 -+ this.
constexpr double undeclaredMargin = 0.05;

// With fewer votes of one condition no split, not even a unanimous one, has an exact p below
// `significance`.
constexpr int fewestVotes = 6;

// Of one condition. Everything that says, shades or marks a difference asks here.
struct Verdict {
    enum class Outcome { differs, equivalent, undecided, unusable };

    double holm = 1;              // any false difference in the family: at most 5 %
    double benjaminiHochberg = 1; // of the differences called so, at most 5 % false on average
    Outcome outcome = Outcome::undecided;
    double margin = 0; // of an equivalence: by exact one-sided tests, within 1/2 -+ margin
    std::string why{}; // it is unusable

    bool differs() const { return outcome == Outcome::differs; } // holm < significance
};
std::string_view nameOf(Verdict::Outcome outcome);

// Where anybody voted several times on a condition, its votes are judged by people's shares.
void judgeByPeople(std::vector<Tally>& tallies, const std::vector<Answer>& answers);

// Of at least one vote: the p that decides, exactP or that of the people, and the interval of the
// share that belongs to it, Clopper and Pearson's or theirs.
double decidingP(const Tally& tally);
Interval intervalOf(const Tally& tally);

// Of each in turn; absent without votes. Adjusted are deciding p, within each family.
std::vector<std::optional<Verdict>> verdictsOf(const std::vector<Tally>& tallies);

} // namespace obscura
