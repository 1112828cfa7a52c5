#include "bench/stability/csv.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

const std::vector<std::string>& columns() {
    static const std::vector<std::string> names{"configuration", "technique", "test",    "measure",
                                                "value",         "pass",      "picture", "note"};
    return names;
}

std::string passCell(std::span<const StabilityTest> tests, const StabilityCell& cell) {
    for (const StabilityTest& test : tests)
        if (test.id == cell.test && test.measure == cell.measure)
            return passes(test, cell.value) ? "1" : "0";
    return "";
}

StabilityCell cellOf(const CsvRecord& record, const std::string& file) {
    const Place place{file, record.line, 0, {}};
    if (const std::string fault = faultOf(record, columns().size()); !fault.empty())
        throw Error(place, fault);
    const std::vector<std::string>& cells = record.cells;
    double value = 0;
    if (!readCell(cells[4], value))
        throw Error(place, fmt::format("expected a number, found \"{}\"", cells[4]));
    return {cells[0], cells[1], cells[2], cells[3], value, cells[6], cells[7]};
}

} // namespace

std::string stabilityCsv(std::span<const StabilityTest> tests,
                         const std::vector<StabilityCell>& cells) {
    std::string csv = fmt::format("{}\n", fmt::join(columns(), ","));
    for (const StabilityCell& cell : cells)
        csv += fmt::format("{},{},{},{},{:.6g},{},{},{}\n", csvCell(cell.configuration),
                           csvCell(cell.technique), csvCell(cell.test), csvCell(cell.measure),
                           cell.value, passCell(tests, cell), csvCell(cell.picture),
                           csvCell(cell.note));
    return csv;
}

std::vector<StabilityCell> readStabilityCsv(const std::filesystem::path& path) {
    const std::vector<CsvRecord> records = splitCsv(readFile(path));
    if (records.empty())
        throw Error({path.string(), 0, 0, {}}, "expected a header line, found an empty file");
    checkHeader(records.front(), columns(), path.string());
    std::vector<StabilityCell> cells;
    for (const CsvRecord& record : std::span(records).subspan(1))
        cells.push_back(cellOf(record, path.string()));
    return cells;
}

const StabilityCell* headline(const std::vector<StabilityCell>& cells,
                              const std::string& configuration, const StabilityTest& test) {
    const auto found = std::find_if(cells.begin(), cells.end(), [&](const StabilityCell& cell) {
        return cell.configuration == configuration && cell.test == test.id &&
               cell.measure == test.measure;
    });
    return found == cells.end() ? nullptr : &*found;
}

std::string pictureName(std::string_view test, const std::string& configuration) {
    return fmt::format("pictures/{}-{}.png", test, plainName(configuration));
}

bool passes(const StabilityTest& test, double value) { return std::abs(value) <= test.pass; }

} // namespace obscura
