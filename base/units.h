#pragma once

#include "base/work_unit.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// Long work, shared through one folder by any number of processes on any number of machines. It
// consists of units: pieces that are done whole or not at all, each with a text as its result.
//
// FOLDER/units/about says what decides all results, FOLDER/units/plan-HASH.json lists the units of
// one command, and FOLDER/units/NAME.done is the result of a finished unit; it appears whole
// (writeNewFile()), and the first stays: what another process finishes later is thrown away. So no
// unit can be lost, and none can count twice, whatever happens to clocks, machines and processes.
// FOLDER/units/NAME.claim-N says who is at work, which keeps others from doing the same for
// nothing: the holder touches it while it works, and who finds it untouched for the length of a
// lease, or its process gone, makes claim N + 1.

// Throws an Error where the folder has no plan, or one that cannot be read.
UnitsState unitsState(const std::filesystem::path& folder,
                      std::chrono::duration<double> lease = std::chrono::minutes(2));

class Units {
  public:
    using Work = std::function<std::string()>; // gives the result
    using Lease = std::chrono::duration<double>;

    // Whether what a finished unit of this result made beside it, such as a picture, is still
    // there.
    using Stands = std::function<bool(const std::string& name, const std::string& result)>;

    // `about` is what decides results (study, program): a folder about something
    // else is an Error that shows both and says to name another folder; one with other units is
    // not, and results that both plans have count for both. Where the work of an
    // earlier run no longer `stands`, the unit is open again.
    Units(std::filesystem::path folder, std::string about, std::vector<WorkUnit> plan,
          Lease lease = std::chrono::minutes(2), Stands stands = {});
    ~Units(); // gives back what it holds
    Units(const Units&) = delete;
    Units& operator=(const Units&) = delete;

    bool isDone(const std::string& name) const;
    // The result of a finished unit, or nothing.
    std::optional<std::string> result(const std::string& name) const;

    // The next open unit, now held by this process until finish() or giveBack(): of `group` first,
    // then of the group with open units that fewest work on. Where all that is left is held by
    // others, it waits, and calls `waiting` twice a second; nothing when every unit is done.
    // `among` limits it to units for which it is true; the others may stay undone.
    std::optional<std::string> claimNext(const std::string& group,
                                         const std::function<void()>& waiting = {},
                                         const std::function<bool(const WorkUnit&)>& among = {});

    // This unit: its result if it is done, else by `work`, or when another process that has it is
    // through. For what other units depend on. What `work` throws goes on, and the unit is given
    // back.
    std::string require(const std::string& name, const Work& work,
                        const std::function<void()>& waiting = {});

    // Publishes the result of a unit that is held, and lets go of it. False where another process
    // was first: then its result counts.
    bool finish(const std::string& name, const std::string& result);
    void giveBack(const std::string& name);

    UnitsState state() const;
    // Throws an Error while another process works in the folder on what is not in the plan. Who
    // asks when it holds a unit learns of all that do the same; both may.
    void refuseOtherWork() const;
    // Of the plan's units that this process knows to be done: all that were when it last looked for
    // one to claim.
    double costDone() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

} // namespace obscura
