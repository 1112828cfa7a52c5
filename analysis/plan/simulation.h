#pragma once

#include "analysis/claims.h"
#include "base/random.h"
#include "protocols/reader/protocol.h"

#include <functional>
#include <vector>

namespace obscura {

// Studies whose truth is known, given to the tests of claims. Each person has one leaning towards
// b, the same in all conditions: normal in JOD with the standard deviation `spread`, around a
// centre such that the mean share of people is the one asked for. What differs between people from
// condition to condition besides needs no model: as long as each votes once on a condition, it
// cannot be told from guessing.
struct Shares {
    double b = 0.5;    // 0 ... 1, of all answers
    double unsure = 0; // say "not sure", which is no vote
};

class ClaimSimulation {
  public:
    ClaimSimulation(const Protocol& protocol, std::vector<Claim> claims);

    // `shares`: in the order of the protocol's conditions.
    std::vector<ClaimResult> study(int people, const std::vector<Shares>& shares, double spread,
                                   Random& random) const;

    const std::vector<Claim>& claims() const { return claims_; }

  private:
    std::vector<Claim> claims_;
    std::vector<Tally> tallies_;          // without votes: those of conditions that a claim names
    std::vector<std::size_t> conditions_; // of each tally, in the protocol
    std::vector<Answer> row_;             // of each tally, without an answer
    int repeats_ = 1;
};

// In how many of so many studies each claim `holds`; study i always has the same numbers.
std::vector<int> countStudies(const ClaimSimulation& simulation, int studies, std::uint64_t seed,
                              int people, const std::vector<Shares>& shares, double spread,
                              const std::function<bool(const ClaimResult&)>& holds);

} // namespace obscura
