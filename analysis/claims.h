#pragma once

#include "analysis/answer.h"
#include "analysis/votes.h"
#include "protocols/reader/claims.h"

#include "inference/result.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What became of a claim that the protocol declares. The tests are of people, each of whom counts
// once:
//   superior    one condition: the exact binomial test of the votes; several: Student's t of the
//               people's shares over them, against 1/2;
//   equivalent  in each condition two exact one-sided tests, all of which must succeed, so that
//               their number needs no correction (Berger, Technometrics 24 (1982) 295);
//   trend       two conditions: McNemar's exact test; several: Student's t of the people's slopes
//               over the scores, against 0.
// Where people voted several times on a condition, t of their shares stands for the tests of votes,
// and where all people's numbers are the same, for which there is no t, the sign test. Published
// counts, whose people nobody knows, have tests of totals, and a note that says so.
struct ClaimResult {
    enum class Outcome { supported, contradicted, undecided, unusable };

    Claim claim;
    Outcome outcome = Outcome::undecided;
    std::string method;             // the test in words, with what it is of
    std::string measure;            // what the estimate is of
    std::optional<double> estimate; // a share or a difference of shares, -1 ... 1
    double noEffect = 0.5; // the estimate's value where there is none: a share's; 0 of a rise's
    std::optional<Interval> interval;
    int confidence = 95; // percent, of the interval: 90 belongs to two one-sided tests at .05
    std::optional<Test> test;
    double holm = 1; // its p, adjusted for the claims of its family
    std::int64_t votes = 0;
    std::int64_t people = 0;        // 0 where they are not known
    std::vector<std::string> notes; // what to know before believing it
    std::string why;                // it is unusable
};
std::string_view nameOf(ClaimResult::Outcome outcome);

// Of each claim in turn. `answers` is null for published counts; those of a condition that the
// tallies lack are none.
std::vector<ClaimResult> testClaims(const std::vector<Claim>& claims,
                                    const std::vector<Tally>& tallies,
                                    const std::vector<Answer>* answers);

// The answer in words, for somebody who knows no statistics; the numbers on which it rests; both.
std::string answerOf(const ClaimResult& result);
std::string groundsOf(const ClaimResult& result);
std::string sentenceOf(const ClaimResult& result);

// Gives each tally the family in which its own test is corrected: the first claim of another kind
// than a trend that names it; "" for those that no claim names, which are exploratory. Without
// claims, they stay as they are: those of the hypotheses. Declared margins of equivalence are the
// tallies', too.
void assignFamilies(std::vector<Tally>& tallies, const std::vector<Claim>& claims);

} // namespace obscura
