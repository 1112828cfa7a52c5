#pragma once

#include "bench/sweep/row.h"
#include "bench/sweep/units.h"
#include "gl/context.h"
#include "protocols/reader/sweep.h"
#include "renderer/render.h"

#include <filesystem>
#include <functional>

namespace obscura {

// Speed and accuracy of every configuration of a study on every view and size: `obscura-bench
// sweep`. docs/benchmarks.md says what is measured and how to read it.

struct SweepPlan {
    std::filesystem::path folder; // of results
    std::filesystem::path cache;  // of references
    SweepShare share = {};        // what of the study this run measures
    double hours = 1;             // that references may take; more is an Error that says how long
};

// What decides a study's rows besides program and machine: its text, what the command line
// changed, and its scenes.
std::string identityOf(const SweepStudy& study, SceneHashes& hashes);

// Throws an Error for what neither sweep() nor choose() can do: a technique that traces rays, or
// references that take longer than `hours`. Their time is `referenceSeconds` for test views plus
// what training views take.
void requireMeasurable(const SweepStudy& study, double referenceSeconds, double hours);

// Called now and then: how much is done, of how much (about seconds), and what is at hand.
using SweepProgress = std::function<void(double done, double total, const std::string& note)>;

// Measures what nobody has measured yet in plan.folder, which any number of processes, on any
// machines, may do at the same time: the work is shared in units (units.h), and progress is that
// of all. Goes on when everything is measured that `share` has, and whoever is last has written
// sweep.csv, growth.csv, sweep.json, sweep.html and figures/. Gives what stands there.
Sweep sweep(const SweepStudy& study, const Folders& folders, const SweepPlan& plan,
            const gl::Driver& driver, const SweepProgress& progress);

} // namespace obscura
