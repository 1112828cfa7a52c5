#include "bench/sweep/merge.h"

#include "base/error.h"
#include "base/files.h"
#include "bench/sweep/files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// Of a text like "glFinish: a load takes 28.4 ms", what does not change from run to run.
std::string nameOf(const std::string& method) { return method.substr(0, method.find(':')); }

// What was measured by the same code is the same, whatever the commit: "code 0123abcd)".
std::string codeOf(const std::string& program) {
    const std::size_t at = program.find("code ");
    return at == program.npos ? program : program.substr(at);
}

constexpr std::size_t mostTold = 4; // of a hundred workers nobody reads them all

std::string identityOf(const SweepRow& row) {
    return fmt::format("\"{}\" on view \"{}\" of \"{}\" at {} x {}, R {}", row.configuration,
                       row.view, row.scene, row.width, row.height, row.radius);
}

std::string identityOf(const GrowthRow& row) {
    return fmt::format("\"{}\" at {} {}", row.configuration, row.axis, row.value);
}

// Remembers where each thing was measured.
class Measured {
  public:
    void add(const std::string& what, const fs::path& file) {
        const auto [at, isNew] = files_.emplace(what, file);
        if (!isNew)
            throw Error({file.string(), 0, 0, {}},
                        fmt::format("{} was measured already in {}", what, at->second.string()));
    }

  private:
    std::map<std::string, fs::path> files_;
};

class Merging {
  public:
    Merging(const std::vector<fs::path>& parts, const fs::path& folder)
        : parts_(parts), folder_(folder) {}

    Sweep run();

  private:
    void chooseKind();
    void add(std::size_t i);
    SweepRow& rowLike(const SweepRow& row);
    void addErrors(const SweepRow& row, SweepRow& to, std::size_t i);

    const std::vector<fs::path>& parts_;
    const fs::path& folder_;
    std::vector<Sweep> sweeps_;
    std::string kind_, notes_; // of machine, of which times are kept; on the others
    Sweep all_;
    std::map<std::string, std::size_t> places_; // of rows, by identity
    Measured errors_, times_;
};

void Merging::chooseKind() {
    std::vector<TimedKind> kinds;
    for (const Sweep& sweep : sweeps_) {
        const std::string name = kindOf(sweep.machine);
        if (name.empty())
            continue;
        auto at = std::find_if(kinds.begin(), kinds.end(),
                               [&](const TimedKind& kind) { return kindOf(kind.machine) == name; });
        if (at == kinds.end())
            at = kinds.insert(at, {sweep.machine, 0});
        at->rows += static_cast<std::size_t>(
            std::count_if(sweep.rows.begin(), sweep.rows.end(),
                          [](const SweepRow& row) { return row.hasTimes(); }));
    }
    if (!kinds.empty())
        kind_ = kindOf(kinds[keptKind(kinds, notes_)].machine);
}

// The row of the same identity, new ones without errors and times.
SweepRow& Merging::rowLike(const SweepRow& row) {
    const auto [place, isNew] = places_.emplace(identityOf(row), all_.rows.size());
    if (isNew) {
        all_.rows.push_back(row);
        static_cast<SweepErrors&>(all_.rows.back()) = {};
        static_cast<SweepTimes&>(all_.rows.back()) = {};
    }
    return all_.rows[place->second];
}

void Merging::addErrors(const SweepRow& row, SweepRow& to, std::size_t i) {
    errors_.add(identityOf(row), parts_[i] / "sweep.csv");
    static_cast<SweepErrors&>(to) = row;
    to.fitted = row.fitted;
    if (row.thumbnail.empty())
        return;
    to.thumbnail = fmt::format("part-{}/{}", i + 1, row.thumbnail);
    writeFile(folder_ / to.thumbnail, readFile(parts_[i] / row.thumbnail));
}

void Merging::add(std::size_t i) {
    const Sweep& part = sweeps_[i];
    const bool isKept = kindOf(part.machine) == kind_;
    for (const SweepRow& row : part.rows) {
        SweepRow& to = rowLike(row);
        if (row.hasErrors())
            addErrors(row, to, i);
        if (row.hasTimes() && isKept) {
            times_.add("the time of " + identityOf(row), parts_[i] / "sweep.csv");
            static_cast<SweepTimes&>(to) = row;
        }
    }
    for (const GrowthRow& row : part.growth)
        if (isKept) {
            times_.add(identityOf(row), parts_[i] / "growth.csv");
            all_.growth.push_back(row);
        }
    SweepMachine machine = part.machine;
    if (!isKept)
        static_cast<TimedOn&>(machine) = {};
    if (i == 0)
        all_.machine = machine;
    else
        joinMachines(all_.machine, machine, "in " + parts_.front().string(), parts_[i]);
}

Sweep Merging::run() {
    if (fs::exists(folder_ / "sweep.json"))
        throw Error({(folder_ / "sweep.json").string(), 0, 0, {}},
                    "expected a folder without a sweep, found one; --out names another");
    for (const fs::path& part : parts_)
        sweeps_.push_back(readSweep(part));
    chooseKind();
    for (std::size_t i = 0; i < sweeps_.size(); ++i)
        add(i);
    all_.machine.notes += (all_.machine.notes.empty() ? "" : " ") + notes_;
    writeSweep(folder_, all_);
    return std::move(all_);
}

} // namespace

std::string kindOf(const TimedOn& machine) {
    return machine.method.empty()
               ? ""
               : fmt::format("{}, {}, OpenGL {}, {}, {}", machine.renderer, machine.vendor,
                             machine.glVersion, machine.processor, nameOf(machine.method));
}

std::size_t keptKind(std::span<const TimedKind> kinds, std::string& notes) {
    const auto most =
        std::max_element(kinds.begin(), kinds.end(),
                         [](const TimedKind& a, const TimedKind& b) { return a.rows < b.rows; });
    for (const TimedKind& kind : kinds)
        if (&kind != &*most)
            notes += fmt::format(
                "{}{} rows were timed on another kind of machine ({}), and those times are left "
                "out, for times compare only within one kind, and most, of {} rows, are of {}. To "
                "have the others timed there: obscura-bench sweep STUDY --measure times --out "
                "FOLDER, with the same options, on a machine of that kind.",
                notes.empty() ? "" : " ", kind.rows, kindOf(kind.machine), most->rows,
                kindOf(most->machine));
    return static_cast<std::size_t>(most - kinds.begin());
}

void addTo(std::string& list, const std::string& one) {
    const auto padded = [](const std::string& text) { return "; " + text + "; "; };
    if (one.empty() || padded(list).find(padded(one)) != list.npos || list.ends_with("..."))
        return;
    std::size_t known = list.empty() ? 0 : 1;
    for (std::size_t at = 0; (at = list.find("; ", at)) != list.npos; at += 2)
        ++known;
    list += (list.empty() ? "" : "; ") + (known < mostTold ? one : "...");
}

void joinMachines(SweepMachine& all, const SweepMachine& part, const std::string& first,
                  const fs::path& folder) {
    const auto require = [&](const std::string& name, const std::string& value,
                             const std::string& other, bool same) {
        if (!same)
            throw Error({(folder / "sweep.json").string(), 0, 0, name},
                        fmt::format("expected \"{}\", as {}, found \"{}\"; rows can stand in "
                                    "one folder only if this is the same; --out names another",
                                    value, first, other));
    };
    require("study", all.study, part.study, all.study == part.study);
    require("program", all.program, part.program, codeOf(all.program) == codeOf(part.program));
    require("display", all.display, part.display, all.display == part.display);
    addTo(all.errorsBy, part.errorsBy);
    if (kindOf(all).empty())
        static_cast<TimedOn&>(all) = part;
    else {
        addTo(all.clocks, part.clocks);
        addTo(all.date, part.date);
    }
    if (all.notes.find(part.notes) == all.notes.npos)
        all.notes += (all.notes.empty() ? "" : " ") + part.notes;
}

std::string incompleteness(const Sweep& sweep) {
    std::vector<std::string> lacking;
    if (const auto whole = static_cast<std::size_t>(sweep.machine.rows); sweep.rows.size() < whole)
        lacking.push_back(
            fmt::format("{} of the study's {} rows; the others are in other parts, or "
                        "were not measured yet",
                        sweep.rows.size(), whole));
    const auto add = [&](const char* what, bool (SweepRow::*has)() const) {
        const auto count = std::count_if(sweep.rows.begin(), sweep.rows.end(),
                                         [&](const SweepRow& row) { return !(row.*has)(); });
        if (count > 0)
            lacking.push_back(fmt::format("{} of {} rows have no {}, which obscura-bench sweep "
                                          "STUDY --measure {} adds",
                                          count, sweep.rows.size(), what, what));
    };
    add("errors", &SweepRow::hasErrors);
    add("times", &SweepRow::hasTimes);
    return fmt::format("{}", fmt::join(lacking, "; "));
}

Sweep mergeSweeps(const std::vector<fs::path>& parts, const fs::path& folder) {
    return Merging(parts, folder).run();
}

} // namespace obscura
