#include "report/lettering.h"

#include <algorithm>
#include <sstream>

namespace obscura {

namespace {

bool begins(char c) { return (c & 0xC0) != 0x80; } // a code point

} // namespace

std::size_t letters(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins));
}

std::string shortened(const std::string& text, std::size_t most) {
    if (letters(text) <= most)
        return text;
    std::size_t end = 0;
    for (std::size_t count = 0; end < text.size(); ++end)
        if (begins(text[end]) && ++count == most)
            break;
    return text.substr(0, end) + "…";
}

std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;)
        if (lines.empty() || letters(lines.back()) + 1 + letters(word) > most)
            lines.push_back(word);
        else
            lines.back() += " " + word;
    return lines;
}

} // namespace obscura
