#pragma once

#include "base/units.h"
#include "bench/sweep/row.h"
#include "protocols/reader/sweep.h"

#include <string>
#include <vector>

namespace obscura {

// The units of work of a sweep (base/units.h).

// Errors carry over from one machine to another, times do not; so each is a job of its own.
enum class Measured { errors, times, both };

// What a process is asked for: the Ith of N parts of what is measured. Parts are of as many units
// each, and together have every unit once.
struct SweepShare {
    Measured measured = Measured::both;
    int part = 1, parts = 1;
};

struct SweepUnit {
    enum class Kind {
        training,   // the reference of a training view
        fit,        // of one configuration
        references, // of a test view at one size
        errors,     // of one configuration there
        times,      // of a group of configurations there, in turn
        growth,     // how cost grows
        files       // sweep.csv and the others, of all that was measured by then
    };

    Kind kind = Kind::files;
    WorkUnit unit;
    // A stage begins when the one before is done, by whomever: fits need the references of training
    // views, errors and times need fits, and times want machines that measure no errors meanwhile.
    int stage = 0;
    std::size_t view = 0; // among the training views, or else the test views
    ImageSize size;
    std::vector<std::size_t> configurations; // places among the study's techniques
};

// In the order in which a single process does them: one scene after the other, one view after the
// other. `machine` is the kind of machine that times are of (kindOf()); each kind has units of its
// own. Groups that are timed in turn are drawn by lot, for neighbours in a study are much alike,
// and machines drift; a study's lot is always the same.
std::vector<SweepUnit> sweepUnits(const SweepStudy& study, const SweepShare& share,
                                  const std::string& machine);

// A short name for a kind of machine.
std::string tagOf(const std::string& kind);

} // namespace obscura
