#include "report/scatter.h"

#include "report/html.h"
#include "report/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using fmt::format;

// The picture and the plot within it, in the SVG's units; a browser scales the whole.
struct Frame {
    int width, height, left, right, top, bottom;
    Axis across, up;

    double x(double value) const { return left + across.at(value) * (right - left); }
    double y(double value) const { return bottom - up.at(value) * (bottom - top); }
};

// Labels begin `room` to the right of the left edge.
std::string ticks(const Frame& frame, double room) {
    std::string svg = "<g class=\"axis\">";
    for (const Tick& tick : frame.across.ticks) {
        const double x = frame.x(tick.value);
        svg += format("<path class=\"{}\" d=\"M{:.1f} {}V{}\"/>", tick.label.empty() ? "minor" : "",
                      x, frame.top, frame.bottom);
        if (!tick.label.empty() && x >= frame.left + room)
            svg += format("<text x=\"{:.1f}\" y=\"{}\" class=\"x\">{}</text>", x, frame.bottom + 18,
                          tick.label);
    }
    for (const Tick& tick : frame.up.ticks) {
        const double y = frame.y(tick.value);
        svg += format("<path class=\"{}\" d=\"M{} {:.1f}H{}\"/>", tick.label.empty() ? "minor" : "",
                      frame.left, y, frame.right);
        if (!tick.label.empty())
            svg += format("<text x=\"{}\" y=\"{:.1f}\" class=\"y\">{}</text>", frame.left - 6,
                          y + 4, tick.label);
    }
    return svg + "</g>";
}

// What took no time has no logarithm.
std::string timeTicks(const Frame& frame, const std::vector<ScatterPoint>& points) {
    const bool any = std::any_of(points.begin(), points.end(),
                                 [](const ScatterPoint& point) { return point.milliseconds <= 0; });
    return any ? ticks(frame, 14) + format("<text x=\"{}\" y=\"{}\" class=\"x\">0</text>",
                                           frame.left, frame.bottom + 18)
               : ticks(frame, 0);
}

std::string titles(const Frame& frame, const std::string& across, const std::string& up) {
    return format("<text class=\"x\" x=\"{}\" y=\"{}\">{}</text>"
                  "<text class=\"x up\" transform=\"translate(14,{}) rotate(-90)\">{}</text>",
                  (frame.left + frame.right) / 2, frame.height - 6, escaped(across),
                  (frame.top + frame.bottom) / 2, escaped(up));
}

std::string opening(const Frame& frame, const std::string& description,
                    const std::string& data = "") {
    return format("<svg viewBox=\"0 0 {} {}\" role=\"group\" aria-label=\"{}\"{}>", frame.width,
                  frame.height, escaped(description), data);
}

double factorOf(const Scatter& chart) { return std::pow(1 + chart.uncertainty, 2); }

std::string dataOf(const Scatter& chart, const Frame& frame) {
    return format(" data-left=\"{}\" data-right=\"{}\" data-top=\"{}\" data-bottom=\"{}\" "
                  "data-factor=\"{}\" data-shift=\"{}\"",
                  frame.left, frame.right, frame.top, frame.bottom, factorOf(chart),
                  frame.x(frame.across.low * factorOf(chart)) - frame.left);
}

bool isDrawn(const ScatterPoint& point) {
    return !std::isnan(point.milliseconds) && !std::isnan(point.error);
}

// From above the front's first point to the right border, each point moved right by the factor.
std::string edge(const Scatter& chart, const Frame& frame, double factor) {
    const auto x = [&](std::size_t i) {
        return std::min(frame.x(factor * chart.points[i].milliseconds), 1.0 * frame.right);
    };
    std::string path = format("M{:.1f} {}", x(chart.front[0]), frame.top);
    for (const std::size_t i : chart.front)
        path += format("H{:.1f}V{:.1f}", x(i), frame.y(chart.points[i].error));
    return path + format("H{}", frame.right);
}

// What the front leaves dominated, what of it within the uncertainty of time, and its edge.
std::string staircase(const Scatter& chart, const Frame& frame) {
    if (chart.front.empty())
        return {};
    const std::string path = edge(chart, frame, 1);
    return format("<path class=\"unsure\" d=\"{0}V{2}z\"/><path class=\"dominated\" "
                  "d=\"{1}V{2}z\"/><path class=\"front\" d=\"{0}\"/>",
                  path, edge(chart, frame, factorOf(chart)), frame.top);
}

// The points of each series in order of cost.
std::string threads(const Scatter& chart, const Frame& frame, std::size_t seriesCount) {
    std::string svg = "<g class=\"threads\">";
    for (std::size_t t = 0; t < seriesCount; ++t) {
        std::string path;
        for (const ScatterPoint& point : chart.points)
            if (point.series == t && isDrawn(point))
                path += format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L",
                               frame.x(point.milliseconds), frame.y(point.error));
        if (path.find('L') != path.npos)
            svg += format("<path class=\"t{}\" d=\"{}\"/>", t, path);
    }
    return svg + "</g>";
}

// From the 5th to the 95th percentile.
std::string bars(const Scatter& chart, const Frame& frame) {
    std::string svg = "<g class=\"bars\">";
    for (const ScatterPoint& point : chart.points)
        if (isDrawn(point) && !std::isnan(point.low + point.high))
            svg += format("<path class=\"t{}\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", point.series,
                          frame.x(point.low), frame.y(point.error), frame.x(point.high));
    return svg + "</g>";
}

std::string marks(const Scatter& chart, const Frame& frame, std::size_t firstId) {
    std::string svg;
    for (std::size_t i = 0; i < chart.points.size(); ++i) {
        const ScatterPoint& point = chart.points[i];
        if (!isDrawn(point))
            continue;
        const auto isIn = [&](const std::vector<std::size_t>& some) {
            return std::find(some.begin(), some.end(), i) != some.end();
        };
        svg += format("<a class=\"mark t{0}{1}\" href=\"#p{2}\" transform=\"translate({3:.1f},"
                      "{4:.1f})\" data-ms=\"{9}\" data-error=\"{10}\" aria-label=\"{5}: {6} ms, "
                      "{7} {8}\"><use href=\"#s{0}\"/></a>",
                      point.series,
                      isIn(chart.front)  ? " best"
                      : isIn(chart.near) ? " near"
                                         : "",
                      firstId + i, frame.x(point.milliseconds), frame.y(point.error),
                      escaped(point.name), readable(point.milliseconds), escaped(chart.error),
                      readable(point.error), point.milliseconds, point.error);
    }
    return svg;
}

std::string numbers(const Scatter& chart, const Frame& frame) {
    // As far as a picture has them, so that a script that reads it finds the same places.
    const auto rounded = [](double place) { return std::round(10 * place) / 10; };
    std::vector<Spot> spots;
    for (const std::size_t i : chart.front)
        spots.push_back({rounded(frame.x(chart.points[i].milliseconds)),
                         rounded(frame.y(chart.points[i].error))});
    const auto places = numberPlaces(spots, frame.left, frame.bottom);
    std::string svg = "<g class=\"numbers\">";
    for (std::size_t k = 0; k < spots.size(); ++k) {
        if (!places[k])
            continue;
        const std::size_t t = chart.points[chart.front[k]].series;
        if (places[k]->far)
            svg += format("<path class=\"t{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>", t, spots[k].x,
                          spots[k].y, places[k]->x + 3, places[k]->y - 10);
        svg += format("<text class=\"t{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", t, places[k]->x,
                      places[k]->y, k + 1);
    }
    return svg + "</g>";
}

} // namespace

std::vector<std::optional<NumberPlace>> numberPlaces(const std::vector<Spot>& spots, double left,
                                                     double bottom) {
    std::vector<std::optional<NumberPlace>> places;
    const auto isFree = [&](double x, double y) {
        return y < bottom - 2 && std::none_of(places.begin(), places.end(), [&](const auto& other) {
                   return other && std::abs(x - other->x) < 17 && std::abs(y - other->y) < 13;
               });
    };
    for (const Spot& spot : spots) {
        std::optional<NumberPlace> place;
        for (int away = 0; away < 6 && !place; ++away)
            if (const Spot at{std::max(spot.x - 9 - 6 * away, left + 9), spot.y + 15 + 10 * away};
                isFree(at.x, at.y))
                place = {at.x, at.y, away > 0};
        places.push_back(place);
    }
    return places;
}

std::string scatterSvg(const Scatter& chart, std::size_t seriesCount, std::size_t firstId) {
    std::vector<double> milliseconds, errors;
    for (const ScatterPoint& point : chart.points) {
        milliseconds.insert(milliseconds.end(), {point.low, point.milliseconds, point.high});
        errors.push_back(point.error);
    }
    const Frame frame{
        760, 470, 62, 748, 10, 418, logarithmicAxis(milliseconds), linearAxis(errors)};
    return opening(frame, "Milliseconds against " + chart.error, dataOf(chart, frame)) +
           staircase(chart, frame) + timeTicks(frame, chart.points) +
           titles(frame, "milliseconds, median of frames (logarithmic)",
                  format("{}, {} reference", chart.error, chart.reference)) +
           threads(chart, frame, seriesCount) + bars(chart, frame) + numbers(chart, frame) +
           marks(chart, frame, firstId) + "<text class=\"name\"></text></svg>";
}

std::string growthSvg(const std::vector<GrowthLine>& lines, const std::string& axisTitle) {
    std::vector<double> values, milliseconds;
    for (const GrowthLine& line : lines)
        for (const auto& [value, time] : line.points) {
            values.push_back(value);
            milliseconds.push_back(time);
        }
    const Frame frame{340, 320, 52, 334, 8, 272, valueAxis(values), logarithmicAxis(milliseconds)};
    std::string svg = opening(frame, "Milliseconds against " + axisTitle) + ticks(frame, 0) +
                      titles(frame, axisTitle, "milliseconds");
    for (const GrowthLine& line : lines) {
        std::string path, shapes;
        for (const auto& [value, time] : line.points) {
            path +=
                format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", frame.x(value), frame.y(time));
            shapes += format("<use href=\"#s{}\" transform=\"translate({:.1f},{:.1f}) "
                             "scale(0.7)\"/>",
                             line.series, frame.x(value), frame.y(time));
        }
        svg += format("<g class=\"growth t{}\"><title>{}</title><path d=\"{}\"/>{}</g>",
                      line.series, escaped(line.title), path, shapes);
    }
    return svg + "</svg>";
}

std::string barSvg(const std::vector<double>& shares, const std::string& description) {
    std::string svg = format("<svg class=\"bar\" viewBox=\"0 0 100 10\" "
                             "preserveAspectRatio=\"none\" role=\"img\" aria-label=\"{0}\">"
                             "<title>{0}</title>",
                             escaped(description));
    double x = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        svg += format("<rect class=\"w{}\" x=\"{:.2f}\" width=\"{:.2f}\" height=\"10\"/>", i, x,
                      100 * shares[i]);
        x += 100 * shares[i];
    }
    return svg + "</svg>";
}

} // namespace obscura
