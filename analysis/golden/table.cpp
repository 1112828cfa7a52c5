#include "analysis/golden/table.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

GoldenTable::GoldenTable(const std::filesystem::path& path) : file_(path.string()) {
    CsvReader reader(path);
    CsvRecord record;
    if (!reader.next(record))
        throw Error({file_, 1, 0, {}}, "expected a header, found nothing");
    header_ = record.cells;
    while (reader.next(record)) {
        if (isBlank(record))
            continue;
        if (!record.fault.empty() || record.cells.size() != header_.size())
            throw Error({file_, record.line, 0, {}}, faultOf(record, header_.size()));
        rows_.push_back(record);
    }
}

std::size_t GoldenTable::columnOf(std::string_view name) const {
    const auto found = std::find(header_.begin(), header_.end(), name);
    if (found == header_.end())
        throw Error({file_, 1, 0, {}},
                    fmt::format("expected a column \"{}\"{}", name, suggestion(name, header_)));
    return static_cast<std::size_t>(found - header_.begin());
}

const std::string& GoldenTable::text(std::size_t row, std::string_view column) const {
    return rows_.at(row).cells[columnOf(column)];
}

void GoldenTable::fail(std::size_t row, std::size_t column, std::string_view expected) const {
    throw Error({file_, rows_[row].line, static_cast<int>(column) + 1, header_[column]},
                fmt::format("expected {}, found \"{}\"", expected, rows_[row].cells[column]));
}

// R writes NA, NaN, Inf and -Inf for what we call absent.
double GoldenTable::number(std::size_t row, std::string_view column) const {
    const std::size_t at = columnOf(column);
    const std::string& cell = rows_.at(row).cells[at];
    double value = 0;
    if (readCell(cell, value))
        return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
    if (cell == "NA" || cell == "NaN" || cell == "Inf" || cell == "-Inf")
        return std::numeric_limits<double>::quiet_NaN();
    fail(row, at, "a number");
}

int GoldenTable::whole(std::size_t row, std::string_view column) const {
    const std::size_t at = columnOf(column);
    int value = 0;
    if (!readCell(rows_.at(row).cells[at], value) || value < 0)
        fail(row, at, "a whole number >= 0");
    return value;
}

} // namespace obscura
