#include "bench/stability_csv.h"

#include "protocols/csv.h"
#include "protocols/error.h"
#include "protocols/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace obscura {

namespace {

constexpr const char* header = "configuration,technique,test,measure,value,pass,picture,note";
constexpr std::size_t columns = 8;

std::string passCell(std::span<const StabilityTest> tests, const StabilityCell& cell) {
    for (const StabilityTest& test : tests)
        if (test.id == cell.test && test.measure == cell.measure)
            return passes(test, cell.value) ? "1" : "0";
    return "";
}

double numberIn(const std::string& cell, const Place& place) {
    double value = 0;
    const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (fault != std::errc() || end != cell.data() + cell.size())
        throw Error(place, fmt::format("expected a number, found \"{}\"", cell));
    return value;
}

} // namespace

std::string stabilityCsv(std::span<const StabilityTest> tests,
                         const std::vector<StabilityCell>& cells) {
    std::string csv = fmt::format("{}\n", header);
    for (const StabilityCell& cell : cells)
        csv += fmt::format("{},{},{},{},{:.6g},{},{},{}\n", csvCell(cell.configuration),
                           csvCell(cell.technique), csvCell(cell.test), csvCell(cell.measure),
                           cell.value, passCell(tests, cell), csvCell(cell.picture),
                           csvCell(cell.note));
    return csv;
}

std::vector<StabilityCell> readStabilityCsv(const std::filesystem::path& path) {
    const std::vector<CsvRecord> records = splitCsv(readFile(path));
    std::vector<StabilityCell> cells;
    for (const CsvRecord& record : records) {
        const Place place{path.string(), record.line, 0, {}};
        if (!record.fault.empty() || record.cells.size() != columns)
            throw Error(place, fmt::format("expected {} cells: {}", columns, header));
        if (&record == &records.front()) {
            if (fmt::format("{}", fmt::join(record.cells, ",")) != header)
                throw Error(place, fmt::format("expected the header {}", header));
            continue;
        }
        cells.push_back({record.cells[0], record.cells[1], record.cells[2], record.cells[3],
                         numberIn(record.cells[4], place), record.cells[6], record.cells[7]});
    }
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

bool passes(const StabilityTest& test, double value) { return std::abs(value) <= test.pass; }

} // namespace obscura
