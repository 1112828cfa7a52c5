#pragma once

#include "analysis/export/study_data.h"

#include <span>
#include <string>
#include <vector>

namespace obscura {

// A table of text, as it goes into files of any format.
struct ExportTable {
    std::vector<TableColumn> columns;
    std::vector<std::vector<std::string>> rows;
};

// What stands between the separators of one cell; nothing for an empty one.
std::vector<std::string> split(const std::string& joined, char separator);

// `version`: of the list of columns (responses.h).
ExportTable tableOf(std::span<const Placed<Response>> rows, int version);
ExportTable tableOf(std::span<const Placed<PhaseRow>> rows);
ExportTable tableOf(std::span<const Placed<AnswerRow>> rows);

std::string csvText(const ExportTable& table);

// As BIDS wants it: cells between tabs, n/a for what is missing. A tab or line end within a cell
// becomes a blank, for BIDS has no way to write it.
std::string tsvText(const ExportTable& table);

} // namespace obscura
