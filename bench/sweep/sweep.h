#pragma once

#include "bench/sweep/row.h"
#include "gl/timer.h"
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
    int part = 1, parts = 1;      // this run's share of the configurations
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

// Measures what folder/sweep.csv does not have yet of the same study, driver and program; rows are
// added to it group by group, so that an interrupted sweep goes on where it stopped. Then writes
// growth.csv, sweep.json, sweep.html and figures/.
Sweep sweep(const SweepStudy& study, const Folders& folders, const SweepPlan& plan,
            const gl::Driver& driver, const SweepProgress& progress);

} // namespace obscura
