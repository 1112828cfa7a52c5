#pragma once

#include "base/process.h"
#include "base/work_unit.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace obscura {

// What the files in a folder of shared work say (base/units.h has their names), for Units alone.
// `folder` is "units" itself, `lease` in seconds, times in seconds since 1970 by the clock of the
// folder's server.

// What a person can read, and no other unit's.
std::string fileNameOf(const std::string& unit);

// Makes a file newer; false if it is gone or may not be written to.
bool touch(const std::filesystem::path& path);

// Now, by the clock that files are touched by: that of this machine where the folder cannot be
// written to.
double folderNow(const std::filesystem::path& folder);

struct ClaimFile {
    int number = 0; // from 1
    std::filesystem::path path;
};

// What the folder says of a unit at one moment.
struct UnitFiles {
    std::filesystem::path done; // empty: not finished
    std::vector<ClaimFile> claims;

    const ClaimFile* last() const {
        const auto found =
            std::max_element(claims.begin(), claims.end(),
                             [](const auto& a, const auto& b) { return a.number < b.number; });
        return found == claims.end() ? nullptr : &*found;
    }
};

// By fileNameOf().
using Listing = std::map<std::string, UnitFiles, std::less<>>;

Listing listingOf(const std::filesystem::path& folder);

struct Holder {
    std::optional<ProcessId> process; // nothing: the claim cannot be read (it may have gone)
    double since = 0;                 // folderNow() when it was claimed
    bool lives = false;
};

// A claim that has just gone is nobody's.
Holder holderOf(const std::filesystem::path& claim, double now, double lease);

// Adds a plan to those of the folder, unless it has it.
void writePlan(const std::filesystem::path& folder, const std::vector<WorkUnit>& plan);

// Every unit that any process has planned in the folder; an Error where there are none.
std::map<std::string, WorkUnit> plannedUnits(const std::filesystem::path& folder);

// Units that are `fallen` have a result, and are open nevertheless.
UnitsState stateOf(const std::map<std::string, WorkUnit>& units,
                   const std::filesystem::path& folder, double lease,
                   const std::set<std::string>& fallen = {});

} // namespace obscura
