#pragma once

#include "base/csv.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// A CSV file whose columns are asked for by name.
class GoldenTable {
  public:
    explicit GoldenTable(const std::filesystem::path& path);

    std::size_t size() const { return rows_.size(); }
    const std::vector<std::string>& header() const { return header_; }
    // An Error when there is no such column, or when the cell is no number.
    const std::string& text(std::size_t row, std::string_view column) const;
    double number(std::size_t row, std::string_view column) const;
    int whole(std::size_t row, std::string_view column) const;

  private:
    std::size_t columnOf(std::string_view name) const;
    [[noreturn]] void fail(std::size_t row, std::size_t column, std::string_view expected) const;

    std::string file_;
    std::vector<std::string> header_;
    std::vector<CsvRecord> rows_;
};

} // namespace obscura
