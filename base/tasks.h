#pragma once

#include "base/units.h"

#include <functional>
#include <string>
#include <vector>

namespace obscura {

// A unit of shared work with what does it.
struct Task {
    WorkUnit unit;
    std::function<std::string()> work; // gives the unit's result
    int stage = 0;                     // begun when all tasks of lower stages are done
};

std::vector<WorkUnit> unitsOf(const std::vector<Task>& tasks);

// Told the share of all units that is done, 0 ... 1, by whichever worker, and what is at hand.
using TaskProgress = std::function<void(double share, const std::string& note)>;

// Does tasks until all are done, by this process or by others that share the units. `progress` is
// told before each task, and while others are waited for. What a task throws goes on; its unit is
// given back when `units` ends. Where others work in the folder on something else, which may write
// the same files, that is an Error.
void doTasks(Units& units, const std::vector<Task>& tasks, const TaskProgress& progress = {});

} // namespace obscura
