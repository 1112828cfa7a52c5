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

// The functions below need at least one vote; frequencies() is the one to call for any counts.

// Pearson 1900, against (N/2, N/2): (a - b)^2 / N, and its p at one degree of freedom. This is the
// thesis' test (5.6). It is liberal at such N: at 36 its true size at .05 is .0652.
double chiSquare(Votes votes);
double chiSquareP(double statistic);

// Two-sided binomial test of 1/2: twice the smaller tail, at most 1. Because the null distribution
// is symmetric, this equals the sum over all outcomes no likelier than the one seen (R's
// binom.test). True size at N = 36: .0288.
double exactP(Votes votes);

// Score interval of the share successes / trials at 95 %: Wilson, J. Am. Stat. Assoc. 22 (1927)
// 209; recommended at such N by Brown, Cai, DasGupta, Stat. Sci. 16 (2001) 101, section 3.1.1.
Interval wilson(std::int64_t successes, std::int64_t trials);

// Cohen, Statistical Power Analysis, 2nd ed. 1988: g = share - 1/2 (chapter 5),
// h = 2 asin sqrt(share) - pi/2 (chapter 6), w = sqrt(chi-square / N) = 2 |g| (chapter 7).
double cohenG(Votes votes);
double cohenH(Votes votes);
double cohenW(Votes votes);

// How far b lies above a in just-objectionable differences: probit(share of b) / probit(0.75), so
// that 1 means 75 % prefer b (Perez-Ortiz and Mantiuk, arXiv:1712.03686). Absent when the votes
// are unanimous: the estimate is infinite.
std::optional<double> jod(Votes votes);

struct Frequencies {
    double share = 0; // of b
    Interval wilson;
    double chiSquare = 0, chiSquareP = 1, exactP = 1;
    double g = 0, h = 0, w = 0;
    std::optional<double> jod;
};

// All of the above; absent without votes.
std::optional<Frequencies> frequencies(Votes votes);

} // namespace obscura
