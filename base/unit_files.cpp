#include "base/unit_files.h"

#include "base/error.h"
#include "base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <chrono>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// Seconds since 1970 by the clock of the file's own server, which set it; nothing if it is gone.
std::optional<double> touchedAt(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        return std::nullopt;
    return static_cast<double>(status.st_mtim.tv_sec) +
           1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

nlohmann::ordered_json planJson(const std::vector<WorkUnit>& plan) {
    auto units = nlohmann::ordered_json::array();
    for (const WorkUnit& unit : plan)
        units.push_back({{"name", unit.name}, {"group", unit.group}, {"cost", unit.cost}});
    return {{"formatVersion", 1}, {"units", units}};
}

void addPlan(const fs::path& file, std::map<std::string, WorkUnit>& units) {
    try {
        const auto root = nlohmann::json::parse(readFile(file));
        for (const auto& unit : root.at("units"))
            units[unit.at("name")] = {unit.at("name"), unit.at("group"), unit.at("cost")};
    } catch (const nlohmann::json::exception& error) {
        throw Error({file.string(), 0, 0, {}},
                    fmt::format("expected a plan of units as obscura wrote it, found {}; name "
                                "another folder with --out",
                                error.what()));
    }
}

// How long all workers need for the rest, by how fast the last quarter of the finished was done.
std::optional<double> secondsLeft(const std::vector<std::pair<double, double>>& finished,
                                  double costLeft, double now) {
    const std::size_t count =
        std::min(finished.size(), std::max<std::size_t>(10, finished.size() / 4));
    if (count < 2)
        return std::nullopt;
    const auto first = finished.end() - static_cast<std::ptrdiff_t>(count);
    double cost = 0;
    for (auto at = first + 1; at != finished.end(); ++at)
        cost += at->second;
    const double seconds = now - first->first;
    return cost > 0 && seconds > 0 ? std::optional(costLeft * seconds / cost) : std::nullopt;
}

} // namespace

std::string fileNameOf(const std::string& unit) {
    return fmt::format("{}-{}", plainName(unit).substr(0, 120), sha256(unit).substr(0, 12));
}

bool touch(const fs::path& path) { return ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0) == 0; }

double folderNow(const fs::path& folder) {
    const fs::path about = folder / "about";
    if (touch(about))
        if (const auto now = touchedAt(about))
            return *now;
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

Listing listingOf(const fs::path& folder) {
    Listing listing;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string file = entry.path().filename().string();
        constexpr std::string_view claimMark = ".claim-", doneMark = ".done";
        if (file.ends_with(doneMark)) {
            listing[file.substr(0, file.size() - doneMark.size())].done = entry.path();
            continue;
        }
        const std::size_t mark = file.rfind(claimMark);
        if (mark == file.npos)
            continue;
        const char *begin = file.data() + mark + claimMark.size(), *end = file.data() + file.size();
        ClaimFile claim{0, entry.path()};
        if (const auto read = std::from_chars(begin, end, claim.number);
            read.ec == std::errc() && read.ptr == end && claim.number > 0)
            listing[file.substr(0, mark)].claims.push_back(claim);
    }
    return listing;
}

Holder holderOf(const fs::path& claim, double now, double lease) {
    Holder holder;
    const auto touched = touchedAt(claim);
    if (!touched)
        return holder;
    try {
        const std::string text = readFile(claim);
        const std::size_t line = text.find('\n');
        holder.process = ProcessId::parse(std::string_view(text).substr(0, line));
        if (line != text.npos)
            std::from_chars(text.data() + line + 1, text.data() + text.size(), holder.since);
    } catch (const Error&) {
        return holder;
    }
    holder.lives = now - *touched < lease && !(holder.process && isGone(*holder.process));
    return holder;
}

void writePlan(const fs::path& folder, const std::vector<WorkUnit>& plan) {
    const std::string text = planJson(plan).dump(1) + "\n";
    writeNewFile(folder / fmt::format("plan-{}.json", sha256(text).substr(0, 12)), text);
}

std::map<std::string, WorkUnit> plannedUnits(const fs::path& folder) {
    std::map<std::string, WorkUnit> units;
    if (fs::is_directory(folder))
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            if (const std::string name = entry.path().filename().string();
                name.starts_with("plan-") && name.ends_with(".json"))
                addPlan(entry.path(), units);
    if (units.empty())
        throw Error({folder.string(), 0, 0, {}},
                    "expected a folder in which work is shared, with a plan of its units, found "
                    "none; it appears when the first worker begins");
    return units;
}

UnitsState stateOf(const std::map<std::string, WorkUnit>& units, const fs::path& folder,
                   double lease, const std::set<std::string>& fallen) {
    UnitsState state;
    const double now = folderNow(folder);
    const Listing listing = listingOf(folder);
    std::vector<std::pair<double, double>> finished; // when, cost
    for (const auto& [name, unit] : units) {
        ++state.units;
        state.cost += unit.cost;
        const auto found = listing.find(fileNameOf(name));
        if (found == listing.end())
            continue;
        const UnitFiles& files = found->second;
        if (!files.done.empty() && !fallen.contains(name)) {
            ++state.done;
            state.costDone += unit.cost;
            finished.emplace_back(touchedAt(files.done).value_or(now), unit.cost);
        } else if (const ClaimFile* claim = files.last()) {
            const Holder holder = holderOf(claim->path, now, lease);
            if (!holder.lives)
                state.broken.push_back(name);
            else
                state.held.push_back({name, holder.process ? holder.process->machine : "",
                                      holder.process ? holder.process->pid : 0,
                                      std::max(0.0, now - holder.since)});
        }
    }
    std::sort(finished.begin(), finished.end());
    if (!state.held.empty())
        state.secondsLeft = secondsLeft(finished, state.cost - state.costDone, now);
    return state;
}

} // namespace obscura
