#include "protocols/reader/cell_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <regex>

namespace obscura {

namespace {

bool continues(char c) { return (c & 0xC0) == 0x80; }

// Bytes of the UTF-8 character that the text begins with; 0 when it is none. Overlong spellings,
// surrogates and what lies above U+10FFFF are none.
std::size_t characterLength(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text.front());
    if (lead < 0x80)
        return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < length ||
        !std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length),
                     continues))
        return 0;
    const auto second = static_cast<unsigned char>(text[1]);
    const bool wrong = (lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
                       (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F);
    return wrong ? 0 : length;
}

bool isControl(std::string_view character) {
    if (character.size() == 2)
        return character[0] == '\xC2' && static_cast<unsigned char>(character[1]) < 0xA0;
    const auto c = static_cast<unsigned char>(character[0]);
    return character.size() == 1 &&
           ((c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F);
}

// No-break, of any width, of none, and marks of direction and byte order.
constexpr std::array<std::string_view, 30> blanks = {" ",
                                                     "\t",
                                                     "\n",
                                                     "\r",
                                                     "\xC2\xA0",
                                                     "\xC2\xAD",
                                                     "\xE1\x9A\x80",
                                                     "\xE2\x80\x80",
                                                     "\xE2\x80\x81",
                                                     "\xE2\x80\x82",
                                                     "\xE2\x80\x83",
                                                     "\xE2\x80\x84",
                                                     "\xE2\x80\x85",
                                                     "\xE2\x80\x86",
                                                     "\xE2\x80\x87",
                                                     "\xE2\x80\x88",
                                                     "\xE2\x80\x89",
                                                     "\xE2\x80\x8A",
                                                     "\xE2\x80\x8B",
                                                     "\xE2\x80\x8C",
                                                     "\xE2\x80\x8D",
                                                     "\xE2\x80\x8E",
                                                     "\xE2\x80\x8F",
                                                     "\xE2\x80\xA8",
                                                     "\xE2\x80\xA9",
                                                     "\xE2\x80\xAF",
                                                     "\xE2\x81\x9F",
                                                     "\xE2\x81\xA0",
                                                     "\xE3\x80\x80",
                                                     "\xEF\xBB\xBF"};

std::string_view trimmed(std::string_view text) {
    const auto begins = [&](std::string_view blank) { return text.starts_with(blank); };
    const auto ends = [&](std::string_view blank) { return text.ends_with(blank); };
    for (auto blank = blanks.begin(); blank != blanks.end();)
        if (blank = std::find_if(blanks.begin(), blanks.end(), begins); blank != blanks.end())
            text.remove_prefix(blank->size());
    for (auto blank = blanks.begin(); blank != blanks.end();)
        if (blank = std::find_if(blanks.begin(), blanks.end(), ends); blank != blanks.end())
            text.remove_suffix(blank->size());
    return text;
}

// Characters without width that no script needs, and marks of direction. (Joiners, U+200C and
// U+200D, belong to Persian, Indic scripts and emoji.)
constexpr std::array<std::string_view, 15> unseen = {
    "\xC2\xAD",     "\xE2\x80\x8B", "\xE2\x80\x8E", "\xE2\x80\x8F", "\xE2\x80\xAA",
    "\xE2\x80\xAB", "\xE2\x80\xAC", "\xE2\x80\xAD", "\xE2\x80\xAE", "\xE2\x81\xA0",
    "\xE2\x81\xA6", "\xE2\x81\xA7", "\xE2\x81\xA8", "\xE2\x81\xA9", "\xEF\xBB\xBF"};

std::string withoutUnseen(std::string_view name) {
    std::string seen;
    for (std::size_t at = 0; at < name.size();) {
        const std::string_view rest = name.substr(at);
        const auto found = std::find_if(unseen.begin(), unseen.end(), [&](std::string_view mark) {
            return rest.starts_with(mark);
        });
        if (found == unseen.end())
            seen += name[at];
        at += found == unseen.end() ? 1 : found->size();
    }
    return seen;
}

bool matches(std::string_view cell, const char* pattern) {
    return cell.size() < 100 && std::regex_match(cell.begin(), cell.end(), std::regex(pattern));
}

bool isScientific(std::string_view cell) { return matches(cell, R"(\d([.,]\d+)?E[+-]?\d+)"); }

} // namespace

namespace {

// Letters (one that no number has among them), digits and a few signs: what most names are.
bool isPlain(std::string_view name) {
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    return std::all_of(name.begin(), name.end(),
                       [&](char c) {
                           return isLetter(c) || (c >= '0' && c <= '9') || c == '-' || c == '_';
                       }) &&
           std::any_of(name.begin(), name.end(),
                       [&](char c) { return isLetter(c) && c != 'e' && c != 'E'; });
}

} // namespace

std::string foreignByte(std::string_view cell) {
    for (std::size_t at = 0; at < cell.size();) {
        if (cell[at] >= ' ' && cell[at] <= '~') {
            ++at;
            continue;
        }
        const std::size_t length = characterLength(cell.substr(at));
        const std::string where =
            fmt::format("found the byte 0x{:02X} at byte {} of the cell",
                        static_cast<unsigned char>(length == 2 ? cell[at + 1] : cell[at]), at + 1);
        if (length == 0)
            return fmt::format("expected text in UTF-8, {}; save the file again as UTF-8", where);
        if (isControl(cell.substr(at, length)))
            return fmt::format("expected text, {}, a control character; the file is damaged: "
                               "take the original, or remove that byte",
                               where);
        at += length;
    }
    return {};
}

std::string strayName(std::string_view name) {
    if (isPlain(name))
        return {};
    if (const std::string_view bare = trimmed(name); bare != name)
        return fmt::format("expected \"{}\", found \"{}\", with blanks (perhaps invisible) at its "
                           "ends, which would make another name of it; remove them",
                           bare, name);
    if (const std::string seen = withoutUnseen(name); seen != name)
        return fmt::format("expected \"{}\", found \"{}\", with characters in it that nobody sees, "
                           "which make another name of it; type it anew",
                           seen, name);
    if (isScientific(name))
        return fmt::format("expected a name, found \"{}\"{}", name, cellHint(name));
    return {};
}

std::string cellHint(std::string_view cell) {
    if (trimmed(cell) != cell)
        return "; remove the blanks at its ends";
    if (matches(cell, R"(-?\d+,\d+)"))
        return "; a number with a decimal comma: write a point";
    if (isScientific(cell))
        return "; a spreadsheet has made a number of it: take the original file";
    if (matches(cell, "[Tt][Rr][Uu][Ee]|[Ff][Aa][Ll][Ss][Ee]"))
        return "; a spreadsheet has made a truth value of it: write 1 for true, 0 for false";
    return {};
}

} // namespace obscura
