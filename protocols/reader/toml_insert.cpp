#include "protocols/reader/toml_insert.h"

#include "protocols/reader/study_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

bool isBefore(const toml::source_position& a, const toml::source_position& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
}

// Where the last of what belongs to a node ends. The library ends a table with its heading.
toml::source_position endOf(const toml::node& node) {
    toml::source_position end = node.source().end;
    const auto extend = [&](const toml::node& inner) {
        if (const auto at = endOf(inner); isBefore(end, at))
            end = at;
    };
    if (const toml::table* table = node.as_table())
        for (const auto& [key, value] : *table)
            extend(value);
    if (const toml::array* array = node.as_array())
        for (const toml::node& value : *array)
            extend(value);
    return end;
}

// A text by lines, which count from 1 as TOML's do. All offsets are bytes of the text.
class Lines {
  public:
    explicit Lines(const std::string& text) : text_(text) {
        for (std::size_t at = 0; at != std::string::npos && at <= text.size();) {
            starts_.push_back(at);
            at = text.find('\n', at);
            at = at == std::string::npos ? at : at + 1;
        }
    }

    std::size_t count() const { return starts_.size(); }
    // Without its line end.
    std::string_view line(std::size_t number) const {
        const std::size_t start = starts_[number - 1];
        std::string_view content = std::string_view(text_).substr(start, end(number) - start);
        return content;
    }
    std::size_t end(std::size_t number) const {
        std::size_t at = number < count() ? starts_[number] - 1 : text_.size();
        return at > starts_[number - 1] && text_[at - 1] == '\r' ? at - 1 : at;
    }
    std::string_view indent(std::size_t number) const {
        const std::string_view content = line(number);
        return content.substr(0, std::min(content.find_first_not_of(" \t"), content.size()));
    }
    bool isBlank(std::size_t number) const { return indent(number).size() == line(number).size(); }
    bool isComment(std::size_t number) const {
        return !isBlank(number) && line(number)[indent(number).size()] == '#';
    }
    // Columns count characters, not bytes; a file may begin with a mark that is no character.
    std::size_t offset(const toml::source_position& at) const {
        std::size_t byte = starts_[at.line - 1];
        if (byte == 0 && text_.starts_with("\xEF\xBB\xBF"))
            byte = 3;
        for (toml::source_index column = 1; column < at.column && byte < text_.size(); ++column)
            for (++byte; byte < text_.size() && (text_[byte] & 0xC0) == 0x80; ++byte) {
            }
        return byte;
    }
    char after(std::size_t byte, std::string_view skipped) const {
        const std::size_t at = text_.find_first_not_of(skipped, byte);
        return at == std::string::npos ? '\n' : text_[at];
    }

  private:
    const std::string& text_;
    std::vector<std::size_t> starts_;
};

struct Insertion {
    std::size_t at;
    std::string text;
};

// The last line of a block that ends in `line`: remarks right below belong to it, unless they stand
// right above what follows.
std::size_t lastLine(const Lines& lines, std::size_t line) {
    std::size_t last = line;
    while (last < lines.count() && lines.isComment(last + 1))
        ++last;
    return last == lines.count() || lines.isBlank(last + 1) ? last : line;
}

// Whether blank lines stand between blocks: above this heading, or its remarks.
bool isSpaced(const Lines& lines, std::size_t heading) {
    std::size_t above = heading - 1;
    while (above > 0 && lines.isComment(above))
        --above;
    return above == 0 || lines.isBlank(above);
}

std::string block(const NewTable& table) {
    std::string text = table.name.empty()
                           ? fmt::format("[[{}]]\n{}", table.parent, tomlLines(table.fields))
                           : tomlTable(table.parent, table.name, table.fields);
    text.pop_back();
    return text;
}

Insertion below(const Lines& lines, const toml::node& last, const NewTable& table) {
    const std::size_t line = lastLine(lines, endOf(last).line);
    const bool spaced = isSpaced(lines, last.source().begin.line);
    return {lines.end(line), (spaced ? "\n\n" : "\n") + block(table)};
}

// After the last line that is not blank.
Insertion atEnd(const Lines& lines, const NewTable& table) {
    std::size_t line = lines.count();
    while (line > 1 && lines.isBlank(line))
        --line;
    return {lines.end(line), "\n\n" + block(table)};
}

// `name = { ... }` on a line of its own, below another one.
Insertion asLine(const Lines& lines, const toml::node& last, const NewTable& table) {
    const std::size_t line = lastLine(lines, endOf(last).line);
    return {lines.end(line), fmt::format("\n{}{} = {}", lines.indent(last.source().begin.line),
                                         tomlKey(table.name), tomlInline(table.fields))};
}

// `{ ... }` after the last one of a list in brackets.
std::vector<Insertion> asItem(const Lines& lines, const toml::node& last, const NewTable& table) {
    const toml::source_position begin = last.source().begin;
    const std::size_t end = lines.offset(endOf(last));
    const std::string item = tomlInline(table.fields);
    const bool comma = lines.after(end, " \t") == ',';
    const bool ownLine = lines.indent(begin.line).size() + 1 == begin.column;
    if (!ownLine || lines.after(end, " \t,") == ']')
        return {{end, ", " + item}};
    const std::string line = fmt::format("\n{}{}", lines.indent(begin.line), item);
    const Insertion added{lines.end(lastLine(lines, endOf(last).line)), comma ? line + "," : line};
    return comma ? std::vector{added} : std::vector{Insertion{end, ","}, added};
}

// The last of a table's tables, in the order of the file.
const toml::node* lastOf(const toml::table& parent) {
    const toml::node* last = nullptr;
    for (const auto& [name, value] : parent)
        if (!last || isBefore(last->source().begin, value.source().begin))
            last = &value;
    return last;
}

std::vector<Insertion> insertionsOf(const Lines& lines, const toml::table& root,
                                    const std::string& file, const NewTable& table) {
    const toml::node* parent = root.get(table.parent);
    if (!parent)
        return {atEnd(lines, table)};
    if (const toml::array* list = parent->as_array(); list && !list->empty()) {
        const toml::table* last = list->back().as_table();
        if (last && last->is_inline())
            return asItem(lines, *last, table);
        return {below(lines, list->back(), table)};
    }
    const toml::table* tables = parent->as_table();
    if (!tables || tables->is_inline()) {
        const toml::source_position at = parent->source().begin;
        throw Error({file, static_cast<int>(at.line), static_cast<int>(at.column), table.parent},
                    fmt::format("expected tables with headings, [{}.NAME], to which one can be "
                                "added, found none; write it so, or add this by hand: {}",
                                table.parent, tomlInline(table.fields)));
    }
    const toml::node* last = lastOf(*tables);
    if (!last)
        return {below(lines, *parent, table)};
    return {last->is_table() && last->as_table()->is_inline() ? asLine(lines, *last, table)
                                                              : below(lines, *last, table)};
}

} // namespace

std::string withTables(std::string text, const std::string& file,
                       const std::vector<NewTable>& tables) {
    const std::string lineEnd = text.find("\r\n") == std::string::npos ? "\n" : "\r\n";
    for (const NewTable& table : tables) {
        const toml::table root = parseToml(text, file);
        std::vector<Insertion> insertions = insertionsOf(Lines(text), root, file, table);
        std::reverse(insertions.begin(), insertions.end()); // the last first: offsets stay right
        for (Insertion& insertion : insertions) {
            for (std::size_t at = 0; lineEnd != "\n" && at < insertion.text.size(); ++at)
                if (insertion.text[at] == '\n')
                    insertion.text.replace(at++, 1, lineEnd);
            text.insert(insertion.at, insertion.text);
        }
    }
    if (!text.ends_with('\n'))
        text += lineEnd;
    return text;
}

} // namespace obscura
