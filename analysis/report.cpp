#include "analysis/report.h"

#include "analysis/figure_list.h"
#include "analysis/methods_text.h"
#include "analysis/report_parts.h"
#include "analysis/results.h"
#include "analysis/scales/scale_table.h"
#include "analysis/scales/scale_words.h"
#include "analysis/starters.h"
#include "analysis/statistics.h"
#include "analysis/table.h"
#include "analysis/verdict.h"
#include "base/files.h"
#include "base/version.h"
#include "report/html.h"
#include "report/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

std::string listOf(const std::vector<std::string>& sentences, const char* kind) {
    std::string html;
    for (const std::string& sentence : sentences)
        html += element("li", sentence);
    return html.empty() ? html : fmt::format("<ul class=\"{}\">\n{}</ul>\n", kind, html);
}

// First what was claimed, then what else is to know.
std::string answer(const Findings& findings) {
    std::string html = "<h2 id=\"answer\">The answer</h2>\n";
    if (!findings.claims.empty())
        html += "<ul class=\"answer claims\">\n";
    for (const ClaimResult& claim : findings.claims)
        html += fmt::format("<li><strong>{}</strong> {}</li>\n", escaped(answerOf(claim)),
                            escaped(groundsOf(claim)));
    if (!findings.claims.empty())
        html += "</ul>\n";
    const std::vector<std::string> sentences = summaryOf(findings);
    const auto others = sentences.begin() + static_cast<std::ptrdiff_t>(findings.claims.size());
    return html + listOf({others, sentences.end()}, "answer");
}

std::string figureSection(const std::vector<StudyFigure>& figures) {
    std::string html = "<h2 id=\"figures\">Figures</h2>\n";
    for (std::size_t i = 0; i < figures.size(); ++i)
        html += figureHtml(figures[i], static_cast<int>(i) + 1);
    return html;
}

constexpr std::string_view tableNote = R"(<p class="aside">Votes for the more realistic of two
images; shaded where they differ from an even split. b share: with the 95 % interval of Clopper and
Pearson, which excludes 50 % exactly where p (exact) is below .05. χ²: against an even split, one
degree of freedom. p (exact): two-sided binomial, and the one to trust. p (Holm): the same, corrected
for the number of tests of its claim or, without claims, its hypothesis, so that among them any false
difference has a chance of at most 5 %. g: Cohen's, share − ½. JOD: how far b lies above a in
just-objectionable differences; 1 means that 75 % prefer b. Same, orders balanced: the share as it
would be were b shown first and second equally often, with Newcombe's interval.</p>
)";

// A table under a heading of its own: its entry in the contents.
struct Part {
    std::string anchor, heading, html;
};

std::string resultsHtml(const std::vector<Tally>& tallies, const std::string& label) {
    std::vector<bool> differs;
    for (const auto& verdict : verdictsOf(tallies))
        differs.push_back(verdict && verdict->differs());
    return tableHtml(resultTable(tallies), label, differs);
}

Part claims(const Findings& findings) {
    return {"numbers-claims", "Each claim",
            findings.claims.empty() ? "" : tableHtml(claimTable(findings.claims), "Each claim")};
}

Part conditionsPart(const Findings& findings) {
    return {"numbers-conditions", "Each condition",
            findings.tallies.empty()
                ? ""
                : resultsHtml(findings.tallies, "Each condition") + std::string(tableNote)};
}

Part excluded(const Findings& findings) {
    Part part{"numbers-excluded", "What is excluded, and the results with it", ""};
    if (!findings.exclusions.empty())
        part.html = tableHtml(exclusionTable(findings.exclusions), "What is excluded");
    if (findings.whole && !findings.whole->claims.empty())
        part.html += element("p", "Each claim, if all of this counted:") +
                     tableHtml(claimTable(findings.whole->claims), "Each claim, with all answers");
    if (findings.whole)
        part.html += element("p", "Each condition, if all of this counted:") +
                     resultsHtml(findings.whole->tallies, "Each condition, with all answers");
    return part;
}

Part acrossConditions(const Findings& findings) {
    const std::string heading = "Across conditions and people";
    if (findings.tests.empty())
        return {"numbers-tests", heading, ""};
    return {
        "numbers-tests", heading,
        tableHtml(testTable(findings), heading) +
            "<p class=\"aside\">p (Holm): corrected for the groups of conditions of which the same "
            "is asked; other p are not corrected.</p>\n"};
}

// What to know of each scale stands below them all.
Part scales(const Findings& findings) {
    const std::string heading = "Scales";
    const std::vector<Scaled>& all = findings.scales.all;
    if (all.empty())
        return {"numbers-scales", heading, ""};
    std::string html =
        tableHtml(scaleTable(all), heading) +
        "<p class=\"aside\">A scale begins at its first technique, which therefore has no "
        "interval; p is that of the step to the next higher technique, corrected by Holm for the "
        "steps of its scale. scales.csv has all digits.</p>\n";
    for (const Scaled& one : all) {
        std::string remarks;
        for (const std::string& remark : scaleRemarks(one.result))
            remarks += element("li", remark);
        if (!remarks.empty())
            html += fmt::format("<p class=\"aside\">{} ({}), {}:</p>\n<ul class=\"aside\">\n{}"
                                "</ul>\n",
                                escaped(one.kind->heading), escaped(one.kind->source),
                                escaped(placeOf(one.result.group)), remarks);
    }
    return {"numbers-scales", heading, html};
}

constexpr std::size_t conditionsAcross = 7; // of one table: more do not fit a printed page

std::string statisticText(const CountStatistic& statistic, Votes votes) {
    const std::optional<double> value =
        votes.total() > 0 ? statistic.of(votes) : std::optional<double>();
    if (!value)
        return "–";
    const double size = std::abs(*value);
    return size == 0 || (size >= 1e-3 && size < 1e6) ? readable(*value, 4)
                                                     : fmt::format("{:.3g}", *value);
}

Part everyStatistic(const Findings& findings) {
    std::string html;
    const std::vector<Tally>& tallies = findings.tallies;
    const std::size_t tables = (tallies.size() + conditionsAcross - 1) / conditionsAcross;
    for (std::size_t t = 0; t < tables; ++t) {
        const std::size_t first = t * tallies.size() / tables,
                          end = (t + 1) * tallies.size() / tables;
        Table table{{{"Statistic"}, {"Meaning"}}, {}};
        for (std::size_t i = first; i < end; ++i)
            table.columns.push_back({tallies[i].condition, true});
        for (const CountStatistic& statistic : countStatistics()) {
            auto& row = table.rows.emplace_back(std::vector<std::string>{
                std::string(statistic.id), std::string(statistic.meaning)});
            for (std::size_t i = first; i < end; ++i)
                row.push_back(statisticText(statistic, tallies[i].votes));
        }
        html += tableHtml(table, fmt::format("Every statistic of conditions {} to {}",
                                             tallies[first].condition, tallies[end - 1].condition));
    }
    return {"numbers-statistics", "Every statistic of each condition", html};
}

Part numbersOf(const StudyFigure& figure, std::size_t number) {
    const std::string name = fmt::format("Numbers of figure {}", number);
    return {"numbers-" + figure.drawing.name, fmt::format("{}: {}", name, figure.drawing.title),
            tableHtml(figure.numbers, name)};
}

// Those of `parts` that have something to show.
std::vector<Part> present(std::vector<Part> parts) {
    std::erase_if(parts, [](const Part& part) { return part.html.empty(); });
    return parts;
}

Part deviated(const std::vector<Deviation>& deviations) {
    const std::string heading = "What was declared, and what was done";
    return {"numbers-deviations", heading,
            deviations.empty() ? "" : tableHtml(deviationTable(deviations), heading)};
}

std::vector<Part> tablesOf(const Findings& findings, const std::vector<Deviation>& deviations) {
    return present({claims(findings), deviated(deviations), conditionsPart(findings),
                    excluded(findings), acrossConditions(findings), scales(findings),
                    everyStatistic(findings)});
}

std::string everyNumber(const std::vector<Part>& parts, const std::vector<StudyFigure>& figures) {
    std::vector<Part> all = parts;
    for (std::size_t i = 0; i < figures.size(); ++i)
        all.push_back(numbersOf(figures[i], i + 1));
    std::string html =
        "<h2 id=\"numbers\">Every number</h2>\n<p class=\"aside\">With all digits, and for "
        "programs: votes.csv, tests.csv and results.csv beside this page, which start.R and "
        "start.py load, and results.json. The folder figures has each figure as SVG, PDF and "
        "gnuplot script.</p>\n";
    for (const Part& part : all)
        html +=
            fmt::format("<h3 id=\"{}\">{}</h3>\n{}", part.anchor, escaped(part.heading), part.html);
    return html;
}

std::string methods(const Findings& findings) {
    std::string html = "<h2 id=\"methods\">Methods, ready to paste</h2>\n<div class=\"paste\">\n";
    for (const std::string& paragraph : methodsText(findings))
        html += element("p", paragraph);
    return html + "</div>\n";
}

struct Entry {
    std::string anchor, text;
    std::vector<Entry> below = {};
};

std::string listOf(const std::vector<Entry>& entries) {
    std::string html = "<ul>\n";
    for (const Entry& entry : entries)
        html += fmt::format("<li><a href=\"#{}\">{}</a>{}</li>\n", entry.anchor,
                            escaped(entry.text), entry.below.empty() ? "" : listOf(entry.below));
    return html + "</ul>\n";
}

std::string contents(const Findings& findings, const std::vector<Part>& tables,
                     const std::vector<StudyFigure>& figures) {
    Entry drawn{"figures", "Figures"};
    for (std::size_t i = 0; i < figures.size(); ++i)
        drawn.below.push_back({"figure-" + figures[i].drawing.name,
                               fmt::format("{}. {}", i + 1, figures[i].drawing.title)});
    Entry numbers{"numbers", "Every number"};
    for (const Part& table : tables)
        numbers.below.push_back({table.anchor, table.heading});
    std::vector<Entry> entries = {
        {"answer", "The answer"}, drawn, numbers, {"methods", "Methods, ready to paste"}};
    if (findings.stimuli)
        entries.push_back({"stimuli", "Stimuli"});
    entries.push_back({"conduct", "How the study was run"});
    return "<nav aria-label=\"Contents\">\n" + listOf(entries) + "</nav>\n";
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
        html += fmt::format("<figure class=\"wide\" role=\"region\" tabindex=\"0\" "
                            "aria-label=\"Contact sheet\"><img alt=\"Every pair, its occlusion "
                            "and its difference\" src=\"{}\"/></figure>\n",
                            dataAddress("image/png", bytes));
    }
    return html;
}

Table occlusionTable(const Manifest& stimuli) {
    Table table{
        {{"Condition"}, {"image"}, {"technique"}, {"mean occlusion", true}, {"radius, m", true}},
        {}};
    for (const ConditionRecord& condition : stimuli.conditions)
        for (const ImageRecord& image : condition.images)
            table.rows.push_back({condition.condition, image.role, image.name,
                                  fmt::format("{:.3f}", image.meanOcclusion),
                                  fmt::format("{:g}", condition.radius)});
    return table;
}

std::string stimuliSection(const Manifest& stimuli) {
    return "<h2 id=\"stimuli\">Stimuli</h2>\n" + contactSheets(stimuli) +
           tableHtml(occlusionTable(stimuli), "Stimuli");
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
    std::string html = "<h2 id=\"conduct\">How the study was run</h2>\n";
    if (!findings.conduct)
        html += element("p", "These are published counts: how they were gathered, and whether "
                             "orders were balanced, cannot be told from them.");
    html += "<table class=\"facts\"><tbody>\n";
    for (const Fact& fact : facts)
        html += factRow(fact);
    html += "</tbody></table>\n";
    return html + (findings.conduct ? unreadable(findings.conduct->bad) : "");
}

} // namespace

std::string reportHtml(const Findings& findings, const std::vector<Deviation>& deviations) {
    const std::vector<StudyFigure> figures = figuresOf(findings);
    const std::string stamp = stampOf(findings);
    const std::string mark = stamp.empty() ? "" : fmt::format("[{}] ", sourceOf(findings));
    std::string html = pageHead(mark + findings.title, reportStyle) + "<main>\n";
    html += element("h1", findings.title);
    std::vector<std::string> loud = cautionsOf(findings);
    if (!stamp.empty())
        loud.insert(loud.begin(), stamp);
    for (const std::string& line : loud)
        html += fmt::format("<p class=\"stamp\">{}</p>\n", escaped(line));
    const std::vector<Part> tables = tablesOf(findings, deviations);
    html += answer(findings) + contents(findings, tables, figures) + figureSection(figures) +
            everyNumber(tables, figures) + methods(findings);
    if (findings.stimuli)
        html += stimuliSection(*findings.stimuli);
    return html + howItWasRun(findings) + "</main>\n</body>\n</html>\n";
}

void writeBesideReport(const std::filesystem::path& folder, const std::filesystem::path& votes,
                       const Findings& findings) {
    std::vector<Figure> drawings;
    for (const StudyFigure& figure : figuresOf(findings))
        drawings.push_back(figure.drawing);
    writeFigures(folder / "figures", drawings);
    const std::string path = std::filesystem::proximate(votes, folder).generic_string();
    if (findings.tallies.empty())
        return; // no votes to load
    writeFile(folder / "start.R", startR(path));
    writeFile(folder / "start.py", startPython(path));
}

} // namespace obscura
