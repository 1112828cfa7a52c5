#include "analysis/report.h"

#include "analysis/chart.h"
#include "analysis/table.h"
#include "analysis/verdict.h"
#include "base/files.h"
#include "base/version.h"
#include "report/html.h"

#include <fmt/format.h>

#include <set>

namespace obscura {

namespace {

constexpr std::string_view style =
    R"(.stamp { background: #B33A00; color: white; font-size: 1.15rem;
         font-weight: bold; padding: .6rem 1rem; margin: 1rem 0; }
figure svg, figure img { width: 100%; height: auto; }
.differs td { background: #DCEBF5; }
.fact { overflow-wrap: anywhere; }
.hash { font-family: monospace; }
@media print { .stamp, .differs td { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
)";

std::string paragraphs(const Findings& findings) {
    std::string text;
    for (const std::string& sentence : summaryOf(findings))
        text += (text.empty() ? "" : " ") + sentence;
    return element("p", text);
}

std::string row(const char* cellName, const Table& table, const std::vector<std::string>& cells) {
    std::string html;
    for (std::size_t i = 0; i < cells.size(); ++i)
        html += fmt::format("<{0}{1}>{2}</{0}>", cellName,
                            table.columns[i].number ? " class=\"number\"" : "", escaped(cells[i]));
    return html;
}

std::string tableHtml(const Table& table, const std::vector<Tally>& tallies) {
    std::vector<std::string> headings;
    for (const Table::Column& column : table.columns)
        headings.push_back(column.heading);
    std::string html = fmt::format("<div class=\"wide\"><table>\n<thead><tr>{}</tr></thead>\n"
                                   "<tbody>\n",
                                   row("th", table, headings));
    const auto verdicts = verdictsOf(tallies);
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        html += fmt::format("<tr{}>{}</tr>\n",
                            verdicts[i] && verdicts[i]->differs() ? " class=\"differs\"" : "",
                            row("td", table, table.rows[i]));
    return html + "</tbody></table></div>\n";
}

constexpr std::string_view tableNote = R"(<p class="aside">Votes for the more realistic of two
images; shaded where p (Holm) is below .05. b share: with the 95 % interval of Clopper
and Pearson, which excludes 50 % exactly where p (exact) is below .05. χ²: against an even split, one degree of freedom.
p (exact): two-sided binomial, and the one to trust. p (Holm): the same, corrected for the number of
tests of its hypothesis, so that among them any false difference has a chance of at most 5 %. g:
Cohen's, share − ½. JOD: how far b lies above a in just-objectionable differences; 1 means that 75 %
prefer b. Same, orders balanced: the share as it would be were b shown first and second equally often, with
Newcombe's interval. The CSV written with this page has all digits and more: other intervals, Bayes factors,
tests of equivalence, Benjamini and Hochberg's p.</p>
)";

std::string results(const Findings& findings) {
    return "<h2>Results</h2>\n<figure>\n" + chartSvg(findings) + "</figure>\n" +
           tableHtml(resultTable(findings.tallies), findings.tallies) + std::string(tableNote);
}

std::string acrossConditions(const Findings& findings) {
    if (findings.tests.empty())
        return {};
    const Table table = testTable(findings);
    std::vector<std::string> headings;
    for (const Table::Column& column : table.columns)
        headings.push_back(column.heading);
    std::string html = fmt::format("<h2>Across conditions and people</h2>\n<div class=\"wide\">"
                                   "<table>\n<thead><tr>{}</tr></thead>\n<tbody>\n",
                                   row("th", table, headings));
    for (const auto& cells : table.rows)
        html += fmt::format("<tr>{}</tr>\n", row("td", table, cells));
    return html + "</tbody></table></div>\n<p class=\"aside\">p (Holm): corrected "
                  "for the groups of conditions of which the same is asked; other p are not "
                  "corrected. tests.csv has all digits.</p>\n";
}

std::string contactSheets(const Manifest& stimuli) {
    std::string html;
    for (const FileRecord& sheet : stimuli.contactSheets) {
        const std::filesystem::path path = stimuli.folder / sheet.path;
        const std::string bytes = readFile(path);
        if (sha256(bytes) != sheet.sha256)
            throw Error({path.string(), 0, 0, {}},
                        "not the contact sheet that the stimuli's manifest describes; run "
                        "obscura-stimuli again");
        html += fmt::format("<figure><img alt=\"Every pair, its occlusion and its difference\" "
                            "src=\"{}\"/></figure>\n",
                            dataAddress("image/png", bytes));
    }
    return html;
}

std::string occlusionTable(const Manifest& stimuli) {
    std::string html = "<div class=\"wide\"><table>\n<thead><tr><th>Condition</th><th>image</th>"
                       "<th>technique</th><th class=\"number\">mean occlusion</th>"
                       "<th class=\"number\">radius, m</th></tr></thead>\n<tbody>\n";
    for (const ConditionRecord& condition : stimuli.conditions)
        for (const ImageRecord& image : condition.images) {
            const bool first = &image == &condition.images.front();
            const auto once = [&](const std::string& cell) { return first ? cell : ""; };
            const std::size_t rows = condition.images.size();
            html +=
                fmt::format("<tr>{}<td>{}</td><td>{}</td><td class=\"number\">{:.3f}</td>{}</tr>\n",
                            once(fmt::format("<th scope=\"row\" rowspan=\"{}\">{}</th>", rows,
                                             escaped(condition.condition))),
                            escaped(image.role), escaped(image.name), image.meanOcclusion,
                            once(fmt::format("<td class=\"number\" rowspan=\"{}\">{:g}</td>", rows,
                                             condition.radius)));
        }
    return html + "</tbody></table></div>\n";
}

std::string renderedBy(const Manifest& stimuli) {
    std::set<std::string> makers;
    for (const ConditionRecord& condition : stimuli.conditions)
        for (const ImageRecord& image : condition.images)
            makers.insert(fmt::format("obscura-stimuli {} ({}), OpenGL {}, {}, {}",
                                      image.recipe.programVersion, stimuli.commit,
                                      image.recipe.glVersion, image.recipe.glRenderer,
                                      image.recipe.glVendor));
    return fmt::format("{} × {} pixels, by {}", stimuli.width, stimuli.height,
                       fmt::join(makers, "; "));
}

std::string stimuliSection(const Manifest& stimuli) {
    return "<h2>Stimuli</h2>\n" + contactSheets(stimuli) + occlusionTable(stimuli);
}

std::string factRow(const Fact& fact) {
    const bool isHash = fact.name.find("SHA-256") != std::string::npos;
    return fmt::format("<tr><th scope=\"row\">{}</th><td class=\"fact{}\">{}</td></tr>\n",
                       escaped(fact.name), isHash ? " hash" : "", escaped(fact.text));
}

std::string unreadable(const std::vector<BadRow>& rows) {
    std::string html;
    for (const BadRow& bad : rows)
        html += "<li>" + escaped(bad.place.prefix() + bad.message) + "</li>\n";
    return html.empty() ? html : "<p>Rows that could not be read:</p>\n<ul>\n" + html + "</ul>\n";
}

std::string howItWasRun(const Findings& findings) {
    std::vector<Fact> facts;
    if (findings.conduct)
        facts = factsOf(*findings.conduct);
    if (findings.stimuli)
        facts.push_back({"Images rendered", renderedBy(*findings.stimuli)});
    facts.push_back({"Analysed by", fmt::format("obscura-analysis {} ({})", version(), commit())});
    std::string html = "<h2>How the study was run</h2>\n";
    if (!findings.conduct)
        html += element("p", "These are published counts: how they were gathered, and whether "
                             "orders were balanced, cannot be told from them.");
    html += "<table><tbody>\n";
    for (const Fact& fact : facts)
        html += factRow(fact);
    html += "</tbody></table>\n";
    return html + (findings.conduct ? unreadable(findings.conduct->bad) : "");
}

} // namespace

std::string reportHtml(const Findings& findings) {
    const std::string stamp = stampOf(findings);
    const std::string mark = stamp.empty() ? "" : fmt::format("[{}] ", sourceOf(findings));
    std::string html = pageHead(mark + findings.title, style);
    html += element("h1", findings.title);
    std::vector<std::string> loud = cautionsOf(findings);
    if (!stamp.empty())
        loud.insert(loud.begin(), stamp);
    for (const std::string& line : loud)
        html += fmt::format("<p class=\"stamp\">{}</p>\n", escaped(line));
    html += paragraphs(findings) + results(findings) + acrossConditions(findings);
    if (findings.stimuli)
        html += stimuliSection(*findings.stimuli);
    return html + howItWasRun(findings) + "</body>\n</html>\n";
}

} // namespace obscura
