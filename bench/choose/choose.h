#pragma once

#include "bench/choose/budget.h"
#include "bench/measure/measured_view.h"
#include "bench/sweep/sweep.h"

#include <optional>

namespace obscura {

// The cheapest configuration that is good enough, or the best that is cheap enough:
// `obscura-bench choose`.

// How far a candidate came. Each rung costs more and leaves fewer.
enum class Rung {
    glance,   // fitted on one small training view, seen on all of them, timed a little as matched
    held_out, // fitted on all training views, measured at full size on held-out ones, timed at
              // length
    chosen
};

// A glance sees a few small views: what is over a limit by less than this may still meet it.
constexpr double glanceFactor = 1.5, glanceMargin = 0.02;
inline double farOver(double rmse) { return rmse * glanceFactor + glanceMargin; }

struct Candidate {
    Configuration configuration;
    Rung rung = Rung::glance;
    // RMSE is of matched visibility. At a glance: by the glance's fit, the fastest of a few frames
    // on the first held-out view, so that all candidates can be compared. Else the mean of all
    // held-out views, of milliseconds as a sweep would have them (medians); NaN of what was not
    // measured.
    double glanceMilliseconds = 0, milliseconds = 0;
    double glanceRmse = 0, rmse = 0;
    double training = 0; // what orders the fitted ones: the worst of their means on training views
                         // in shares of the limits, or the distance from the truth where there is
                         // none; NaN of what was not fitted
    std::vector<ViewResult> views; // from `held_out` on
    std::string verdict;           // why it fell out; "" for the chosen one and those that would do
};
// Milliseconds on held-out views, or else at a glance.
double costOf(const Candidate& candidate);
// By Budget::best or, without it, milliseconds, on held-out views; least first.
double worth(const Budget& budget, const Candidate& candidate);

struct Choice {
    std::vector<Candidate> candidates; // by rising cost
    std::optional<std::size_t> chosen; // none: no candidate meets the budget
    std::vector<std::size_t> alike;    // asked for the best: others that meet the budget and that
                                       // the views do not tell from it, by rising cost
    double seconds = 0;                // that the search took, references left out
    SweepMachine machine;
};

// By a race. At a glance at training views fall out those far over a limit on RMSE or
// milliseconds, and those to which a clearly cheaper one is clearly preferable. The others are
// fitted on all training views and, in the order of their errors there, measured on views that
// they were not fitted on, until failuresAllowed have missed a limit on errors (budget.h says
// why); those that are dearer than one that is far within the limit wait until none of the others
// will do. What was measured is timed at length, in turn, on all views; the cheapest that meets
// every limit wins, or the best by Budget::best. A study with fewer than two test views bounds
// nothing: an Error.
Choice choose(const SweepStudy& study, const Budget& budget, const Folders& folders,
              const SweepPlan& plan, const gl::Driver& driver, const SweepProgress& progress);

// The same question answered from a sweep that has measured everything; index of a row's
// configuration by name, "" when none that was measured on all views meets the budget (flicker and
// failures left out). What choose() is held to.
std::string chosenFrom(const Sweep& sweep, const Budget& budget);

} // namespace obscura
