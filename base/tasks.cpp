#include "base/tasks.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <string_view>

namespace obscura {

namespace {

// Looking at all units takes a network folder a while, so it is not done for every small one.
class Teller {
  public:
    Teller(const Units& units, const UnitsProgress& progress)
        : units_(units), progress_(progress) {}

    void tell(const std::string& note) {
        using namespace std::chrono;
        const auto now = steady_clock::now();
        if (!progress_ || now - told_ < seconds(1))
            return;
        told_ = now;
        progress_(units_.state(), note);
    }

  private:
    const Units& units_;
    const UnitsProgress& progress_;
    std::chrono::steady_clock::time_point told_{};
};

} // namespace

std::vector<Unit> unitsOf(const std::vector<Task>& tasks) {
    std::vector<Unit> units;
    for (const Task& task : tasks)
        units.push_back(task.unit);
    return units;
}

UnitsProgress showing(Progress& progress) {
    return [&progress](const UnitsState& state, const std::string& note) {
        progress.update(state.costDone / state.cost, note, state.secondsLeft);
    };
}

void doTasks(Units& units, const std::vector<Task>& tasks, const UnitsProgress& progress) {
    std::map<std::string_view, const Task*> byName;
    std::set<int> stages;
    for (const Task& task : tasks) {
        byName[task.unit.name] = &task;
        stages.insert(task.stage);
    }
    Teller teller(units, progress);
    const auto waiting = [&] { teller.tell("waiting for other workers"); };
    std::string group;
    for (const int stage : stages) {
        const auto among = [&](const Unit& unit) { return byName.at(unit.name)->stage == stage; };
        while (const auto name = units.claimNext(group, waiting, among)) {
            const Task& task = *byName.at(*name);
            group = task.unit.group;
            teller.tell(*name);
            units.finish(*name, task.work());
        }
    }
}

} // namespace obscura
