#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// One record of a CSV text as RFC 4180 defines it; a quoted cell may hold commas and line feeds.
struct CsvRecord {
    std::vector<std::string> cells;
    int line = 0;      // where it begins, from 1
    bool ended = true; // false for a last record without line feed: a torn write
    std::string fault; // why it cannot be split into cells; "" when it can
};

// A CSV text record by record, the header's too. A faulty one ends with its first line, so that a
// stray quote cannot swallow the records below it. Lines may end in CR LF, and the text may begin
// with a byte order mark: spreadsheets write both.
class CsvReader {
  public:
    explicit CsvReader(std::string_view text); // which must outlive the reader
    // A file, of which no more than a few records are in memory at any time. An Error when it
    // cannot be read or is no CSV (checkIsCsv).
    explicit CsvReader(const std::filesystem::path& path);

    // The next record, in the memory of the one before; false at the end.
    bool next(CsvRecord& record);

    // In a file, goes to what follows the first line feed from byte `offset` - 1 on (offset > 0),
    // as if a record began there, and counts lines from 1 again.
    void goTo(std::int64_t offset);
    std::int64_t offset() const { return start_ + static_cast<std::int64_t>(at_); }
    int line() const { return line_; } // of the next record

  private:
    struct Close {
        void operator()(std::FILE* file) const;
    };

    void skipMark();
    void fill();
    void split(CsvRecord& record);
    bool atEnd();
    bool take(std::string_view next);
    std::string_view cell(std::string& value);
    std::string_view quotedCell(std::string& value);
    bool endFaulty(std::size_t start);

    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::string buffer_; // of the file
    std::string_view text_;
    std::int64_t start_ = 0; // of the text, in the file
    std::size_t at_ = 0;
    int line_ = 1;
    bool whole_ = false;   // the text goes to its end
    bool touched_ = false; // the record could not be told without looking beyond the text
    bool quoted_ = false;
};

// All of them.
std::vector<CsvRecord> splitCsv(std::string_view text);

// Refuses a text that is another format under the name of CSV (compressed, a spreadsheet's own,
// UTF-16, a web page, other separators, line ends of CR alone), saying in plain words which and
// what to do.
void checkIsCsv(std::string_view text, const std::string& file);

// Nothing but separators and blanks: a line as spreadsheets and editors leave it, and no row.
bool isBlank(const CsvRecord& record);

// Why a record is not a whole line of so many cells; "" when it is.
std::string faultOf(const CsvRecord& record, std::size_t columns);

// The header must name these columns in this order; an Error at the first that differs.
void checkHeader(const CsvRecord& header, const std::vector<std::string>& names,
                 const std::string& file);

// The whole cell as a number; false when it is anything else.
bool readCell(std::string_view cell, int& number);
bool readCell(std::string_view cell, std::int64_t& number);
bool readCell(std::string_view cell, double& number);

// The value as one cell, quoted where it must be.
std::string csvCell(std::string_view value);

} // namespace obscura
