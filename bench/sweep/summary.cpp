#include "bench/sweep/summary.h"

#include "base/percentile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>

namespace obscura {

namespace {

using Rows = std::span<const SweepRow>;
using Of = std::function<double(const SweepRow&)>;

std::vector<double> valuesOf(Rows rows, const Of& of) {
    std::vector<double> values;
    std::transform(rows.begin(), rows.end(), std::back_inserter(values), of);
    return values;
}

double mean(Rows rows, const Of& of) {
    double sum = 0;
    for (const double value : valuesOf(rows, of))
        sum += value;
    return sum / static_cast<double>(rows.size());
}

double median(Rows rows, const Of& of) { return percentile(valuesOf(rows, of), 0.5); }

PictureError errorOf(Rows rows, PictureError SweepRow::*error) {
    const auto squared = [&](const SweepRow& row) { return std::pow((row.*error).rmse, 2); };
    return {
        std::sqrt(mean(rows, squared)),
        std::copysign(mean(rows, [&](const SweepRow& row) { return std::abs((row.*error).bias); }),
                      mean(rows, [&](const SweepRow& row) { return (row.*error).bias; })),
        mean(rows, [&](const SweepRow& row) { return (row.*error).ssim; }),
        mean(rows, [&](const SweepRow& row) { return (row.*error).flip; }),
        mean(rows, [&](const SweepRow& row) { return (row.*error).jod; })};
}

std::set<std::string> viewsOf(Rows rows) {
    std::set<std::string> views;
    for (const SweepRow& row : rows)
        views.insert(row.view);
    return views;
}

std::string joined(const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

// Rows of one configuration made neighbours.
void addPoints(std::vector<SweepRow> rows, SweepGroup& group) {
    std::stable_sort(rows.begin(), rows.end(), [](const SweepRow& a, const SweepRow& b) {
        return a.configuration < b.configuration;
    });
    for (auto begin = rows.begin(); begin != rows.end();) {
        const auto end = std::find_if(begin, rows.end(), [&](const SweepRow& row) {
            return row.configuration != begin->configuration;
        });
        group.points.push_back(overViews({begin, end}));
        begin = end;
    }
    std::stable_sort(group.points.begin(), group.points.end(),
                     [](const SweepRow& a, const SweepRow& b) {
                         return std::isnan(b.total.median) ? !std::isnan(a.total.median)
                                                           : a.total.median < b.total.median;
                     });
}

constexpr const char* full = "full";
constexpr const char* depth = "depth buffer";

} // namespace

SweepRow overViews(Rows rows) {
    const auto medianOf = [&](double SweepRow::*field) {
        return median(rows, [&](const SweepRow& row) { return row.*field; });
    };
    SweepRow point = rows.front();
    point.view = joined(viewsOf(rows));
    point.frames = 0;
    for (const SweepRow& row : rows)
        point.frames += row.frames;
    for (double Milliseconds::*part :
         {&Milliseconds::median, &Milliseconds::low, &Milliseconds::high})
        point.total.*part = median(rows, [&](const SweepRow& row) { return row.total.*part; });
    for (std::size_t i = 0; i < point.work.size(); ++i)
        point.work[i] = median(rows, [&](const SweepRow& row) { return row.work[i]; });
    for (double SweepRow::*field : std::initializer_list<double SweepRow::*>{
             &SweepRow::gbuffer, &SweepRow::toGbuffer, &SweepRow::toStarcraft,
             &SweepRow::starcraftRepeat, &SweepRow::bytes, &SweepRow::fetches})
        point.*field = medianOf(field);
    for (PictureError SweepRow::*error :
         {&SweepRow::raw, &SweepRow::matched, &SweepRow::depthRaw, &SweepRow::depthMatched,
          &SweepRow::litRaw, &SweepRow::litMatched})
        point.*error = errorOf(rows, error);
    return point;
}

std::string titleOf(const SweepGroup& group) {
    return fmt::format("{}, {}×{}, R {:g} m", group.scene, group.width, group.height, group.radius);
}

std::vector<SweepGroup> groupsOf(const std::vector<SweepRow>& rows) {
    struct Members {
        std::vector<SweepRow> typical, measured;
    };
    std::vector<std::string> scenes;
    std::map<std::tuple<std::string, int, int, double>, Members> byGroup;
    const std::vector<SweepRow> typical = atTypicalSpeed(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const SweepRow& row = rows[i];
        if (std::find(scenes.begin(), scenes.end(), row.scene) == scenes.end())
            scenes.push_back(row.scene);
        Members& members = byGroup[{row.scene, row.width, row.height, row.radius}];
        members.typical.push_back(typical[i]);
        members.measured.push_back(row);
    }
    std::vector<SweepGroup> groups;
    for (const std::string& scene : scenes)
        for (const auto& [key, members] : byGroup)
            if (const auto& [of, width, height, radius] = key; of == scene) {
                groups.push_back({scene, width, height, radius, {}, strayingOf(members.measured)});
                addPoints(members.typical, groups.back());
            }
    return groups;
}

std::vector<std::string> lackingViews(const SweepGroup& group) {
    const auto most = std::max_element(
        group.points.begin(), group.points.end(),
        [](const SweepRow& a, const SweepRow& b) { return a.view.size() < b.view.size(); });
    std::vector<std::string> names;
    for (const SweepRow& point : group.points)
        if (point.view != most->view)
            names.push_back(point.configuration);
    return names;
}

std::span<const ErrorMeasure> errorMeasures() {
    using R = SweepRow;
    static const ErrorMeasure measures[] = {
        {"RMSE, matched", full, [](const R& row) { return row.matched.rmse; }, true, "scatter"},
        {"RMSE, raw", full, [](const R& row) { return row.raw.rmse; }},
        {"bias, raw", full, [](const R& row) { return std::abs(row.raw.bias); }},
        {"1 − SSIM, matched", full, [](const R& row) { return 1 - row.matched.ssim; }},
        {"FLIP, matched", full, [](const R& row) { return row.matched.flip; }, true},
        {"FLIP of the lit image, matched", full, [](const R& row) { return row.litMatched.flip; }},
        {"10 − predicted JOD of the lit image, matched", full,
         [](const R& row) { return 10 - row.litMatched.jod; }, false, "predicted-jod"},
        {"RMSE, matched", depth, [](const R& row) { return row.depthMatched.rmse; }},
        {"RMSE, raw", depth, [](const R& row) { return row.depthRaw.rmse; }},
        {"bias, raw", depth, [](const R& row) { return std::abs(row.depthRaw.bias); }},
        {"1 − SSIM, matched", depth, [](const R& row) { return 1 - row.depthMatched.ssim; }},
        {"FLIP, matched", depth, [](const R& row) { return row.depthMatched.flip; }},
    };
    return measures;
}

std::vector<ParetoPoint> paretoPoints(const SweepGroup& group, const ErrorMeasure& measure) {
    std::vector<ParetoPoint> points;
    for (const SweepRow& row : group.points)
        points.push_back({row.total.median, measure.of(row), row.configuration});
    return points;
}

double uncertaintyOf(const SweepGroup& group) {
    return group.straying.isTooMuch() ? group.straying.mean : 0;
}

Scatter scatterOf(const SweepGroup& group, const ErrorMeasure& measure,
                  const std::vector<std::string>& techniques) {
    const auto points = paretoPoints(group, measure);
    const double uncertainty = uncertaintyOf(group);
    Scatter scatter{{},           paretoFront(points), nearFront(points, uncertainty),
                    measure.name, measure.reference,   uncertainty};
    for (const SweepRow& row : group.points)
        scatter.points.push_back({row.configuration, indexOf(techniques, row.technique),
                                  row.total.median, row.total.low, row.total.high,
                                  measure.of(row)});
    return scatter;
}

std::vector<std::string> techniquesOf(const std::vector<SweepRow>& rows) {
    std::set<std::string> names;
    for (const SweepRow& row : rows)
        names.insert(row.technique);
    return {names.begin(), names.end()};
}

std::size_t indexOf(const std::vector<std::string>& techniques, const std::string& technique) {
    return static_cast<std::size_t>(std::find(techniques.begin(), techniques.end(), technique) -
                                    techniques.begin());
}

std::map<std::string, std::size_t> techniquesByConfiguration(const Sweep& sweep) {
    const std::vector<std::string> techniques = techniquesOf(sweep.rows);
    std::map<std::string, std::size_t> places;
    for (const SweepRow& row : sweep.rows)
        places[row.configuration] = places[row.name] = places[row.technique] =
            indexOf(techniques, row.technique);
    for (const GrowthRow& row : sweep.growth) { // begins with such a name
        const auto known = places.find(row.configuration.substr(0, row.configuration.find(' ')));
        places.emplace(row.configuration,
                       known == places.end() ? techniques.size() : known->second);
    }
    return places;
}

std::map<std::string, std::string> settingsIn(const std::string& settings) {
    std::map<std::string, std::string> values;
    std::istringstream words(settings);
    for (std::string word; words >> word;)
        if (const std::size_t at = word.find('='); at != word.npos)
            values[word.substr(0, at)] = word.substr(at + 1);
    return values;
}

} // namespace obscura
