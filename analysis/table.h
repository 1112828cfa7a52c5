#pragma once

#include "analysis/findings.h"

#include <string>
#include <vector>

namespace obscura {

// The results as people read them, one row per condition; the terminal and the report print it.
struct Table {
    struct Column {
        std::string heading;
        bool number = false; // set to the right
    };
    std::vector<Column> columns;
    std::vector<std::vector<std::string>> rows;
};
Table resultTable(const std::vector<Tally>& tallies);

// Aligned for a terminal, UTF-8; ends with a line feed.
std::string alignedText(const Table& table);

// The results as programs read them: one line per condition, every figure with all its digits, an
// empty cell where there is none.
std::string resultCsv(const Findings& findings);

} // namespace obscura
