#include "report/paper_figure.h"

#include "base/files.h"
#include "report/gnuplot.h"
#include "report/html.h"
#include "report/marks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace obscura {

using fmt::format;

namespace {

// Font sizes are points; both terminals count 96ths of an inch.
std::string svgTerminal(const Figure& figure) {
    return format("set terminal svg enhanced size {:.0f},{:.0f} dynamic font 'sans-serif,8' "
                  "fontscale 1.333 background rgb 'white'\n",
                  96 * figure.width, 96 * figure.height);
}

std::string pdfTerminal(const Figure& figure) {
    return format("set terminal pdfcairo enhanced size {},{} font 'sans-serif,8' fontscale 0.75\n",
                  figure.width, figure.height);
}

// Ids and what refers to them, within tags only.
std::string renamed(const std::string& svg, const std::string& prefix) {
    constexpr std::array<std::string_view, 5> before = {" id='", " id=\"", "href='#", "href=\"#",
                                                        "url(#"};
    std::string result;
    bool inTag = false;
    for (std::size_t at = 0; at < svg.size(); ++at) {
        inTag = svg[at] == '<' || (inTag && svg[at] != '>');
        result += svg[at];
        if (inTag && std::any_of(before.begin(), before.end(), [&](std::string_view text) {
                return std::string_view(result).ends_with(text);
            }))
            result += prefix;
    }
    return result;
}

} // namespace

std::string pageSvg(const Figure& figure, int width, int height, const std::string& prefix) {
    const std::string terminal =
        format("set terminal svg enhanced size {},{} dynamic font 'sans-serif,8' "
               "fontscale 1.625 background rgb 'white'\n",
               width, height);
    const std::string svg = gnuplotSvg(terminal + figure.script, figure.title);
    constexpr std::string_view opening = "<svg";
    return format("<svg class=\"{}\" role=\"img\" aria-label=\"{}\"", prefix,
                  escaped(figure.title)) +
           renamed(svg.substr(opening.size()), prefix + "-");
}

void writeFigures(const std::filesystem::path& folder, const std::vector<Figure>& figures) {
    for (const Figure& figure : figures) {
        const std::string howTo =
            format("# gnuplot -e \"{}; set output '{}.pdf'\" {}.gnuplot\n",
                   pdfTerminal(figure).substr(0, pdfTerminal(figure).size() - 1), figure.name,
                   figure.name);
        writeFile(folder / (figure.name + ".gnuplot"), howTo + figure.script);
        writeFile(folder / (figure.name + ".svg"),
                  gnuplotSvg(svgTerminal(figure) + figure.script, figure.title));
        writeFile(folder / (figure.name + ".pdf"), gnuplotPdf(pdfTerminal(figure) + figure.script));
    }
}

namespace plot {

const char* const style = R"(set encoding utf8
set border 3 linecolor rgb '#555555'
set grid linetype 1 linewidth 0.5 linecolor rgb '#DDDDDD'
set key Left reverse samplen 1 spacing 1.1
)";

std::string ticks(const char* axis, const Axis& range) {
    std::string list;
    for (const Tick& tick : range.ticks)
        list += format("{}'{}' {}{}", list.empty() ? "" : ", ", tick.label, tick.value,
                       tick.label.empty() ? " 1" : "");
    return format("{2} logscale {0}\nset {0}range [{3}:{4}]\nset {0}tics nomirror out ({1})\n",
                  axis, list, range.logarithmic ? "set" : "unset", range.low, range.high);
}

std::string block(const std::string& name, const std::string& lines) {
    return format("${} << END\n{}END\n", name, lines);
}

std::string pointStyle(std::size_t series) {
    const Mark mark = markOf(series);
    return format("pointtype {} pointsize 0.7 linecolor rgb '{}'", mark.gnuplot, mark.colour);
}

std::string list(const std::vector<std::string>& elements) {
    return format("{}", fmt::join(elements, ", \\\n  "));
}

} // namespace plot

} // namespace obscura
