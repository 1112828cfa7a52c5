#include "bench/sweep/page_tables.h"

#include "renderer/techniques/technique.h"
#include "report/html.h"
#include "report/number.h"
#include "report/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using fmt::format;

std::string header(const std::string& title) {
    return format("<th scope=\"col\">{}</th>", escaped(title));
}
std::string numberHeader(const std::string& title) {
    return format("<th scope=\"col\" class=\"number\">{}</th>", escaped(title));
}
std::string number(double value, int digits = 3) {
    return format("<td class=\"number\">{}</td>", readable(value, digits));
}
std::string number(const std::string& text) { return format("<td class=\"number\">{}</td>", text); }

std::string link(const SweepRow& point, std::size_t technique, std::size_t id) {
    return format("<th scope=\"row\">{} <a href=\"#p{}\">{}</a></th>", markHtml(technique), id,
                  escaped(point.configuration));
}

std::string interval(const Milliseconds& total) {
    if (std::isnan(total.median))
        return readable(total.median);
    return format("{}<br/><small>{}–{}</small>", readable(total.median), readable(total.low),
                  readable(total.high));
}

std::string workBar(const SweepRow& point) {
    double sum = 0;
    std::string words;
    std::vector<double> shares;
    for (std::size_t i = 0; i < point.work.size(); ++i) {
        const double share = point.work[i] / point.total.median;
        sum += share;
        shares.push_back(share);
        words += format("{}{} {} ms", i ? ", " : "", workNames()[i], readable(point.work[i]));
    }
    if (!(point.total.median > 0) || std::isnan(sum))
        return {};
    for (double& share : shares) // medians of parts may add up to a little more than their sum's
        share /= std::max(sum, 1.0);
    return barSvg(shares, words);
}

std::string costs(const SweepRow& point) {
    return number(interval(point.total)) + number(point.toGbuffer) + number(point.toStarcraft) +
           number(point.fetches) + number(point.bytes);
}

std::string costHeaders() {
    return numberHeader("ms (5th–95th percentile)") + numberHeader("× G-buffer") +
           numberHeader("× starcraft 16") + numberHeader("fetches a pixel") +
           numberHeader("bytes a pixel");
}

std::string wide(const std::string& head, const std::string& body, const std::string& kind = "") {
    return format("<div class=\"wide\"><table class=\"{}\">\n<thead>{}</thead>\n<tbody>{}</tbody>"
                  "</table></div>\n",
                  kind, head, body);
}

std::string errorLine(const std::string& name, const PictureError& error) {
    return format("<tr><th scope=\"row\">{}</th>", name) + number(error.rmse) + number(error.bias) +
           number(error.ssim, 4) + number(error.flip) + number(error.jod) + "</tr>";
}

std::string timesOf(const SweepRow& point) {
    if (!point.hasTimes())
        return "<p>Not timed.</p>\n";
    std::string work;
    for (std::size_t i = 0; i < point.work.size(); ++i)
        work += format("{}{} {}", i ? ", " : "", workNames()[i], readable(point.work[i]));
    return format("<p><b>{} ms</b> in {} frames (5th to 95th percentile {} to {}; {}). {} × the "
                  "G-buffer's {} ms, {} × starcraft with 16 samples.</p>\n{}",
                  readable(point.total.median), point.frames, readable(point.total.low),
                  readable(point.total.high), work, readable(point.toGbuffer),
                  readable(point.gbuffer), readable(point.toStarcraft), workBar(point));
}

std::string errorsOf(const SweepRow& point) {
    if (!point.hasErrors())
        return "<p>Without errors.</p>\n";
    return wide("<tr>" + header("error to") + numberHeader("RMSE") + numberHeader("bias") +
                    numberHeader("SSIM") + numberHeader("FLIP") + numberHeader("predicted JOD") +
                    "</tr>",
                errorLine("full, raw", point.raw) + errorLine("full, matched", point.matched) +
                    errorLine("depth buffer, raw", point.depthRaw) +
                    errorLine("depth buffer, matched", point.depthMatched) +
                    errorLine("lit image, raw", point.litRaw) +
                    errorLine("lit image, matched", point.litMatched));
}

// Of each point: "f3" where it is on the front of the measure 3, "n3" where it is near.
std::vector<std::string> frontClasses(const SweepGroup& group) {
    std::vector<std::string> classes(group.points.size());
    for (std::size_t m = 0; m < errorMeasures().size(); ++m) {
        const auto points = paretoPoints(group, errorMeasures()[m]);
        for (const std::size_t i : paretoFront(points))
            classes[i] += format(" f{}", m);
        for (const std::size_t i : nearFront(points, uncertaintyOf(group)))
            classes[i] += format(" n{}", m);
    }
    return classes;
}

} // namespace

std::string markHtml(std::size_t technique) {
    return format("<svg class=\"key t{0}\" viewBox=\"-7 -7 14 14\" aria-hidden=\"true\">"
                  "<use href=\"#s{0}\"/></svg>",
                  technique);
}

std::string frontTable(const SweepGroup& group, const std::vector<std::string>& techniques,
                       std::size_t firstId) {
    const auto measures = errorMeasures();
    const auto cellClass = [&](std::size_t m) {
        return measures[m].always ? std::string("number") : format("number c c{}", m);
    };
    std::string head = "<tr>" + numberHeader("") + header("On the front") + costHeaders() +
                       header("time spent"),
                body;
    for (std::size_t m = 0; m < measures.size(); ++m)
        head += format("<th scope=\"col\" class=\"{}\">{}, {}</th>", cellClass(m), measures[m].name,
                       measures[m].reference);
    const std::vector<std::string> places = frontClasses(group);
    for (std::size_t i = 0; i < group.points.size(); ++i) {
        const SweepRow& point = group.points[i];
        body += format("<tr class=\"{}\"><td class=\"number rank\"></td>", places[i]) +
                link(point, indexOf(techniques, point.technique), firstId + i) + costs(point) +
                format("<td>{}</td>", workBar(point));
        for (std::size_t m = 0; m < measures.size(); ++m)
            body +=
                format("<td class=\"{}\">{}</td>", cellClass(m), readable(measures[m].of(point)));
        body += format("<td><div class=\"thumb i{}\"></div></td></tr>\n", firstId + i);
    }
    return wide(head + header("visibility and its error") + "</tr>", body, "front");
}

std::string rankingTable(const SweepGroup& group, const std::vector<std::string>& techniques,
                         std::size_t firstId) {
    const std::vector<ParetoPoint> points = paretoPoints(group, errorMeasures().front());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        order.push_back(i);
    const auto error = [&](std::size_t i) {
        return std::isnan(points[i].error) ? HUGE_VAL : points[i].error;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return error(a) < error(b); });
    std::string body;
    int rank = 0;
    for (const std::size_t i : order) {
        const SweepRow& point = group.points[i];
        const auto better = dominatedBy(points, i);
        body += "<tr>" + number(format("{}", ++rank)) +
                link(point, indexOf(techniques, point.technique), firstId + i) +
                number(points[i].error) + number(point.raw.rmse) + number(point.raw.bias) +
                number(point.matched.ssim, 4) + number(point.matched.flip) +
                number(point.litMatched.flip) + number(point.litMatched.jod) +
                number(point.depthMatched.rmse) + costs(point) +
                format("<td>{}</td></tr>\n",
                       better ? escaped(points[*better].name)
                              : (std::isnan(points[i].error) ? "–" : "on the front"));
    }
    return wide(
        "<tr>" + numberHeader("rank") + header("Configuration") + numberHeader("RMSE, matched") +
            numberHeader("RMSE, raw") + numberHeader("bias, raw") + numberHeader("SSIM, matched") +
            numberHeader("FLIP, matched") + numberHeader("FLIP of lit, matched") +
            numberHeader("predicted JOD of lit, matched") + numberHeader("RMSE to depth, matched") +
            costHeaders() + header("better and no slower") + "</tr>",
        body, "ranking");
}

std::string detailsOf(const SweepRow& point) {
    return timesOf(point) + errorsOf(point) +
           format("<p class=\"aside\">{}: {}. Matched, and so timed, with {}. {} fetches and {} "
                  "bytes a pixel. Views: {}; radius {} m.</p>",
                  escaped(point.technique), escaped(point.settings),
                  point.fitted.empty() ? "the same" : escaped(point.fitted),
                  readable(point.fetches), readable(point.bytes), escaped(point.view),
                  readable(point.radius));
}

std::string frameRatesHtml(const FrameRates& rates) {
    std::string head = "<tr>" + header("technique"), body;
    for (const std::string& view : rates.views)
        head += numberHeader(view + ", FPS");
    head += numberHeader("average");
    for (const FrameRates::Line& line : rates.lines) {
        double sum = 0;
        body += format("<tr><th scope=\"row\">{}</th>", escaped(line.technique));
        const auto cell = [](double milliseconds) {
            return number(format("{} <small>{} ms</small>", readable(1000 / milliseconds),
                                 readable(milliseconds)));
        };
        for (const double milliseconds : line.milliseconds) {
            sum += milliseconds;
            body += cell(milliseconds);
        }
        body += cell(sum / static_cast<double>(line.milliseconds.size())) + "</tr>\n";
    }
    return "<div>" + element("h3", rates.title) + wide(head + "</tr>", body) + "</div>\n";
}

std::string slopesHtml(const std::vector<Growth>& growth,
                       const std::map<std::string, std::size_t>& techniqueOf) {
    const std::vector<std::string> axes = axesOf(growth);
    std::vector<std::string> configurations;
    for (const Growth& one : growth)
        if (std::find(configurations.begin(), configurations.end(), one.configuration) ==
            configurations.end())
            configurations.push_back(one.configuration);
    std::string head = "<tr>" + header("slope"), body;
    for (const std::string& axis : axes)
        head += numberHeader(axisTitle(axis));
    for (const std::string& configuration : configurations) {
        body += format("<tr><th scope=\"row\">{} {}</th>", markHtml(techniqueOf.at(configuration)),
                       escaped(configuration));
        for (const std::string& axis : axes) {
            const auto at = std::find_if(growth.begin(), growth.end(), [&](const Growth& one) {
                return one.axis == axis && one.configuration == configuration;
            });
            body += number(at == growth.end()
                               ? "–"
                               : format("{} <small>n {}, R² {}</small>", readable(at->slope, 2),
                                        at->rows.size(), readable(at->r2, 3)));
        }
        body += "</tr>\n";
    }
    return wide(head + "</tr>", body);
}

} // namespace obscura
