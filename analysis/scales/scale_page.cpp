#include "analysis/scales/scale_page.h"

#include "analysis/scales/scale_table.h"
#include "analysis/scales/scale_words.h"
#include "report/html.h"

#include <fmt/format.h>

namespace obscura {

namespace {

std::string rowOf(const char* cellName, const Table& table, const std::vector<std::string>& cells) {
    std::string html;
    for (std::size_t i = 0; i < cells.size(); ++i)
        html += fmt::format("<{0}{1}>{2}</{0}>", cellName,
                            table.columns[i].number ? " class=\"number\"" : "", escaped(cells[i]));
    return html;
}

std::string notesOf(const Scaled& one) {
    std::string html;
    for (const std::string& line : scaleRemarks(one.result))
        html += "<li>" + escaped(line) + "</li>\n";
    return html.empty()
               ? html
               : fmt::format("<p>{} ({}), {}:</p>\n<ul>\n{}</ul>\n", escaped(one.kind->heading),
                             escaped(one.kind->source), escaped(placeOf(one.result.group)), html);
}

} // namespace

std::string scalesSection(const std::vector<Scaled>& scales) {
    if (scales.empty())
        return {};
    const Table table = scaleTable(scales);
    std::vector<std::string> headings;
    for (const Table::Column& column : table.columns)
        headings.push_back(column.heading);
    std::string html =
        fmt::format("<h2>Scales</h2>\n<div class=\"wide\"><table>\n<thead><tr>{}</tr>"
                    "</thead>\n<tbody>\n",
                    rowOf("th", table, headings));
    for (const auto& cells : table.rows)
        html += fmt::format("<tr>{}</tr>\n", rowOf("td", table, cells));
    html +=
        "</tbody></table></div>\n<p class=\"aside\">A scale begins at its first technique, which "
        "therefore has no interval; p is that of the step to the next higher technique, "
        "corrected by Holm for the steps of its scale. scales.csv has all digits.</p>\n"
        "<details><summary>What to know of each scale</summary>\n";
    for (const Scaled& one : scales)
        html += notesOf(one);
    return html + "</details>\n";
}

} // namespace obscura
