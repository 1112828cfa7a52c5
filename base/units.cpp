#include "base/units.h"

#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "base/random.h"
#include "base/unit_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <thread>

namespace obscura {

namespace fs = std::filesystem;

namespace {

using Seconds = std::chrono::duration<double>;

constexpr auto pollEvery = std::chrono::milliseconds(500);

fs::path unitsFolder(const fs::path& folder) { return folder / "units"; }

// Waits after a listing that found nothing to do. Each of many waiting workers lists the folder the
// more rarely the longer that takes: so no more than a fiftieth of them burden its server at a
// time.
void waitAfter(Seconds listing, Seconds lease, const std::function<void()>& waiting) {
    const Seconds pause = std::min(50 * listing, lease);
    Seconds waited{0};
    do {
        if (waiting)
            waiting();
        std::this_thread::sleep_for(pollEvery);
        waited += pollEvery;
    } while (waited < pause);
}

} // namespace

UnitsState unitsState(const fs::path& folder, Seconds lease) {
    return stateOf(plannedUnits(unitsFolder(folder)), unitsFolder(folder), lease.count());
}

struct Units::Implementation {
    fs::path folder; // "units" itself
    std::vector<WorkUnit> plan;
    std::vector<std::string> names; // of the plan's files: a digest each, and listings are many
    Lease lease;
    Stands stands;
    mutable std::set<std::string> done;   // as far as known
    mutable std::set<std::string> fallen; // finished by earlier runs, and do not stand

    std::mutex mutex;
    std::condition_variable_any changed;
    std::map<std::string, fs::path> held; // claims of this process, by unit
    Random random{1, ProcessId::current().text()};
    std::jthread heart; // last: it ends first

    fs::path doneFile(const std::string& name) const {
        return folder / (fileNameOf(name) + ".done");
    }
    double now() const { return folderNow(folder); }

    struct Open {
        const WorkUnit* unit;
        ClaimFile last; // of a process that is gone; number 0: none
    };

    void tidy();
    void open(const std::string& about);
    std::vector<Open> openUnits(const std::string& group,
                                const std::function<bool(const WorkUnit&)>& among, bool& others);
    void beat(const std::stop_token& stop);
    void findFallen();
    bool isDone(const std::string& name) const;
    bool claim(const std::string& name, int number);
    bool release(const std::string& name);
};

// Removes claims of finished units, by processes that ended between the two.
void Units::Implementation::tidy() {
    for (const auto& [unit, files] : listingOf(folder))
        for (const ClaimFile& claim : files.claims)
            if (const Holder holder = holderOf(claim.path, 0, 0);
                !files.done.empty() && holder.process && isGone(*holder.process)) {
                std::error_code gone; // another run, tidying as well, was quicker
                fs::remove(claim.path, gone);
            }
}

// The first process writes what the folder is about; the others compare.
void Units::Implementation::open(const std::string& about) {
    makeFolders(folder);
    removeUnfinishedFiles(folder);
    tidy();
    const fs::path file = folder / "about";
    if (!writeNewFile(file, about)) {
        const std::string found = readFile(file);
        if (found != about)
            throw Error({file.string(), 0, 0, {}},
                        fmt::format("expected work on\n{}\nfound work on\n{}\nin this folder; "
                                    "results can stand in one folder only if this is the same; "
                                    "--out names another",
                                    about, found));
    }
    writePlan(folder, plan);
}

// Once, at the beginning: what is finished from now on is there.
void Units::Implementation::findFallen() {
    if (!stands)
        return;
    const Listing listing = listingOf(folder);
    for (const WorkUnit& unit : plan)
        if (const auto found = listing.find(fileNameOf(unit.name));
            found != listing.end() && !found->second.done.empty() &&
            !stands(unit.name, readFile(found->second.done)))
            fallen.insert(unit.name);
}

bool Units::Implementation::isDone(const std::string& name) const {
    if (done.contains(name))
        return true;
    if (!fs::exists(doneFile(name)))
        return false;
    if (fallen.contains(name)) { // unless another process has done it again
        if (!stands(name, readFile(doneFile(name))))
            return false;
        fallen.erase(name);
    }
    done.insert(name);
    return true;
}

void Units::Implementation::beat(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    while (!stop.stop_requested()) {
        changed.wait_for(lock, stop, lease / 4, [] { return false; });
        for (const auto& [name, path] : held)
            touch(path); // another process may have taken it from us; the first result counts
    }
}

// One of all that try wins.
bool Units::Implementation::claim(const std::string& name, int number) {
    const fs::path path = folder / fmt::format("{}.claim-{}", fileNameOf(name), number);
    if (fs::exists(path) || // the link would fail too, but after a file has been written
        !writeNewFile(path, fmt::format("{}\n{:.3f}\n", ProcessId::current().text(), now())))
        return false;
    const std::scoped_lock lock(mutex);
    held[name] = path;
    return true;
}

// Removes our claim, and those before it, whose processes had been given up.
bool Units::Implementation::release(const std::string& name) {
    const std::scoped_lock lock(mutex);
    const auto found = held.find(name);
    if (found == held.end())
        return false;
    const std::string own = found->second.string();
    const std::size_t at = own.rfind('-') + 1;
    for (int number = std::stoi(own.substr(at)); number > 0; --number) {
        std::error_code gone; // the claims below were perhaps removed by their own processes
        fs::remove(own.substr(0, at) + std::to_string(number), gone);
    }
    held.erase(found);
    return true;
}

Units::Units(fs::path folder, std::string about, std::vector<WorkUnit> plan, Lease lease,
             Stands stands)
    : self_(std::make_unique<Implementation>()) {
    self_->folder = unitsFolder(folder);
    self_->plan = std::move(plan);
    for (const WorkUnit& unit : self_->plan)
        self_->names.push_back(fileNameOf(unit.name));
    self_->lease = lease;
    self_->stands = std::move(stands);
    self_->open(about);
    self_->findFallen();
    self_->heart = std::jthread([this](const std::stop_token& stop) { self_->beat(stop); });
}

Units::~Units() {
    while (!self_->held.empty())
        self_->release(std::string(self_->held.begin()->first));
}

bool Units::isDone(const std::string& name) const { return self_->isDone(name); }

std::optional<std::string> Units::result(const std::string& name) const {
    return isDone(name) ? std::optional(readFile(self_->doneFile(name))) : std::nullopt;
}

// The units that nobody has claimed, or else those whose holders are gone: holders are looked at
// last, because that takes a file each.
std::vector<Units::Implementation::Open>
Units::Implementation::openUnits(const std::string& group,
                                 const std::function<bool(const WorkUnit&)>& among, bool& others) {
    std::vector<Open> open, claimed;
    std::map<std::string, std::size_t> workers; // by group
    const Listing listing = listingOf(folder);
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const WorkUnit& unit = plan[i];
        if ((among && !among(unit)) || done.contains(unit.name))
            continue;
        const auto found = listing.find(names[i]);
        const UnitFiles files = found == listing.end() ? UnitFiles{} : found->second;
        if (!files.done.empty() && !fallen.contains(unit.name)) {
            done.insert(unit.name);
        } else if (const ClaimFile* last = files.last()) {
            ++workers[unit.group];
            claimed.push_back({&unit, *last});
        } else {
            open.push_back({&unit, {}});
        }
    }
    others = !claimed.empty();
    if (open.empty()) {
        const double at = now();
        std::erase_if(claimed, [&](const Open& unit) {
            return holderOf(unit.last.path, at, lease.count()).lives;
        });
        open = std::move(claimed);
    }
    const auto rank = [&](const Open& candidate) {
        return candidate.unit->group == group ? 0 : 1 + workers[candidate.unit->group];
    };
    std::stable_sort(open.begin(), open.end(),
                     [&](const Open& a, const Open& b) { return rank(a) < rank(b); });
    return open;
}

std::optional<std::string> Units::claimNext(const std::string& group,
                                            const std::function<void()>& waiting,
                                            const std::function<bool(const WorkUnit&)>& among) {
    for (bool others = true;;) {
        const auto listed = std::chrono::steady_clock::now();
        const auto open = self_->openUnits(group, among, others);
        const Seconds listing = std::chrono::steady_clock::now() - listed;
        // All that begin at once see the same units open: who loses one to another tries the next
        // ever farther on, or else a thousand would take half a million tries.
        std::uint32_t stride = 1;
        for (std::size_t at = 0; at < open.size(); at += 1 + self_->random.below(stride)) {
            const std::string& name = open[at].unit->name;
            if (!self_->claim(name, open[at].last.number + 1)) {
                stride = std::min<std::uint32_t>(2 * stride, 1u << 20);
                continue;
            }
            if (!isDone(name))
                return name;
            self_->release(name); // finished since the listing
        }
        if (open.empty() && !others)
            return std::nullopt;
        if (open.empty())
            waitAfter(listing, self_->lease, waiting);
    }
}

std::string Units::require(const std::string& name, const Work& work,
                           const std::function<void()>& waiting) {
    for (;;) {
        if (const auto known = result(name))
            return *known;
        const auto begun = std::chrono::steady_clock::now();
        const Listing files = listingOf(self_->folder);
        const Seconds listing = std::chrono::steady_clock::now() - begun;
        const auto found = files.find(fileNameOf(name));
        const ClaimFile* last = found == files.end() ? nullptr : found->second.last();
        const bool isHeld = last && holderOf(last->path, self_->now(), self_->lease.count()).lives;
        if (!isHeld && self_->claim(name, last ? last->number + 1 : 1)) {
            try {
                if (!isDone(name)) // finished since the listing
                    finish(name, work());
                else
                    giveBack(name);
            } catch (...) {
                giveBack(name);
                throw;
            }
            continue;
        }
        if (isHeld)
            waitAfter(listing, self_->lease, waiting);
    }
}

bool Units::finish(const std::string& name, const std::string& result) {
    bool first = writeNewFile(self_->doneFile(name), result);
    if (!first && self_->fallen.erase(name) > 0) {
        writeFile(self_->doneFile(name), result);
        first = true;
    }
    self_->done.insert(name);
    self_->release(name);
    return first;
}

void Units::giveBack(const std::string& name) { self_->release(name); }

void Units::refuseOtherWork() const {
    std::set<std::string> own;
    for (const WorkUnit& unit : self_->plan)
        own.insert(unit.name);
    const UnitsState all =
        stateOf(plannedUnits(self_->folder), self_->folder, self_->lease.count());
    for (const UnitsState::Held& held : all.held)
        if (!own.contains(held.name))
            throw Error({self_->folder.string(), 0, 0, {}},
                        fmt::format("expected that all who work in this folder do the same, found "
                                    "process {} on {} at work on \"{}\", which is not part of "
                                    "this; wait until it is done (or dead for {:g} seconds), or "
                                    "name another folder with --out",
                                    held.pid, held.machine, held.name, self_->lease.count()));
}

double Units::costDone() const {
    double cost = 0;
    for (const WorkUnit& unit : self_->plan)
        cost += self_->done.contains(unit.name) ? unit.cost : 0;
    return cost;
}

UnitsState Units::state() const {
    std::map<std::string, WorkUnit> units;
    for (const WorkUnit& unit : self_->plan)
        units[unit.name] = unit;
    return stateOf(units, self_->folder, self_->lease.count(), self_->fallen);
}

} // namespace obscura
