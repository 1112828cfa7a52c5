#include "protocols/reader/views_file.h"

#include "protocols/reader/study_parts.h"
#include "protocols/reader/study_text.h"

#include <sstream>

namespace obscura {

std::vector<View> parseViews(const std::string& text, const std::string& file) {
    const toml::table table = parseToml(text, file);
    TomlTable root(table, file, "");
    std::vector<View> views;
    if (root.has("scenes"))
        for (auto& [name, each] : root.tables("scenes", "views, [scenes.NAME]"))
            views.push_back(parseView(name, std::move(each)));
    root.finish();
    return views;
}

std::string viewsText(const std::vector<View>& views, const std::string& comment) {
    std::string text;
    std::istringstream lines(comment);
    for (std::string line; std::getline(lines, line);)
        text += "# " + line + "\n";
    for (const View& view : views)
        text += "\n" + tomlTable("scenes", view.name, fieldsOf(view));
    return text;
}

} // namespace obscura
