#include "bench/sweep/files.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/files.h"
#include "bench/sweep/fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr int newestVersion = 4; // of the folder's files; version 1 said none

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
            if ((name == "display" && machine.formatVersion < 3) ||
                ((name == "errorsBy" || name == "notes") && machine.formatVersion < 4))
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

} // namespace

std::string sweepCsv(const std::vector<SweepRow>& rows) { return csvOf(rows); }
std::string growthCsv(const std::vector<GrowthRow>& rows) { return csvOf(rows); }

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

} // namespace obscura
