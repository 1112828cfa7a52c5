#pragma once

#include "inference/result.h"

#include <cstdint>
#include <optional>

namespace obscura {

// Statistics of one condition: how many votes each member of the pair got, against the even split
// that guessing gives. Every vote must come from another participant, or the tests promise too
// much. No value is ever NaN or infinite: what does not exist is absent.

struct Votes {
    std::int64_t a = 0, b = 0; // each >= 0
    std::int64_t total() const { return a + b; }
};

// The functions below need at least one vote. requireVotes() throws their Error for none, and for
// negative ones. None takes time that grows with the votes.
void requireVotes(Votes votes);

// Pearson 1900, against (N/2, N/2): (a - b)^2 / N, at one degree of freedom (chiSquareP of
// inference/tails.h). This is the thesis' test (5.6). It is liberal at such N: at 36 its true size
// at .05 is .0652.
double chiSquare(Votes votes);

// With the correction for continuity of Yates, Suppl. J. R. Stat. Soc. 1 (1934) 217:
// (|a - b| - 1)^2 / N, and 0 for an even split.
double chiSquareYates(Votes votes);

// Two-sided binomial test of 1/2: twice the smaller tail, at most 1. Because the null distribution
// is symmetric, this equals the sum over all outcomes no likelier than the one seen (R's
// binom.test). True size at N = 36: .0288.
double exactP(Votes votes);

// The same with half of the probability of what was seen: Lancaster, J. Am. Stat. Assoc. 56 (1961)
// 223. Less conservative; its size may exceed the nominal one by a little.
double midP(Votes votes);

// Intervals of the share successes / trials; 0 < confidence < 1.
// Score interval: Wilson, J. Am. Stat. Assoc. 22 (1927) 209; recommended at such N by Brown, Cai,
// DasGupta, Stat. Sci. 16 (2001) 101, section 3.1.1. It excludes 1/2 when chiSquare rejects.
Interval wilson(std::int64_t successes, std::int64_t trials, double confidence = 0.95);
// Clopper and Pearson, Biometrika 26 (1934) 404 (R's binom.test). It excludes 1/2 when exactP
// rejects.
Interval clopperPearson(std::int64_t successes, std::int64_t trials, double confidence = 0.95);
// Quantiles of the posterior under Beta(1/2, 1/2): Brown, Cai, DasGupta, section 3.1.2, without its
// change of the limits at unanimity.
Interval jeffreys(std::int64_t successes, std::int64_t trials, double confidence = 0.95);

// A share of b that was not counted but estimated, and the two-sided p of one half that belongs to
// its interval.
struct EstimatedShare {
    double share = 0.5;
    Interval interval;
    double p = 1;
};

// The share of b as it would be were b shown first and second equally often: the mean of its shares
// in both orders, whatever the place adds to choices. The interval combines Wilson's of the two:
// Newcombe, Commun. Stat. Simul. Comput. 30 (2001) 367, for other weights Zou and Donner, Stat.
// Med. 27 (2008) 1693; p is where it begins to exclude one half. Absent unless there are votes in
// both orders.
std::optional<EstimatedShare> balancedShare(Votes bFirst, Votes bSecond, double confidence = 0.95);

// Cohen, Statistical Power Analysis, 2nd ed. 1988: g = share - 1/2 (chapter 5),
// h = 2 asin sqrt(share) - pi/2 (chapter 6), w = sqrt(chi-square / N) = 2 |g| (chapter 7).
double cohenG(Votes votes);
double cohenH(Votes votes);
double cohenW(Votes votes);

// How far b lies above a in just-objectionable differences: probit(share of b) / probit(0.75), so
// that 1 means 75 % prefer b (Perez-Ortiz and Mantiuk, arXiv:1712.03686). Absent when the votes
// are unanimous: the estimate is infinite.
std::optional<double> jod(Votes votes);

// The limits of an interval of shares (wilson, clopperPearson, jeffreys) as JODs. Where a limit is
// 0 or 1 that side has no bound and is absent: unanimous votes give one bound, at the level of
// the interval's one side (97.5 % of 95 %).
struct JodLimits {
    std::optional<double> low, high;
};
JodLimits jodLimits(Interval shares);

// Bayes: the share of b is 1/2 (H0), or drawn from Beta(prior, prior) (H1), with prior > 0; 1 is
// the uniform, 1/2 Jeffreys', and the larger the nearer to 1/2. The prior must be reported: 18 : 18
// gives 4.9 for H0 under 1 and 1.7 under 10.
// log(P(votes | H1) / P(votes | H0)), natural: Kass and Raftery, J. Am. Stat. Assoc. 90 (1995) 773.
// The factor itself, its exponential, has no finite double at 0 : 1100.
double logBayesFactor(Votes votes, double prior = 1);
// The posterior probability under H1 that the share of b is within 1/2 -+ margin, the region of
// practical equivalence (Kruschke, Adv. Meth. Pract. Psych. Sci. 1 (2018) 270); 0 <= margin <= 1/2.
double ropeProbability(Votes votes, double margin, double prior = 1);
// The posterior probability under H1 that the share of b is above 1/2.
double probabilityOfMajority(Votes votes, double prior = 1);

} // namespace obscura
