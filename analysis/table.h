#pragma once

#include "analysis/findings.h"

#include <optional>
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

// A p-value as a cell: three decimals, or "<0.001".
std::string pCell(double p);
// All of a number's digits, as programs read them; empty where there is none.
std::string digits(std::optional<double> value);
// Where people read a table that has no such number.
inline constexpr const char* dash = "–";

// Tests beyond single conditions.
Table testTable(const Findings& findings);

// Aligned for a terminal, UTF-8; ends with a line feed.
std::string alignedText(const Table& table);

// The results as programs read them: one line per condition, every figure with all its digits, an
// empty cell where there is none.
std::string resultCsv(const Findings& findings);
std::string testsCsv(const Findings& findings); // the same, a line for each test beyond conditions

// The tests as a terminal shows them, each question once; ends with a line feed.
std::string testsText(const Findings& findings);

} // namespace obscura
