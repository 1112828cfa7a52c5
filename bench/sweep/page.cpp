#include "bench/sweep/page.h"

#include "base/files.h"
#include "bench/kept_pictures.h"
#include "bench/sweep/files.h"
#include "bench/sweep/page_front_script.h"
#include "bench/sweep/page_introduction.h"
#include "bench/sweep/page_style.h"
#include "bench/sweep/page_tables.h"
#include "renderer/techniques/technique.h"
#include "report/html.h"
#include "report/marks.h"
#include "report/scatter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace obscura {

namespace {

using fmt::format;

// Pages that mail and repositories still take.
constexpr std::size_t thumbnailBytes = 18'000'000;

// Names of errors and references in the order of their buttons; the first are the default.
std::vector<std::string> buttonsOf(std::string ErrorMeasure::*label) {
    std::vector<std::string> names;
    for (const ErrorMeasure& measure : errorMeasures())
        if (std::find(names.begin(), names.end(), measure.*label) == names.end())
            names.push_back(measure.*label);
    return names;
}

std::set<std::size_t> onAnyFront(const SweepGroup& group) {
    std::set<std::size_t> points;
    for (const ErrorMeasure& measure : errorMeasures())
        for (const std::size_t i : paretoFront(paretoPoints(group, measure)))
            points.insert(i);
    return points;
}

// Where a measure is chosen, its chart, and of the table its column and the rows of its front.
std::string styleOf(const std::string& chosen, std::size_t measure) {
    return format("{0} .m{1} {{ display: block; }} {0} .front .c{1} {{ display: table-cell; }} "
                  "{0} .front tr.f{1}, {0} .front tr.n{1} {{ display: table-row; }} "
                  "{0} .front tr.n{1} {{ counter-increment: none; }} "
                  "{0} .front tr.n{1} .rank::before {{ content: '≈'; }}\n",
                  chosen, measure);
}

// Shows what the chosen buttons say; an error that has only one reference, whichever is chosen.
std::string measureStyle() {
    const std::vector<std::string> names = buttonsOf(&ErrorMeasure::name),
                                   references = buttonsOf(&ErrorMeasure::reference);
    std::string style = format("@supports not selector(:has(a)) {{ {} }}\n", styleOf("body", 0));
    for (std::size_t m = 0; m < errorMeasures().size(); ++m) {
        const ErrorMeasure& measure = errorMeasures()[m];
        const auto count =
            std::count_if(errorMeasures().begin(), errorMeasures().end(),
                          [&](const ErrorMeasure& other) { return other.name == measure.name; });
        std::string chosen = format("body:has(#e{}:checked)", indexOf(names, measure.name));
        if (count > 1)
            chosen += format(":has(#r{}:checked)", indexOf(references, measure.reference));
        style += styleOf(chosen, m);
    }
    return style;
}

std::string techniqueStyle(std::size_t count) {
    std::string style;
    for (std::size_t t = 0; t < count; ++t)
        style += format("svg.t{0}, svg .t{0} {{ color: {1}; }} body:has(#t{0}:not(:checked)) "
                        ".chart svg .t{0}, body:has(#t{0}:not(:checked)) .growths .t{0} "
                        "{{ visibility: hidden; }} body:has(#t{0}:not(:checked)) label[for=t{0}] "
                        "{{ opacity: .35; }}\n",
                        t, markOf(t).colour);
    return style;
}

std::string shapes(std::size_t count) {
    std::string svg = "<svg width=\"0\" height=\"0\" style=\"position: absolute\" "
                      "aria-hidden=\"true\"><defs>";
    for (std::size_t t = 0; t < count; ++t)
        svg += format("<path id=\"s{}\" d=\"{}\"/>", t, markOf(t).path);
    return svg + "</defs></svg>\n";
}

std::string radios(const std::string& title, const char* id,
                   const std::vector<std::string>& names) {
    std::string html = format("<b>{}</b>", title);
    for (std::size_t i = 0; i < names.size(); ++i)
        html += format("<label><input type=\"radio\" name=\"{0}\" id=\"{0}{1}\"{2}/>{3}</label>",
                       id, i, i ? "" : " checked=\"checked\"", escaped(names[i]));
    return html;
}

std::string controls(const std::vector<std::string>& techniques) {
    std::string boxes;
    for (std::size_t t = 0; t < techniques.size(); ++t)
        boxes += format("<label><input type=\"checkbox\" id=\"t{}\" checked=\"checked\"/>{} "
                        "{}</label>",
                        t, markHtml(t), escaped(techniques[t]));
    return "<div class=\"tools\"><form class=\"techniques\"><b>Techniques</b>" + boxes +
           "<button type=\"reset\">all</button><button type=\"button\" id=\"none\">none</button>"
           "</form></div>\n<div class=\"tools measures\"><form>" +
           radios("Error", "e", buttonsOf(&ErrorMeasure::name)) + "</form><form>" +
           radios("Reference", "r", buttonsOf(&ErrorMeasure::reference)) + "</form></div>\n";
}

std::string legend(const SweepGroup& group, const std::vector<std::string>& techniques) {
    std::set<std::size_t> present;
    for (const SweepRow& point : group.points)
        present.insert(indexOf(techniques, point.technique));
    std::string html = "<div class=\"legend\">";
    for (const std::size_t t : present)
        html += format("<label for=\"t{}\">{} {}</label>", t, markHtml(t), escaped(techniques[t]));
    return html + "</div>\n";
}

std::string workLegend() {
    std::string html = "<p class=\"aside work\">Time spent: ";
    for (std::size_t i = 0; i < workNames().size(); ++i)
        html += format("<svg class=\"key\" viewBox=\"0 0 10 10\" aria-hidden=\"true\"><rect "
                       "class=\"w{}\" width=\"10\" height=\"10\"/></svg> {} ",
                       i, workNames()[i]);
    return html + "</p>\n";
}

std::string nearSentence(const SweepGroup& group, const std::vector<ParetoPoint>& points) {
    std::vector<std::string> names;
    for (const std::size_t i : nearFront(points, uncertaintyOf(group)))
        names.push_back(points[i].name);
    return format(
        " <span class=\"within\"{}>On the front within the uncertainty of time (±{:.1f} %): "
        "<span class=\"names\">{}</span>.</span>",
        names.empty() ? " hidden=\"hidden\"" : "", 100 * uncertaintyOf(group),
        escaped(fmt::format("{}", fmt::join(names, "; "))));
}

std::string frontSentence(const SweepGroup& group, const ErrorMeasure& measure) {
    const auto points = paretoPoints(group, measure);
    const auto unknown = std::count_if(points.begin(), points.end(), [](const ParetoPoint& point) {
        return std::isnan(point.milliseconds + point.error);
    });
    return format(
        "{}, to the {} reference: <span class=\"count\">{} of {} configurations</span> are "
        "on the front: nothing else <span class=\"among\">measured</span> is as fast and "
        "as close.{}{}",
        measure.name, measure.reference, paretoFront(points).size(), points.size(),
        unknown ? format(" {} without this error are left out.", unknown) : "",
        nearSentence(group, points));
}

// The charts of all measures; style shows the chosen one's.
std::string charts(const SweepGroup& group, const std::vector<std::string>& techniques,
                   std::size_t firstId) {
    std::string html;
    for (std::size_t m = 0; m < errorMeasures().size(); ++m) {
        const ErrorMeasure& measure = errorMeasures()[m];
        html +=
            format("<div class=\"m m{}\"><figure>{}<figcaption>{}</figcaption></figure></div>\n", m,
                   scatterSvg(scatterOf(group, measure, techniques), techniques.size(), firstId),
                   frontSentence(group, measure));
    }
    return html;
}

std::string panel(const SweepGroup& group, const std::vector<std::string>& techniques,
                  std::size_t firstId) {
    std::string html = "<div class=\"panel\" aria-live=\"polite\">";
    for (std::size_t i = 0; i < group.points.size(); ++i) {
        const SweepRow& point = group.points[i];
        html += format("<article id=\"p{0}\"><h3>{1} {2}</h3><div class=\"thumb i{0}\"></div>{3}"
                       "</article>\n",
                       firstId + i, markHtml(indexOf(techniques, point.technique)),
                       escaped(point.configuration), detailsOf(point));
    }
    return html + "</div>\n";
}

std::string warnings(const SweepGroup& group) {
    std::string html;
    if (const std::vector<std::string> names = lackingViews(group); !names.empty())
        html += format("<p class=\"warning\">Not comparable with the others, because measured on "
                       "fewer views: {}.</p>\n",
                       escaped(fmt::format("{}", fmt::join(names, "; "))));
    if (const std::string warning = warningOf(group.straying); !warning.empty())
        html += format("<p class=\"warning\">{}</p>\n", escaped(warning));
    return html;
}

// Where no configuration has a time and an error there is neither a chart nor a front.
std::string groupHtml(const SweepGroup& group, const std::vector<std::string>& techniques,
                      std::size_t firstId) {
    const auto any = [&](bool (SweepRow::*has)() const) {
        return std::any_of(group.points.begin(), group.points.end(),
                           [&](const SweepRow& point) { return (point.*has)(); });
    };
    const bool timed = any(&SweepRow::hasTimes), judged = any(&SweepRow::hasErrors);
    const std::string instead =
        format("<p class=\"warning\">No chart, for no {} was measured on all views yet.</p>\n",
               timed ? "error" : "time");
    const bool drawn = timed && judged;
    return format("<section class=\"points\" id=\"g{}\">\n", firstId) +
           element("h2", titleOf(group)) + warnings(group) + "<div class=\"chart\"><div>" +
           (drawn ? charts(group, techniques, firstId) : instead) + legend(group, techniques) +
           "</div>\n" + panel(group, techniques, firstId) + "</div>\n" +
           (drawn ? frontTable(group, techniques, firstId) + workLegend() : "") +
           format("<details{}><summary>All configurations by {}</summary>",
                  drawn ? "" : " open=\"open\"", judged ? "matched RMSE" : "milliseconds") +
           rankingTable(group, techniques, firstId) + "</details></section>\n";
}

std::string section(const char* id, const char* title, const std::string& text,
                    const std::string& content) {
    return format("<section id=\"{}\">", id) + element("h2", title) + element("p", text) + content +
           "</section>\n";
}

std::string rateSection(const std::vector<SweepRow>& rows) {
    std::string tables;
    for (const FrameRates& rates : frameRates(rows))
        tables += frameRatesHtml(rates);
    if (tables.empty())
        return {};
    tables = "<div class=\"side\">" + tables + "</div>\n";
    return section("rates", "Frame rates at default settings, as matched",
                   "As the thesis from Leeds reports them (there on an RTX 2070 Super at 1080p, on "
                   "average 234 FPS without occlusion, 230 with HBAO, 228 with StarCraft II's, 224 "
                   "with Alchemy), but FPS = 1000 / (G-buffer + technique) in milliseconds: "
                   "lighting, shadows and display are not in it, so these rates are upper bounds. "
                   "The average is that of the milliseconds.",
                   tables);
}

std::string growthSection(const Sweep& sweep) {
    const std::vector<Growth> growth = growthOf(sweep.growth);
    if (growth.empty())
        return {};
    const auto techniqueOf = techniquesByConfiguration(sweep);
    std::string charts = "<div class=\"growths\">";
    for (const std::string& axis : axesOf(growth)) {
        std::vector<GrowthLine> lines;
        for (const Growth& one : growth) {
            if (one.axis != axis)
                continue;
            lines.push_back({one.configuration, techniqueOf.at(one.configuration), {}});
            for (const GrowthRow& row : one.rows)
                lines.back().points.emplace_back(row.value, row.milliseconds);
        }
        charts += "<figure>" + growthSvg(lines, axisTitle(axis)) + "</figure>\n";
    }
    return section("growth", "How cost grows",
                   "One thing is varied at a time; both axes are logarithmic, so a power law is a "
                   "straight line. Slopes are least squares on the logarithms of n values: at 1 "
                   "the time is proportional, at 0 it does not depend.",
                   charts + "</div>\n" + slopesHtml(growth, techniqueOf));
}

// Each thumbnail stands in the page once; "i<id>" shows it as often as wanted. Those of the fronts
// come first, the others while there is room.
struct Thumbnails {
    std::string style;
    std::size_t leftOut = 0;
    bool areAbsent = false; // all of them
};
Thumbnails thumbnailsOf(const std::vector<SweepGroup>& groups,
                        const std::filesystem::path& folder) {
    Thumbnails result;
    std::vector<std::string> names;
    for (const SweepGroup& group : groups)
        for (const SweepRow& point : group.points)
            if (!point.thumbnail.empty())
                names.push_back(point.thumbnail);
    if (!keepsPictures(folder, names))
        return {".thumb { display: none; }\n", 0, !names.empty()};
    std::vector<std::string> fronts, others;
    std::size_t firstId = 0, size = 0;
    for (const SweepGroup& group : groups) {
        const std::set<std::size_t> front = onAnyFront(group);
        for (std::size_t i = 0; i < group.points.size(); ++i)
            if (const std::string& name = group.points[i].thumbnail; !name.empty()) {
                std::string rule = format(".i{} {{ background-image: url({}); }}\n", firstId + i,
                                          dataAddress("image/png", readFile(folder / name)));
                size += rule.size();
                (front.contains(i) ? fronts : others).push_back(std::move(rule));
            }
        firstId += group.points.size();
    }
    while (size > thumbnailBytes && !others.empty()) {
        size -= others.back().size();
        others.pop_back();
        ++result.leftOut;
    }
    result.style = format("{}{}", fmt::join(fronts, ""), fmt::join(others, ""));
    return result;
}

} // namespace

std::string sweepPage(const Sweep& sweep, const std::filesystem::path& folder) {
    const std::vector<SweepGroup> groups = groupsOf(sweep.rows);
    const std::vector<std::string> techniques = techniquesOf(sweep.rows);
    const Thumbnails thumbnails = thumbnailsOf(groups, folder);
    std::string html = pageHead("Speed against accuracy",
                                std::string(sweepPageStyle) + measureStyle() +
                                    techniqueStyle(techniques.size()) + thumbnails.style,
                                true) +
                       shapes(techniques.size()) + sweepIntroduction(sweep);
    if (thumbnails.leftOut > 0)
        html += format("<p class=\"aside\">To keep the page small, the thumbnails of {} "
                       "configurations off every front are only in the sweep's folder.</p>\n",
                       thumbnails.leftOut);
    if (thumbnails.areAbsent)
        html +=
            "<p class=\"aside\">The sweep's folder has no thumbnails, and this page therefore has "
            "none.</p>\n";
    html += controls(techniques);
    std::size_t firstId = 0;
    for (const SweepGroup& group : groups) {
        html += groupHtml(group, techniques, firstId);
        firstId += group.points.size();
    }
    html += rateSection(sweep.rows) + growthSection(sweep);
    return html +
           format("<script>{}{}</script>\n</body>\n</html>\n", sweepPageScript, sweepFrontScript);
}

} // namespace obscura
