#pragma once

#include "base/progress.h"
#include "base/units.h"

#include <functional>
#include <string>
#include <vector>

namespace obscura {

// A unit of shared work with what does it.
struct Task {
    Unit unit;
    std::function<std::string()> work; // gives the unit's result
    int stage = 0;                     // begun when all tasks of lower stages are done
};

std::vector<Unit> unitsOf(const std::vector<Task>& tasks);

// What all workers together have done, and what is at hand.
using UnitsProgress = std::function<void(const UnitsState&, const std::string& note)>;

// A line of the kind; its total is 1.
UnitsProgress showing(Progress& progress);

// Does tasks until all are done, by this process or by others that share the units. `progress` is
// told about once a second, before tasks and while others are waited for. What a task throws goes
// on; its unit is given back when `units` ends.
void doTasks(Units& units, const std::vector<Task>& tasks, const UnitsProgress& progress = {});

} // namespace obscura
