#include "base/csv.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace obscura {

namespace {

class Splitter {
  public:
    explicit Splitter(std::string_view text) : text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF"))
            text_.remove_prefix(3);
    }

    bool atEnd() const { return at_ == text_.size(); }

    CsvRecord record() {
        CsvRecord record;
        record.line = line_;
        const std::size_t start = at_;
        do
            record.fault = cell(record.cells.emplace_back());
        while (record.fault.empty() && take(","));
        record.ended = take("\n") || take("\r\n");
        if (record.fault.empty() && !record.ended && !atEnd())
            record.fault = "a closing quote is followed by neither a comma nor the line's end";
        if (!record.fault.empty())
            record.ended = endFaulty(start);
        line_ += static_cast<int>(std::count(text_.begin() + start, text_.begin() + at_, '\n'));
        return record;
    }

  private:
    bool sees(std::string_view next) const { return text_.substr(at_).starts_with(next); }

    bool take(std::string_view next) {
        if (!sees(next))
            return false;
        at_ += next.size();
        return true;
    }

    // Both return a fault, or "".
    std::string cell(std::string& value) {
        if (take("\""))
            return quotedCell(value);
        for (; !atEnd() && !sees(",") && !sees("\n") && !sees("\r\n"); ++at_) {
            if (sees("\""))
                return "a quote stands inside a cell that does not begin with one";
            value += text_[at_];
        }
        return {};
    }

    std::string quotedCell(std::string& value) {
        for (; !atEnd(); ++at_) {
            if (take("\"") && !sees("\""))
                return {};
            value += text_[at_];
        }
        return "a quote is opened and never closed";
    }

    // Goes on after the first line of the record; false when that line has no end.
    bool endFaulty(std::size_t start) {
        const std::size_t end = text_.find('\n', start);
        at_ = end == text_.npos ? text_.size() : end + 1;
        return end != text_.npos;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
};

template <typename T>
bool readNumber(std::string_view cell, T& number) {
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    return error == std::errc{} && end == cell.data() + cell.size();
}

constexpr std::string_view saveAgain = "; save it again as CSV, UTF-8, separated by commas";

// What the whole text is instead of CSV; "" when nothing speaks against it.
std::string otherFormat(std::string_view text) {
    const auto begins = [&](std::string_view with) { return text.starts_with(with); };
    if (begins("\x1F\x8B"))
        return "compressed by gzip; unpack it first (gunzip)";
    if (begins("PK\x03\x04"))
        return std::string("a zip archive or a spreadsheet (xlsx, ods)").append(saveAgain);
    if (begins("\xD0\xCF\x11\xE0"))
        return std::string("an old Excel workbook (xls)").append(saveAgain);
    if (begins("\xFF\xFE") || begins("\xFE\xFF") ||
        (text.size() > 1 && (text[0] == '\0') != (text[1] == '\0')))
        return std::string("text in UTF-16").append(saveAgain);
    if (text.substr(0, text.find_first_not_of(" \t\r\n") + 1).ends_with('<'))
        return std::string("a web page (HTML or XML)").append(saveAgain);
    return {};
}

} // namespace

void checkIsCsv(std::string_view text, const std::string& file) {
    if (const std::string other = otherFormat(text); !other.empty())
        throw Error({file, 1, 0, {}}, "expected CSV, found " + other);
    if (text.substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0).starts_with('#'))
        throw Error(
            {file, 1, 0, {}},
            "expected the header, found a comment (#), which CSV has not; remove that line");
    const std::string_view header = text.substr(0, text.find('\n'));
    if (std::count(header.begin(), header.end(), '\r') > 1)
        throw Error(
            {file, 1, 0, {}},
            fmt::format("expected lines that end in LF or CR LF, found CR alone{}", saveAgain));
    if (header.find(',') != header.npos)
        return;
    for (const char separator : {';', '\t'})
        if (header.find(separator) != header.npos)
            throw Error({file, 1, 0, {}},
                        fmt::format("expected cells separated by commas, found {}{}",
                                    separator == ';' ? "semicolons" : "tabs", saveAgain));
}

std::vector<CsvRecord> splitCsv(std::string_view text) {
    std::vector<CsvRecord> records;
    for (Splitter splitter(text); !splitter.atEnd();)
        records.push_back(splitter.record());
    return records;
}

bool isBlank(const CsvRecord& record) {
    const auto empty = [](const std::string& cell) {
        return cell.find_first_not_of(" \t\r\n") == cell.npos;
    };
    return record.fault.empty() && std::all_of(record.cells.begin(), record.cells.end(), empty);
}

std::string faultOf(const CsvRecord& record, std::size_t columns) {
    if (!record.ended)
        return "the line has no end: it was cut off while being written";
    if (!record.fault.empty())
        return record.fault;
    if (record.cells.size() != columns)
        return fmt::format("expected {} columns, found {}", columns, record.cells.size());
    return {};
}

void checkHeader(const CsvRecord& header, const std::vector<std::string>& names,
                 const std::string& file) {
    for (std::size_t i = 0; i < header.cells.size(); ++i)
        if (header.cells[i].find_first_not_of(" \t\r") == std::string::npos)
            throw Error({file, header.line, static_cast<int>(i) + 1, {}},
                        i == 0 ? "expected column \"" + names.front() +
                                     "\", found one without a name, such as pandas writes for its "
                                     "index; remove the column (index=False)"
                               : "found a column without a name; remove it (in every line, where "
                                 "it is a comma too many at the end)");
    for (const std::string& cell : header.cells)
        if (std::find(names.begin(), names.end(), cell) == names.end())
            throw Error({file, 1, 0, cell}, "unknown column" + (nearest(cell, names).empty()
                                                                    ? "; remove it, in every line"
                                                                    : suggestion(cell, names)));
    for (std::size_t i = 0; i < names.size(); ++i)
        if (i >= header.cells.size() || header.cells[i] != names[i])
            throw Error({file, 1, static_cast<int>(i) + 1, {}},
                        fmt::format("expected column \"{}\", found \"{}\"", names[i],
                                    i < header.cells.size() ? header.cells[i] : "end of line"));
    if (header.cells.size() > names.size())
        throw Error({file, 1, 0, header.cells.back()}, "the column stands twice in the header");
}

bool readCell(std::string_view cell, int& number) { return readNumber(cell, number); }
bool readCell(std::string_view cell, std::int64_t& number) { return readNumber(cell, number); }
bool readCell(std::string_view cell, double& number) { return readNumber(cell, number); }

std::string csvCell(std::string_view value) {
    if (value.find_first_of(",\"\n\r") == value.npos)
        return std::string(value);
    std::string cell = "\"";
    for (const char c : value)
        cell.append(c == '"' ? 2 : 1, c);
    return cell + "\"";
}

} // namespace obscura
