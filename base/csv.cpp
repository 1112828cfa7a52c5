#include "base/csv.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace obscura {

namespace {

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

CsvReader::CsvReader(std::string_view text) : text_(text), whole_(true) { skipMark(); }

CsvReader::CsvReader(const std::filesystem::path& path)
    : path_(path.string()), file_(std::fopen(path.c_str(), "rb")) {
    if (!file_)
        throw Error({path_, 0, 0, {}}, fmt::format("cannot be read: {}", std::strerror(errno)));
    fill();
    checkIsCsv(text_, path_);
    skipMark();
}

void CsvReader::Close::operator()(std::FILE* file) const { std::fclose(file); }

void CsvReader::skipMark() {
    if (text_.starts_with("\xEF\xBB\xBF"))
        at_ = 3;
}

// Reads on, keeping what has not yet been given out.
void CsvReader::fill() {
    constexpr std::size_t block = std::size_t{1} << 16;
    buffer_.erase(0, at_);
    start_ += static_cast<std::int64_t>(at_);
    at_ = 0;
    const std::size_t had = buffer_.size(), wanted = std::max(block, had);
    buffer_.resize(had + wanted);
    const std::size_t count = std::fread(buffer_.data() + had, 1, wanted, file_.get());
    if (count < wanted && std::ferror(file_.get()))
        throw Error({path_, 0, 0, {}}, fmt::format("cannot be read: {}", std::strerror(errno)));
    buffer_.resize(had + count);
    text_ = buffer_;
    whole_ = count < wanted;
}

void CsvReader::goTo(std::int64_t offset) {
    if (::fseeko(file_.get(), offset - 1, SEEK_SET) != 0)
        throw Error({path_, 0, 0, {}}, fmt::format("cannot be read: {}", std::strerror(errno)));
    start_ = offset - 1;
    buffer_.clear();
    at_ = 0;
    line_ = 1;
    for (std::size_t end = std::string_view::npos; end == std::string_view::npos;) {
        fill();
        end = text_.find('\n');
        at_ = end == text_.npos ? text_.size() : end + 1;
        if (whole_)
            return;
    }
}

bool CsvReader::next(CsvRecord& record) {
    if (at_ == text_.size() && !whole_)
        fill();
    if (at_ == text_.size())
        return false;
    for (;;) {
        const std::size_t start = at_;
        touched_ = quoted_ = false;
        split(record);
        if (!touched_ || whole_) {
            line_ +=
                quoted_
                    ? static_cast<int>(std::count(text_.begin() + start, text_.begin() + at_, '\n'))
                    : record.ended;
            return true;
        }
        at_ = start; // it may go on beyond what has been read
        fill();
    }
}

void CsvReader::split(CsvRecord& record) {
    const std::size_t start = at_;
    record.line = line_;
    record.fault.clear();
    std::size_t cells = 0;
    do {
        if (cells == record.cells.size())
            record.cells.emplace_back();
        record.cells[cells].clear();
        if (const std::string_view fault = cell(record.cells[cells++]); !fault.empty())
            record.fault = fault;
    } while (record.fault.empty() && take(","));
    record.cells.resize(cells);
    record.ended = take("\n") || take("\r\n");
    if (record.fault.empty() && !record.ended && !atEnd())
        record.fault = "a closing quote is followed by neither a comma nor the line's end";
    if (!record.fault.empty())
        record.ended = endFaulty(start);
}

bool CsvReader::atEnd() {
    const bool end = at_ == text_.size();
    touched_ |= end;
    return end;
}

bool CsvReader::take(std::string_view next) {
    const std::string_view rest = text_.substr(at_, next.size());
    touched_ |= rest.size() < next.size();
    if (rest != next)
        return false;
    at_ += next.size();
    return true;
}

// Both return a fault, or "".
std::string_view CsvReader::cell(std::string& value) {
    if (take("\""))
        return quotedCell(value);
    const auto isEnd = [&](std::size_t at) {
        const char c = text_[at];
        if (c > ',') // nearly all
            return false;
        return c == ',' || c == '\n' || c == '"' ||
               (c == '\r' && (at + 1 == text_.size() || text_[at + 1] == '\n'));
    };
    for (;;) {
        std::size_t end = at_;
        while (end < text_.size() && !isEnd(end))
            ++end;
        value.append(text_, at_, end - at_);
        at_ = end;
        if (atEnd() || text_[at_] != '\r' || at_ + 1 < text_.size())
            break;
        touched_ = true; // a return at the very end: of a line, or of a cell
        value += text_[at_++];
    }
    return !atEnd() && text_[at_] == '"'
               ? "a quote stands inside a cell that does not begin with one"
               : std::string_view();
}

std::string_view CsvReader::quotedCell(std::string& value) {
    quoted_ = true;
    while (!atEnd()) {
        const std::size_t quote = std::min(text_.find('"', at_), text_.size());
        value.append(text_, at_, quote - at_);
        at_ = quote;
        if (take("\"")) {
            if (!take("\""))
                return {};
            value += '"';
        }
    }
    return "a quote is opened and never closed";
}

// Goes on after the first line of the record; false when that line has no end.
bool CsvReader::endFaulty(std::size_t start) {
    const std::size_t end = text_.find('\n', start);
    at_ = end == text_.npos ? text_.size() : end + 1;
    return end != text_.npos;
}

std::vector<CsvRecord> splitCsv(std::string_view text) {
    std::vector<CsvRecord> records;
    CsvReader reader(text);
    for (CsvRecord record; reader.next(record);)
        records.push_back(record);
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
