#pragma once

#include "analysis/plan/predicted.h"
#include "protocols/reader/protocol.h"

#include "inference/result.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What a study can find, before it has run. Its claims are tested as after it (analysis/claims.h);
// without claims, each condition's "b is chosen more often" is, corrected within its hypothesis.

struct PlanOptions {
    int participants = 0; // who finish; 0: as many as the protocol plans
    double power = 0.8;   // wanted, 0.5 ... 0.99
    double dropout = 0.1; // share of the invited who do not finish, 0 ... 0.9
    double spread = 1;    // JOD: standard deviation between people of their preference for b
    int studies = 2000;   // simulated, where no formula is exact
    std::uint64_t seed = 1;
};

// The probability that a claim is supported. Exact, or the share of simulated studies with a
// Monte-Carlo interval (Clopper and Pearson's, 95 %).
struct Chance {
    double share = 0;
    std::optional<Interval> interval;
};

// At one true effect: the share of the claimed role, equal in all of the claim's conditions; for
// a trend its share at the highest score, one minus it at the lowest, linear between.
struct EffectPower {
    double share = 0.5;
    Chance power;                               // at the planned number of people
    std::optional<std::int64_t> needed, ninety; // people for the wanted power, and for 90 %; exact
};

// A claim, tested alone at the level that is left of .05 for the first of its family: Holm's test
// finds no less.
struct PlannedTest {
    Claim claim;
    int family = 1;    // claims that are corrected together
    bool exact = true; // or simulated
    std::vector<EffectPower> effects;
    // At the share of the claimed role that predicted JOD gives (Plan::predicted); only where the
    // test is exact, of one condition, and everybody must choose.
    std::optional<EffectPower> predicted;
    std::optional<double> detectable; // the share that the wanted power finds; none: not even 1
};

// All claims at once, Holm's correction included, where people choose as the protocol's simulated
// ones do: by simulatedPreference, or by predicted JOD.
struct StatedPower {
    int people = 0;
    std::vector<Chance> supported; // of each claim
};

struct Plan {
    int people = 0;       // who finish, as planned
    int balance = 1;      // the ordering is balanced after so many (balancedSlots)
    int balanced = 0;     // people, rounded up to a multiple of it
    int invited = 0;      // so many that the balanced number finish on average
    bool declared = true; // the claims are the protocol's
    double minutes = 0;   // one session: as long as the protocol's simulated people take
    int trials = 0;       // of a session, practice and catch trials included
    PlanOptions options;
    std::vector<PlannedTest> tests;
    std::vector<StatedPower> stated; // at the planned number, and at balanced ones below and above
    std::vector<PredictedPair> predicted; // of each main condition; none without stimuli
    std::string predictedOn;              // the display, in words
    double lapse = 0, positionBias = 0;   // of those who choose by predicted JOD
};

// An Error for a protocol without conditions of pairs. With `stimuli`, people choose by their
// predicted JOD, and without it is an Error. `progress` hears of the share that is done.
Plan planOf(const Protocol& protocol, PlanOptions options,
            const std::function<void(double)>& progress = {}, const Manifest* stimuli = nullptr);

// The claims to plan for.
std::vector<Claim> plannedClaims(const Protocol& protocol);

// The plan in words and tables, for a terminal; ends with a line feed.
std::string planText(const Plan& plan);

// What Plan::predicted says, as a table for a terminal or a page, and a sentence about it; "" where
// it says nothing.
std::string predictedText(const Plan& plan);

// JOD of a share: probit(share) / probit(0.75).
double jodOf(double share);

} // namespace obscura
