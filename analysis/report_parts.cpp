#include "analysis/report_parts.h"

#include "report/html.h"
#include "report/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

// Figures are drawn for white paper. On a dark page they are turned over: what was white has the
// page's colour, hues stay as they were.
const std::string_view reportStyle =
    R"(:root { color-scheme: light dark; --ink: #1a1a1a; --paper: #ffffff; --soft: #555555; --line: #dddddd;
        --rule: #555555; --shade: #DCEBF5; --panel: #f3f3f3; --link: #0B5CAD; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #ebebeb; --paper: #141414; --soft: #b4b4b4; --line: #444444; --rule: #999999;
          --shade: #16364D; --panel: #222222; --link: #8EC7F5; }
  .drawing { filter: invert(.92) hue-rotate(180deg); }
}
body { color: var(--ink); background: var(--paper); }
h2 { border-color: var(--line); }
h3 { font-size: 1.02rem; margin: 1.6rem 0 .4rem; }
a { color: var(--link); }
a:focus-visible, .wide:focus-visible { outline: 3px solid var(--link); outline-offset: 2px; }
.aside, figcaption { color: var(--soft); font-size: .88rem; }
figcaption { max-width: 48rem; }
figcaption b { color: var(--ink); }
.stamp { background: #B33A00; color: white; font-size: 1.15rem; font-weight: bold;
         padding: .6rem 1rem; margin: 1rem 0; }
.answer li { margin: .35rem 0; }
.claims { font-weight: 600; }
.answer, .paste { font-size: 1.06rem; max-width: 48rem; }
.paste { background: var(--panel); padding: .3rem 1rem; font-size: 1rem; }
nav > ul { columns: 17rem 2; max-width: 48rem; }
nav > ul > li { break-inside: avoid; }
nav ul { margin: .3rem 0; padding-left: 1.2rem; }
nav { font-size: .92rem; }
.drawing { display: block; max-width: 760px; margin-bottom: .5rem; }
.drawing svg { display: block; width: 100%; height: auto; }
.narrow { display: none; max-width: 30rem; }
img { display: block; width: 100%; height: auto; }
.wide { max-width: 100%; }
thead th { border-color: var(--rule); vertical-align: bottom; }
tbody tr { border-color: var(--line); }
tbody th { white-space: normal; }
td, tbody th { min-width: 2.4rem; max-width: 26rem; }
.text { min-width: 11rem; }
.wide + .wide { margin-top: 1.2rem; }
thead .number { white-space: normal; }
.differs td { background: var(--shade); font-weight: 600; }
.fact { overflow-wrap: anywhere; max-width: none; }
.hash { font-family: monospace; }
.stamp, .paste, li { overflow-wrap: break-word; }
@media screen and (max-width: 820px) {
  .broad { display: none; }
  .narrow { display: block; }
  .wide img { width: 56rem; max-width: none; }
}
@page { size: A4; margin: 15mm; }
@media print {
  nav, .jump { display: none; }
  .stamp, .differs td { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  figure { break-inside: avoid; }
  h3 { break-after: avoid; }
  figcaption, .aside { font-size: 8pt; }
  .answer { font-size: 11pt; }
  td, tbody th { min-width: 0; }
  .text { min-width: 9rem; }
  .paste { background: none; border-left: 2pt solid var(--rule); font-size: 9pt; }
}
)";

namespace {

constexpr std::size_t shortText = 24; // letters: longer cells keep a width to be read in

std::string headings(const Table& table) {
    std::string html;
    for (const Table::Column& column : table.columns)
        html += fmt::format("<th scope=\"col\"{}>{}</th>", column.number ? " class=\"number\"" : "",
                            escaped(column.heading));
    return html;
}

std::string classOf(bool number, const std::string& cell) {
    return number ? " class=\"number\"" : letters(cell) > shortText ? " class=\"text\"" : "";
}

// All but the first.
std::string cells(const Table& table, const std::vector<std::string>& row) {
    std::string html;
    for (std::size_t i = 1; i < row.size(); ++i)
        html +=
            fmt::format("<td{}>{}</td>", classOf(table.columns[i].number, row[i]), escaped(row[i]));
    return html;
}

// Rows that begin with the same cell.
std::string group(const Table& table, std::size_t first, std::size_t end,
                  const std::vector<bool>& marked) {
    std::string html = "<tbody>\n";
    for (std::size_t i = first; i < end; ++i) {
        html += i < marked.size() && marked[i] ? "<tr class=\"differs\">" : "<tr>";
        if (i == first)
            html += end - first == 1
                        ? fmt::format("<th scope=\"row\"{}>{}</th>",
                                      classOf(false, table.rows[i][0]), escaped(table.rows[i][0]))
                        : fmt::format("<th scope=\"rowgroup\" rowspan=\"{}\">{}</th>", end - first,
                                      escaped(table.rows[i][0]));
        html += cells(table, table.rows[i]) + "</tr>\n";
    }
    return html + "</tbody>\n";
}

std::string drawn(const Figure& figure, double width, double height, const char* kind) {
    return fmt::format("<div class=\"drawing {}\">{}</div>\n", kind,
                       pageSvg(figure, static_cast<int>(std::lround(96 * width)),
                               static_cast<int>(std::lround(96 * height)),
                               fmt::format("{}-{}", figure.name, kind)));
}

std::string drawnTwice(const StudyFigure& figure) {
    const auto heightAt = [](const Figure& drawing, double width) {
        return width * drawing.height / drawing.width;
    };
    const Figure& narrow = figure.narrow ? *figure.narrow : figure.drawing;
    // One that is only made smaller keeps some height for its type.
    const double least = figure.narrow ? 0 : 0.75 * narrowFigure;
    return drawn(figure.drawing, wideFigure, heightAt(figure.drawing, wideFigure), "broad") +
           drawn(narrow, narrowFigure, std::max(heightAt(narrow, narrowFigure), least), "narrow");
}

} // namespace

std::string tableHtml(const Table& table, const std::string& label,
                      const std::vector<bool>& marked) {
    std::string html =
        fmt::format("<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"{}\"><table>\n"
                    "<thead><tr>{}</tr></thead>\n",
                    escaped(label), headings(table));
    for (std::size_t first = 0; first < table.rows.size();) {
        std::size_t end = first + 1;
        while (end < table.rows.size() && table.rows[end][0] == table.rows[first][0])
            ++end;
        html += group(table, first, end, marked);
        first = end;
    }
    return html + "</table></div>\n";
}

std::string figureHtml(const StudyFigure& figure, int number) {
    const std::string& name = figure.drawing.name;
    return fmt::format("<figure id=\"figure-{}\">\n{}<figcaption><b>Figure {}. {}.</b> {} "
                       "<a class=\"jump\" href=\"#numbers-{}\">Its numbers</a></figcaption>\n"
                       "</figure>\n",
                       name, drawnTwice(figure), number, escaped(figure.drawing.title),
                       escaped(figure.caption), name);
}

} // namespace obscura
