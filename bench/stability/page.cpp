#include "bench/stability/page.h"

#include "base/files.h"
#include "bench/kept_pictures.h"
#include "bench/stability/csv.h"
#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// The policy lets the page load nothing at all from elsewhere.
constexpr std::string_view head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width"/>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"/>
<title>Where ambient occlusion fails</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; background: white; margin: 2rem auto;
       padding: 0 1rem; max-width: 96rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin-bottom: 0; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .3rem; border-top: 1px solid #ccc; padding-top: .6rem; }
p { max-width: 60rem; margin: .3rem 0; }
.aside { color: #555; font-size: .88rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .85rem; }
.map td, .map th { padding: 0; border: 1px solid white; }
.map thead th { vertical-align: bottom; font-weight: 600; }
.map thead a { display: block; writing-mode: vertical-rl; transform: rotate(180deg);
               padding: .3rem .1rem; margin: 0 auto; white-space: nowrap; }
.map tbody th { text-align: left; font-weight: 600; white-space: nowrap; padding: 0 .6rem 0 0;
                position: sticky; left: 0; background: white; }
.map td a { display: block; min-width: 3rem; padding: .22rem .35rem; text-align: right;
            text-decoration: none; font-variant-numeric: tabular-nums; }
.map td.count { text-align: right; padding: 0 .6rem; font-weight: 600; }
.map a:focus-visible, .map a:hover { outline: 3px solid #0072B2; outline-offset: -3px; }
a { color: inherit; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; }
.strip { display: flex; flex-wrap: wrap; gap: .8rem; margin-top: .6rem; }
figure { margin: 0; max-width: 100%; }
figure:target { outline: 3px solid #0072B2; outline-offset: 4px; }
figure img, dialog img { border: 1px solid #bbb; max-width: 100%; height: auto; display: block; }
figcaption { font-size: .8rem; }
.key span { display: inline-block; padding: .1rem .6rem; font-variant-numeric: tabular-nums; }
dialog { max-width: 60rem; border: 1px solid #777; }
dialog::backdrop { background: rgb(0 0 0 / .35); }
dialog h2 { border: 0; margin-top: 0; padding-top: 0; }
dialog img { image-rendering: pixelated; width: 100%; margin: .4rem 0; box-sizing: border-box; }
.more { display: none; margin-top: .3rem; }
dialog .more { display: table; }
.more td { padding: .1rem .8rem .1rem 0; }
.more td + td { text-align: right; font-variant-numeric: tabular-nums; }
.more td + td + td { text-align: left; color: #555; }
@media print { .map td a { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
               figure { break-inside: avoid; } }
</style>
</head>
<body>
)";

// A link to a picture opens it with its numbers in front of the page instead of going there.
constexpr std::string_view tail = R"(<dialog aria-label="One result"></dialog>
<script>
"use strict";
const dialog = document.querySelector("dialog");
const cells = [...document.querySelectorAll(".map td a[href]")];
let shown = null;
function show(link) {
    const figure = document.getElementById(link.hash.slice(1));
    const section = figure.closest("section").cloneNode(true);
    const truth = document.getElementById(section.id + "-truth");
    const close = document.createElement("button");
    section.querySelectorAll(".strip").forEach(strip => strip.remove());
    close.textContent = "Close";
    close.addEventListener("click", () => dialog.close());
    dialog.replaceChildren(...section.children, ...figure.cloneNode(true).children,
                           ...(truth ? truth.cloneNode(true).children : []), close);
    dialog.querySelectorAll("[id]").forEach(element => element.removeAttribute("id"));
    if (!dialog.open)
        dialog.showModal();
    close.focus();
    shown = link;
}
function beside(link, across, down) {
    const row = link.closest("tr"), column = link.closest("td").cellIndex + across;
    const rows = [...row.parentElement.rows];
    const cell = rows[rows.indexOf(row) + down]?.cells[column];
    return cell?.querySelector("a[href]");
}
const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
document.addEventListener("keydown", event => {
    const from = dialog.open ? shown : event.target.closest?.(".map td a[href]");
    const next = from && steps[event.key] && beside(from, ...steps[event.key]);
    if (!next)
        return;
    event.preventDefault();
    dialog.open ? show(next) : next.focus();
});
dialog.addEventListener("close", () => shown?.focus());
for (const link of cells)
    link.addEventListener("click", event => { event.preventDefault(); show(link); });
</script>
</body>
</html>
)";

struct Colour {
    std::string_view background, text;
};

// Steps of severity, light to dark, so that they read in grey and to every kind of eye: passed,
// then five between passing and failing, then beyond. Text has a contrast of at least 4.5.
constexpr std::array<Colour, 7> colours = {{{"#EAF1F7", "#1a1a1a"},
                                            {"#FFF3C4", "#1a1a1a"},
                                            {"#FEDC87", "#1a1a1a"},
                                            {"#FDB04C", "#1a1a1a"},
                                            {"#E97B1B", "#1a1a1a"},
                                            {"#B64A04", "#ffffff"},
                                            {"#6B2603", "#ffffff"}}};

Colour colourOf(const StabilityTest& test, double value) {
    if (passes(test, value))
        return colours.front();
    const double severity = (std::abs(value) - test.pass) / (test.fail - test.pass);
    return severity < 1 ? colours[1 + static_cast<std::size_t>(severity * 5)] : colours.back();
}

// Three decimals; no value is a dash.
std::string spelt(double value) {
    if (std::isnan(value))
        return "–";
    const double rounded = std::round(value * 1000) / 1000;
    return fmt::format("{}{:.3f}", rounded < 0 ? "−" : "", std::abs(rounded));
}

std::string figureId(const StabilityTest& test, const std::string& configuration) {
    std::string id = fmt::format("{}-{}", test.id, configuration);
    std::replace(id.begin(), id.end(), ' ', '_');
    return escaped(id);
}

std::vector<std::string> picturesOf(const std::vector<StabilityCell>& cells) {
    std::vector<std::string> names;
    for (const StabilityCell& cell : cells)
        if (!cell.picture.empty())
            names.push_back(cell.picture);
    return names;
}

// In the order of the file.
std::vector<std::string> configurationsOf(const std::vector<StabilityCell>& cells) {
    std::vector<std::string> names;
    for (const StabilityCell& cell : cells)
        if (cell.configuration != truthName &&
            std::find(names.begin(), names.end(), cell.configuration) == names.end())
            names.push_back(cell.configuration);
    return names;
}

class PageWriter {
  public:
    PageWriter(std::span<const StabilityTest> tests, const std::vector<StabilityCell>& cells,
               const fs::path& folder)
        : tests_(tests), cells_(cells), folder_(folder), names_(configurationsOf(cells)),
          pictured_(keepsPictures(folder, picturesOf(cells))) {}

    bool isPictured() const { return pictured_; }

    std::string heatMap() const {
        std::string html = "<div class=\"wide\"><table class=\"map\">\n<thead><tr><th></th>";
        for (const StabilityTest& test : tests_)
            html += fmt::format("<th scope=\"col\"><a href=\"#{}\">{}</a></th>", test.id,
                                escaped(test.title));
        html += "<th scope=\"col\">failed</th></tr></thead>\n<tbody>\n";
        for (const std::string& name : names_)
            html += row(name);
        return html + "</tbody></table></div>\n";
    }

    std::string animation() const {
        const StabilityCell* worst = nullptr; // of several runs into one folder
        for (const StabilityCell& cell : cells_)
            if (moves(cell) && (!worst || cell.value > worst->value))
                worst = &cell;
        if (!worst || !pictured_)
            return {};
        return fmt::format("<h2>The worst flicker</h2>\n<p class=\"aside\">From left to "
                           "right: visibility, the truth, unreal change.</p>\n"
                           "<figure>{}</figure>\n",
                           picture(*worst, "The worst flicker",
                                   fmt::format("{}, {}: {}", worst->configuration, worst->test,
                                               spelt(worst->value))));
    }

    std::string sections() const {
        std::string html;
        for (const StabilityTest& test : tests_)
            html += section(test);
        return html;
    }

  private:
    std::string row(const std::string& name) const {
        std::string html = fmt::format("<tr><th scope=\"row\">{}</th>", escaped(name));
        int failed = 0;
        for (const StabilityTest& test : tests_) {
            const StabilityCell* cell = headline(cells_, name, test);
            html += cell ? mapCell(test, *cell) : "<td></td>";
            failed += cell && !passes(test, cell->value);
        }
        return html + fmt::format("<td class=\"count\">{}</td></tr>\n", failed);
    }

    static std::string mapCell(const StabilityTest& test, const StabilityCell& cell) {
        const Colour colour = colourOf(test, cell.value);
        return fmt::format("<td><a style=\"background:{};color:{}\"{} title=\"{}, {}\">{}</a></td>",
                           colour.background, colour.text,
                           cell.picture.empty()
                               ? ""
                               : fmt::format(" href=\"#{}\"", figureId(test, cell.configuration)),
                           escaped(cell.configuration), escaped(test.title), spelt(cell.value));
    }

    std::string section(const StabilityTest& test) const {
        std::string html = fmt::format(
            "<section id=\"{}\">\n<h2>{}</h2>\n<p>{}</p>\n<p class=\"aside\">Number: {}. Passed up "
            "to {:g}, darkest from {:g}.</p>\n<div class=\"strip\">\n",
            test.id, escaped(test.title), escaped(test.setUp), escaped(test.measure), test.pass,
            test.fail);
        if (const StabilityCell* truth = headline(cells_, truthName, test))
            html +=
                figure(test, *truth,
                       truth->value == 0
                           ? "ray tracing, and the scene"
                           : fmt::format("ray tracing with other rays: {}. Nothing below can be "
                                         "told from perfect",
                                         spelt(truth->value)));
        for (const std::string& name : names_)
            if (const StabilityCell* cell = headline(cells_, name, test))
                html += figure(test, *cell, fmt::format("{}: {}", name, spelt(cell->value)));
        return html + "</div>\n</section>\n";
    }

    std::string figure(const StabilityTest& test, const StabilityCell& cell,
                       const std::string& caption) const {
        if (cell.picture.empty())
            return {};
        return fmt::format("<figure id=\"{}\">{}{}</figure>\n", figureId(test, cell.configuration),
                           picture(cell, test.title, caption),
                           otherMeasures(test, cell.configuration));
    }

    std::string picture(const StabilityCell& cell, std::string_view title,
                        const std::string& caption) const {
        const std::string words =
            fmt::format("<figcaption><b>{}</b>{}</figcaption>", escaped(caption),
                        cell.note.empty() ? "" : " (" + escaped(cell.note) + ")");
        if (!pictured_)
            return words;
        return fmt::format(
            "<img loading=\"lazy\" alt=\"{}, {}\" src=\"{}\"/>{}", escaped(title),
            escaped(cell.configuration),
            dataAddress(moves(cell) ? "image/gif" : "image/png", readFile(folder_ / cell.picture)),
            words);
    }

    static bool moves(const StabilityCell& cell) {
        return fs::path(cell.picture).extension() == ".gif";
    }

    // Shown where the cell is picked.
    std::string otherMeasures(const StabilityTest& test, const std::string& name) const {
        std::string rows;
        for (const StabilityCell& cell : cells_)
            if (cell.configuration == name && cell.test == test.id &&
                cell.measure != test.measure && !moves(cell))
                rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>",
                                    escaped(cell.measure), spelt(cell.value), escaped(cell.note));
        return rows.empty() ? "" : "<table class=\"more\">" + rows + "</table>";
    }

    std::span<const StabilityTest> tests_;
    const std::vector<StabilityCell>& cells_;
    const fs::path& folder_;
    std::vector<std::string> names_;
    bool pictured_;
};

std::string key() {
    constexpr const char* words[] = {"passed", "failed", "", "", "", "", "as bad as it gets"};
    std::string html = "<p class=\"key\">";
    for (std::size_t i = 0; i < colours.size(); ++i)
        html +=
            fmt::format("<span style=\"background:{};color:{}\">{}</span>", colours[i].background,
                        colours[i].text, *words[i] ? words[i] : "&nbsp;");
    return html + "</p>\n";
}

constexpr std::string_view introduction =
    "<h1>Where ambient occlusion fails</h1>\n"
    "<p>Every technique with the settings of its paper or program, in scenes whose truth is known "
    "from closed forms or ray tracing. Lengths are in radii. Numbers are errors: 0 is perfect, "
    "above 0 is too dark unless the test says otherwise. Pick a number (click, or Enter; arrows "
    "move) for its picture and all that was measured; pick a test for everybody's pictures.</p>\n";

constexpr std::string_view aboutPictures =
    "<p class=\"aside\">Pictures: visibility on the left; on the right what is wrong with it, red "
    "too dark and blue too light, in full colour where the heat map is darkest.</p>\n";
constexpr std::string_view aboutNoPictures =
    "<p class=\"aside\">The folder has no pictures, and this page therefore has none.</p>\n";

} // namespace

std::string stabilityHtml(std::span<const StabilityTest> tests,
                          const std::vector<StabilityCell>& cells, const fs::path& folder,
                          const std::string& about) {
    const PageWriter writer(tests, cells, folder);
    return std::string(head) + std::string(introduction) +
           std::string(writer.isPictured() ? aboutPictures : aboutNoPictures) + key() +
           writer.heatMap() + writer.animation() + writer.sections() +
           fmt::format("<h2>Measured with</h2>\n<pre class=\"aside\">{}</pre>\n", escaped(about)) +
           std::string(tail);
}

} // namespace obscura
