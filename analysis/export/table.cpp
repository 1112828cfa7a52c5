#include "analysis/export/table.h"

#include "base/csv.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

// Cells as the program writes them.
std::vector<std::string> cellsOf(const std::string& line) { return splitCsv(line).front().cells; }

template <typename Spell>
std::string text(const ExportTable& table, const char* separator, Spell spell) {
    std::vector<std::string> names;
    for (const TableColumn& column : table.columns)
        names.push_back(column.name);
    std::string content = fmt::format("{}\n", fmt::join(names, separator));
    for (std::vector<std::string> row : table.rows) {
        std::transform(row.begin(), row.end(), row.begin(), spell);
        content += fmt::format("{}\n", fmt::join(row, separator));
    }
    return content;
}

std::string tsvCell(std::string cell) {
    std::replace_if(
        cell.begin(), cell.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
    return cell.find_first_not_of(' ') == cell.npos ? "n/a" : cell;
}

} // namespace

std::vector<std::string> split(const std::string& joined, char separator) {
    std::vector<std::string> result;
    for (std::size_t begin = 0; begin < joined.size();) {
        const std::size_t end = std::min(joined.find(separator, begin), joined.size());
        result.push_back(joined.substr(begin, end - begin));
        begin = end + 1;
    }
    return result;
}

ExportTable tableOf(std::span<const Placed<Response>> rows, int version) {
    ExportTable table;
    const std::vector<Column> columns = responseColumns(version);
    for (const Column& column : columns)
        table.columns.push_back({std::string(column.name), std::string(column.description),
                                 std::string(column.expected)});
    for (const auto& [row, place] : rows) {
        table.rows.push_back(cellsOf(responseLine(row)));
        table.rows.back().resize(columns.size()); // later columns stand last
    }
    return table;
}

ExportTable tableOf(std::span<const Placed<PhaseRow>> rows) {
    ExportTable table{phaseColumns(), {}};
    for (const auto& [row, place] : rows)
        table.rows.push_back(cellsOf(phaseLine(row)));
    return table;
}

ExportTable tableOf(std::span<const Placed<AnswerRow>> rows) {
    ExportTable table{answerColumns(), {}};
    for (const auto& [row, place] : rows)
        table.rows.push_back(cellsOf(answerLine(row)));
    return table;
}

std::string csvText(const ExportTable& table) { return text(table, ",", csvCell); }
std::string tsvText(const ExportTable& table) { return text(table, "\t", tsvCell); }

} // namespace obscura
