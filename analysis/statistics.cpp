#include "analysis/statistics.h"

#include "inference/equivalence.h"
#include "inference/tails.h"

#include <cmath>

namespace obscura {

namespace {

using Value = std::optional<double>;
using V = Votes;

Interval wilsonOf(Votes v) { return wilson(v.b, v.total()); }
Interval exactOf(Votes v) { return clopperPearson(v.b, v.total()); }
Interval jeffreysOf(Votes v) { return jeffreys(v.b, v.total()); }

// Equivalence within margins and regions that are named by their distance from one half, in
// percent.
template <int percent>
Value equivalent(Votes v) {
    return equivalenceP(v, percent / 100.0);
}

const CountStatistic statistics[] = {
    {"share_b", "", "Share of b",
     [](V v) -> Value { return static_cast<double>(v.b) / static_cast<double>(v.total()); }},
    {"wilson_low", "wilson_lo", "95 % score interval of the share (Wilson 1927)",
     [](V v) -> Value { return wilsonOf(v).low; }},
    {"wilson_high", "wilson_hi", "its upper limit", [](V v) -> Value { return wilsonOf(v).high; }},
    {"clopper_pearson_low", "cp_lo",
     "95 % interval of the share that belongs to the exact test (Clopper and Pearson 1934)",
     [](V v) -> Value { return exactOf(v).low; }},
    {"clopper_pearson_high", "cp_hi", "its upper limit",
     [](V v) -> Value { return exactOf(v).high; }},
    {"jeffreys_low", "jeffreys_lo", "95 % of the posterior of the share under Beta(1/2, 1/2)",
     [](V v) -> Value { return jeffreysOf(v).low; }},
    {"jeffreys_high", "jeffreys_hi", "its upper limit",
     [](V v) -> Value { return jeffreysOf(v).high; }},
    {"chi_square", "chisq", "Against an even split, 1 degree of freedom (Pearson 1900)",
     [](V v) -> Value { return chiSquare(v); }},
    {"p_chi_square", "chisq_p", "its p, too small at such numbers",
     [](V v) -> Value { return chiSquareP(chiSquare(v)); }},
    {"chi_square_yates", "yates", "The same with the correction for continuity (Yates 1934)",
     [](V v) -> Value { return chiSquareYates(v); }},
    {"p_exact", "exact_p", "Two-sided binomial test: the one to trust",
     [](V v) -> Value { return exactP(v); }},
    {"p_mid", "mid_p", "The same with half of the probability of what was seen (Lancaster 1961)",
     [](V v) -> Value { return midP(v); }},
    {"cohen_g", "cohen_g", "Share - 1/2 (Cohen 1988)", [](V v) -> Value { return cohenG(v); }},
    {"cohen_h", "cohen_h", "2 asin sqrt(share) - pi/2", [](V v) -> Value { return cohenH(v); }},
    {"cohen_w", "cohen_w", "sqrt(chi-square / N)", [](V v) -> Value { return cohenW(v); }},
    {"jod", "jod", "How far b lies above a; 1 means that 75 % prefer b", jod},
    {"jod_low", "", "The limit of the exact interval as a JOD; absent where it has no bound",
     [](V v) { return jodLimits(exactOf(v)).low; }},
    {"jod_high", "", "the upper one", [](V v) { return jodLimits(exactOf(v)).high; }},
    {"log_bayes_factor", "", "Natural logarithm of BF10 for a share drawn evenly from 0 to 1",
     [](V v) -> Value { return logBayesFactor(v); }},
    {"rope_10", "",
     "Posterior probability of a share within 1/2 -+ .10, a region of practical equivalence, for a "
     "share drawn evenly from 0 to 1 (Kruschke 2018)",
     [](V v) -> Value { return ropeProbability(v, 0.10); }},
    {"rope_25", "", "the same within .25, which is 1 JOD",
     [](V v) -> Value { return ropeProbability(v, 0.25); }},
    {"p_majority", "", "Posterior probability that more than half of all people prefer b",
     [](V v) -> Value { return probabilityOfMajority(v); }},
    {"p_even_within_10", "tost_p_d10",
     "Equivalence: two one-sided exact tests of the share within 1/2 -+ .10 (Schuirmann 1987)",
     equivalent<10>},
    {"p_even_within_15", "tost_p_d15", "within .15", equivalent<15>},
    {"p_even_within_20", "tost_p_d20", "within .20", equivalent<20>},
    {"p_even_within_25", "tost_p_d25", "within .25, which is 1 JOD", equivalent<25>},
    {"smallest_margin", "",
     "Up to which distance from an even split the data speak, at .05: the smallest such margin",
     [](V v) -> Value { return smallestMargin(v); }},
};

} // namespace

std::span<const CountStatistic> countStatistics() { return statistics; }

} // namespace obscura
