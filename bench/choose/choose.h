#pragma once

#include "bench/choose/budget.h"
#include "bench/measure/measured_view.h"
#include "bench/sweep/sweep.h"

#include <map>

namespace obscura {

// The cheapest configuration that is good enough: `obscura-bench choose`.

// How far a candidate came. Each rung costs more and leaves fewer.
enum class Rung {
    glance, // fitted and tested on one small view each, timed a little as matched there: those far
            // over the budget fall out, the others are tried in order of cost
    held_out, // fitted on all training views, measured at full size on held-out ones
    chosen    // and timed at length, on all of them
};

struct Candidate {
    Configuration configuration;
    Rung rung = Rung::glance;
    // Median, and RMSE of matched visibility. At a glance: by the glance's fit, timed on the first
    // held-out view, so that all candidates can be compared. Else the mean of all held-out views,
    // of milliseconds as a sweep would have them; NaN of what was not measured.
    double glanceMilliseconds = 0, milliseconds = 0;
    double glanceRmse = 0, rmse = 0;
    std::vector<ViewResult> views; // from `held_out` on
    std::string verdict;           // why it fell out; "" for the chosen one and those not needed
};

struct Choice {
    std::vector<Candidate> candidates; // by rising cost at a glance; finalists by their own
    std::optional<std::size_t> chosen; // none: no candidate meets the budget
    double seconds = 0;                // that the search took, references left out
};

// By a race in rungs: look at all a little, time all a little, then measure in order of cost until
// one meets every limit on errors with 95 % confidence on views that it was not fitted on (a study
// with fewer than two test views bounds nothing: an Error). It and those of nearly its cost are the
// finalists: timed at length, in turn, on all views, and the cheapest that meets every limit wins
// (the fact sheet's rule, §F.8).
Choice choose(const SweepStudy& study, const Budget& budget, const Folders& folders,
              const SweepPlan& plan, const gl::Driver& driver, const SweepProgress& progress);

// The same question answered from a sweep that has measured everything; index of a row's
// configuration by name, "" when none that was measured on all views meets the budget (flicker and
// failures left out). What choose() is held to.
std::string chosenFrom(const Sweep& sweep, const Budget& budget);

} // namespace obscura
