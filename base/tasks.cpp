#include "base/tasks.h"

#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace obscura {

std::vector<WorkUnit> unitsOf(const std::vector<Task>& tasks) {
    std::vector<WorkUnit> units;
    for (const Task& task : tasks)
        units.push_back(task.unit);
    return units;
}

void doTasks(Units& units, const std::vector<Task>& tasks, const TaskProgress& progress) {
    std::map<std::string_view, const Task*> byName;
    std::set<int> stages;
    double cost = 0;
    for (const Task& task : tasks) {
        byName[task.unit.name] = &task;
        stages.insert(task.stage);
        cost += task.unit.cost;
    }
    const auto tell = [&](const std::string& note) {
        if (progress)
            progress(units.costDone() / cost, note);
    };
    bool isFirst = true;
    std::string group;
    for (const int stage : stages) {
        const auto among = [&](const WorkUnit& unit) {
            return byName.at(unit.name)->stage == stage;
        };
        while (const auto name = units.claimNext(
                   group, [&] { tell("waiting for other workers"); }, among)) {
            if (std::exchange(isFirst, false))
                units.refuseOtherWork();
            const Task& task = *byName.at(*name);
            group = task.unit.group;
            tell(*name);
            units.finish(*name, task.work());
        }
    }
}

} // namespace obscura
