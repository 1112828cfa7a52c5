#include "bench/sweep/files.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/files.h"
#include "renderer/techniques/technique.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr int newestVersion = 3; // of the folder's files; version 1 said none

// Every field with its name, once for writing and reading; Row may be const.

template <typename Fields, typename Visit>
void eachErrorField(const std::string& prefix, Fields& errors, Visit& visit) {
    visit(prefix + "_rmse", errors.rmse);
    visit(prefix + "_bias", errors.bias);
    visit(prefix + "_ssim", errors.ssim);
    visit(prefix + "_flip", errors.flip);
}

template <typename Row, typename Visit>
void eachError(Row& row, Visit& visit) {
    eachErrorField("full_raw", row.raw, visit);
    eachErrorField("full_matched", row.matched, visit);
    eachErrorField("depth_raw", row.depthRaw, visit);
    eachErrorField("depth_matched", row.depthMatched, visit);
    eachErrorField("lit_raw", row.litRaw, visit);
    visit("lit_raw_jod", row.litRaw.jod);
    eachErrorField("lit_matched", row.litMatched, visit);
    visit("lit_matched_jod", row.litMatched.jod);
}

template <typename Row, typename Visit>
void eachCost(Row& row, Visit& visit) {
    visit("frames", row.frames);
    visit("total_median_ms", row.total.median);
    visit("total_5th_percentile_ms", row.total.low);
    visit("total_95th_percentile_ms", row.total.high);
    for (std::size_t i = 0; i < row.work.size(); ++i)
        visit(workNames()[i] + "_median_ms", row.work[i]);
    visit("gbuffer_median_ms", row.gbuffer);
    visit("ratio_to_gbuffer", row.toGbuffer);
    visit("ratio_to_starcraft_16", row.toStarcraft);
    visit("starcraft_16_odd_to_even", row.starcraftRepeat);
    visit("bytes_per_pixel", row.bytes);
    visit("fetches_per_pixel", row.fetches);
}

template <typename Row, typename Visit>
requires std::is_same_v<std::remove_const_t<Row>, SweepRow>
void eachField(Row& row, Visit visit) {
    visit("configuration", row.configuration);
    visit("technique", row.technique);
    visit("name", row.name);
    visit("settings", row.settings);
    visit("fitted", row.fitted);
    visit("scene", row.scene);
    visit("view", row.view);
    visit("radius", row.radius);
    visit("width", row.width);
    visit("height", row.height);
    eachCost(row, visit);
    eachError(row, visit);
    visit("thumbnail", row.thumbnail);
}

template <typename Row, typename Visit>
requires std::is_same_v<std::remove_const_t<Row>, GrowthRow>
void eachField(Row& row, Visit visit) {
    visit("configuration", row.configuration);
    visit("axis", row.axis);
    visit("value", row.value);
    visit("milliseconds", row.milliseconds);
}

template <typename Machine, typename Visit>
requires std::is_same_v<std::remove_const_t<Machine>, SweepMachine>
void eachField(Machine& machine, Visit visit) {
    visit("vendor", machine.vendor);
    visit("renderer", machine.renderer);
    visit("glVersion", machine.glVersion);
    visit("processor", machine.processor);
    visit("method", machine.method);
    visit("program", machine.program);
    visit("study", machine.study);
    visit("display", machine.display);
    visit("clocks", machine.clocks);
    visit("date", machine.date);
}

std::string spelt(const std::string& text) { return csvCell(text); }
std::string spelt(int number) { return fmt::format("{}", number); }
std::string spelt(double number) { return std::isnan(number) ? "" : fmt::format("{}", number); }

bool read(const std::string& cell, std::string& text) {
    text = cell;
    return true;
}
bool read(const std::string& cell, int& number) { return readCell(cell, number); }
bool read(const std::string& cell, double& number) {
    number = std::numeric_limits<double>::quiet_NaN();
    return cell.empty() || readCell(cell, number);
}

template <typename Row>
std::vector<std::string> columnsOf() {
    std::vector<std::string> names;
    const Row row;
    eachField(row, [&](const std::string& name, const auto&) { names.push_back(name); });
    return names;
}

template <typename Row>
std::string csvOf(const std::vector<Row>& rows) {
    std::string text = fmt::format("{}\n", fmt::join(columnsOf<Row>(), ","));
    for (const Row& row : rows) {
        std::vector<std::string> cells;
        eachField(row, [&](const auto&, const auto& value) { cells.push_back(spelt(value)); });
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

// `names`: the columns of the file, in order; a field without one is NaN, or as Row has it.
template <typename Row>
Row rowOf(const CsvRecord& record, const std::vector<std::string>& names, const std::string& file) {
    Row row;
    std::size_t next = 0;
    eachField(row, [&](const std::string& name, auto& value) {
        const bool there = next < names.size() && names[next] == name;
        if constexpr (std::is_same_v<decltype(value), double&>)
            value = std::numeric_limits<double>::quiet_NaN();
        if (!there)
            return;
        const int column = static_cast<int>(++next);
        const std::string& cell = record.cells[next - 1];
        if (!read(cell, value))
            throw Error({file, record.line, column, name},
                        fmt::format("expected a {}number, found \"{}\"",
                                    std::is_same_v<decltype(value), int&> ? "whole " : "", cell));
    });
    return row;
}

// A file of an earlier version may lack columns that came later.
template <typename Row>
std::vector<Row> rowsOf(const fs::path& path, int formatVersion) {
    const std::string file = path.string();
    std::vector<std::string> names = columnsOf<Row>();
    const std::vector<CsvRecord> records = splitCsv(readFile(path));
    if (records.empty())
        throw Error({file, 0, 0, {}}, "expected a header line, found an empty file");
    if (formatVersion < newestVersion)
        std::erase_if(names, [&](const std::string& name) {
            const auto& header = records.front().cells;
            return std::find(header.begin(), header.end(), name) == header.end();
        });
    checkHeader(records.front(), names, file);
    std::vector<Row> rows;
    for (const CsvRecord& record : records) {
        if (const std::string fault = faultOf(record, names.size()); !fault.empty())
            throw Error({file, record.line, 0, {}}, fault);
        if (&record != &records.front())
            rows.push_back(rowOf<Row>(record, names, file));
    }
    return rows;
}

SweepMachine readMachine(const fs::path& path) {
    const std::string file = path.string();
    SweepMachine machine;
    try {
        const auto root = nlohmann::json::parse(readFile(path));
        machine.formatVersion = root.value("formatVersion", 1);
        if (machine.formatVersion < 1 || machine.formatVersion > newestVersion)
            throw Error({file, 0, 0, "formatVersion"},
                        fmt::format("expected 1 ... {}, found {}; a later obscura-bench wrote this "
                                    "sweep, and reads it",
                                    newestVersion, machine.formatVersion));
        eachField(machine, [&](const std::string& name, std::string& value) {
            if (name == "display" && machine.formatVersion < 3)
                return;
            if (!root.contains(name) || !root[name].is_string())
                throw Error({file, 0, 0, name},
                            fmt::format("expected a text of this name, found {}",
                                        root.contains(name) ? root[name].dump() : "none"));
            root[name].get_to(value);
        });
        machine.rows = root.value("rows", 0);
    } catch (const nlohmann::json::exception& error) { // says line and column itself
        throw Error({file, 0, 0, {}}, fmt::format("expected JSON: {}", error.what()));
    }
    return machine;
}

std::string machineJson(const SweepMachine& machine) {
    nlohmann::ordered_json root;
    root["formatVersion"] = newestVersion;
    eachField(machine, [&](const auto& name, const std::string& value) { root[name] = value; });
    root["rows"] = machine.rows;
    return root.dump(2) + "\n";
}

// The part of a text that must be equal: of the method its name, not the times by which it was
// chosen.
std::string keptEqual(const std::string& name, const std::string& value) {
    return name == "method" ? value.substr(0, value.find(':')) : value;
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

std::string identityOf(const SweepRow& row) {
    return fmt::format("\"{}\" on view \"{}\" of \"{}\" at {} x {}, R {}", row.configuration,
                       row.view, row.scene, row.width, row.height, row.radius);
}

std::string identityOf(const GrowthRow& row) {
    return fmt::format("\"{}\" at {} {}", row.configuration, row.axis, row.value);
}

} // namespace

std::string sweepCsv(const std::vector<SweepRow>& rows) { return csvOf(rows); }
std::string growthCsv(const std::vector<GrowthRow>& rows) { return csvOf(rows); }

void joinMachines(SweepMachine& all, SweepMachine part, const std::string& first,
                  const fs::path& folder) {
    std::map<std::string, std::string*> others;
    eachField(part, [&](const std::string& name, std::string& value) { others[name] = &value; });
    eachField(all, [&](const std::string& name, std::string& value) {
        const std::string& other = *others.at(name);
        if (keptEqual(name, value) == keptEqual(name, other))
            return;
        if (name != "clocks" && name != "date")
            throw Error({(folder / "sweep.json").string(), 0, 0, name},
                        fmt::format("expected \"{}\", as {}, found \"{}\"; rows can stand "
                                    "in one folder only if this is the same; --out names another",
                                    value, first, other));
        if (!other.empty() &&
            fmt::format(", {}, ", value).find(fmt::format(", {}, ", other)) == value.npos)
            value += (value.empty() ? "" : ", ") + other;
    });
}

void writeSweep(const fs::path& folder, const Sweep& sweep) {
    writeFile(folder / "sweep.csv", sweepCsv(sweep.rows));
    writeFile(folder / "growth.csv", growthCsv(sweep.growth));
    writeFile(folder / "sweep.json", machineJson(sweep.machine));
}

Sweep readSweep(const fs::path& folder) {
    const SweepMachine machine = readMachine(folder / "sweep.json");
    return {machine, rowsOf<SweepRow>(folder / "sweep.csv", machine.formatVersion),
            rowsOf<GrowthRow>(folder / "growth.csv", machine.formatVersion)};
}

std::string incompleteness(const Sweep& sweep) {
    const auto whole = static_cast<std::size_t>(sweep.machine.rows);
    return sweep.rows.size() >= whole
               ? ""
               : fmt::format("{} of the study's {} rows; the others are in other parts, or were "
                             "not measured yet",
                             sweep.rows.size(), whole);
}

Sweep mergeSweeps(const std::vector<fs::path>& parts, const fs::path& folder) {
    Sweep all;
    Measured measured;
    if (fs::exists(folder / "sweep.json"))
        throw Error({(folder / "sweep.json").string(), 0, 0, {}},
                    "expected a folder without a sweep, found one; --out names another");
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Sweep part = readSweep(parts[i]);
        if (i == 0)
            all.machine = part.machine;
        joinMachines(all.machine, part.machine, "in " + parts.front().string(), parts[i]);
        for (SweepRow& row : part.rows) {
            measured.add(identityOf(row), parts[i] / "sweep.csv");
            if (!row.thumbnail.empty()) {
                const std::string name = fmt::format("part-{}/{}", i + 1, row.thumbnail);
                writeFile(folder / name, readFile(parts[i] / row.thumbnail));
                row.thumbnail = name;
            }
            all.rows.push_back(std::move(row));
        }
        for (GrowthRow& row : part.growth) {
            measured.add(identityOf(row), parts[i] / "growth.csv");
            all.growth.push_back(std::move(row));
        }
    }
    writeSweep(folder, all);
    return all;
}

} // namespace obscura
