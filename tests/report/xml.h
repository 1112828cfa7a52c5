#pragma once

#include <algorithm>
#include <initializer_list>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace obscura::test {

// "" when every element is closed in order and every "&" begins an entity; else the first fault.
inline std::string faultOfXml(const std::string& text) {
    static const std::regex token(
        R"(<!DOCTYPE[^>]*>|<!--[\s\S]*?-->|<(/?)([A-Za-z][\w:-]*)((?:\s+[\w:-]+\s*=\s*(?:"[^"<]*"|'[^'<]*'))*)\s*(/?)>|&#?\w+;|[<&])",
        std::regex::optimize);
    std::vector<std::string> open;
    for (std::sregex_iterator it(text.begin(), text.end(), token), end; it != end; ++it) {
        const std::smatch& match = *it;
        if (match.str() == "<" || match.str() == "&")
            return text.substr(static_cast<std::size_t>(match.position()), 60);
        if (!match[2].matched || match[4].length() > 0)
            continue;
        if (match[1].length() == 0)
            open.push_back(match[2]);
        else if (open.empty() || open.back() != match[2])
            return "</" + match[2].str() + ">";
        else
            open.pop_back();
    }
    return open.empty() ? "" : "<" + open.back() + ">";
}

// "" when the page forbids itself to load anything, and nothing in it would; else what does.
inline std::string foreignReference(const std::string& page) {
    if (page.find("Content-Security-Policy\" content=\"default-src 'none'") == page.npos)
        return "no policy";
    const auto follows = [&](std::size_t at, std::initializer_list<std::string_view> allowed) {
        return std::any_of(allowed.begin(), allowed.end(), [&](std::string_view text) {
            return page.compare(at, text.size(), text) == 0;
        });
    };
    for (const std::string& reference :
         std::vector<std::string>{"src=\"", "href=\"", "src='", "href='", "url(",
                                  "http:", "https:", "@import", "<link", "<iframe"})
        for (std::size_t at = 0; (at = page.find(reference, at)) != page.npos; ++at) {
            const bool ours = reference.back() != ':' && reference[0] != '<' &&
                              follows(at + reference.size(), {"data:", "#"});
            // The names of SVG's namespaces are no references: nothing loads them.
            const std::string_view before = std::string_view(page).substr(0, at);
            const bool name = before.ends_with("xmlns=\"") || before.ends_with("xmlns:xlink=\"");
            if (!ours && !name)
                return page.substr(at, 60);
        }
    return "";
}

} // namespace obscura::test
