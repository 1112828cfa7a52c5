#include "bench/choose/budget.h"

#include "base/arguments.h"
#include "base/error.h"

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace obscura {

namespace {

constexpr Measure all[] = {
    {"rmse", "RMSE", &Budget::rmse, &ViewResult::rmse, 0, false},
    {"flip", "FLIP", &Budget::flip, &ViewResult::flip, 0, false},
    {"litFlip", "FLIP of the lit image", &Budget::litFlip, &ViewResult::litFlip, 0, true},
    {"jod", "predicted JOD", &Budget::jod, &ViewResult::jod, 10, true},
    {"flicker", "flicker", &Budget::flicker, &ViewResult::flicker, 0, false},
};
constexpr int mostViews = 1000; // that anyone would add

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation(std::span<const double> values) {
    const double middle = mean(values);
    double squares = 0;
    for (const double value : values)
        squares += (value - middle) * (value - middle);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

// How far the bound of a mean over n views is from it, in standard deviations of the views.
double reach(int n, double level) {
    return boost::math::quantile(boost::math::students_t_distribution<>(n - 1), level) /
           std::sqrt(static_cast<double>(n));
}

Standing standingOf(const Measure& measure, double limit, std::span<const ViewResult> views) {
    std::vector<double> distances;
    Standing standing{&measure, limit, meanOf(views, measure.value), 0, 0, 0, 0, 0};
    for (const ViewResult& view : views) {
        distances.push_back(measure.distance(view.*measure.value));
        standing.unknown += !std::isfinite(distances.back());
    }
    standing.views = static_cast<int>(views.size());
    standing.scatter = views.size() > 1 ? deviation(distances) : 0;
    const double bound = upperBound(distances);
    standing.bound = measure.moreIsBetter() ? measure.perfect - bound : bound;
    const double allowed = measure.distance(limit);
    standing.ratio = standing.unknown   ? std::numeric_limits<double>::infinity()
                     : bound <= allowed ? std::min(1.0, bound / std::max(allowed, 1e-9))
                                        : std::max(std::nextafter(1.0, 2), bound / allowed);
    return standing;
}

Standing standingOf(double limit, std::span<const ViewResult> views) {
    double dearest = 0;
    for (const ViewResult& view : views)
        dearest = std::max(dearest, view.milliseconds);
    return {nullptr, limit, dearest, dearest, dearest / limit, 0, static_cast<int>(views.size()),
            0};
}

bool fails(const Standing& standing) { return !(standing.ratio <= 1); }

void require(const Measure& measure, double limit, const std::string& text) {
    if (limit < 0 || (measure.moreIsBetter() && limit >= measure.perfect))
        throw Error(
            measure.moreIsBetter()
                ? fmt::format("--limit: expected a number from 0 to less than {:g}, "
                              "which only the truth itself has, found \"{}\"",
                              measure.perfect, text)
                : fmt::format("--limit: expected a number of at least 0, found \"{}\"", text));
}

double positiveMilliseconds(const NamedNumber& given, const char* option) {
    if (!(given.value > 0))
        throw Error(
            fmt::format("{}: expected milliseconds above 0, found {:g}", option, given.value));
    return given.value;
}

} // namespace

std::span<const Measure> measures() { return all; }

const Measure& measureNamed(std::string_view name) {
    return *std::find_if(std::begin(all), std::end(all),
                         [&](const Measure& each) { return each.name == name; });
}

Budget budgetOf(std::span<const std::string> limits, const std::string& within, const Measure* best,
                bool others) {
    Budget budget;
    std::vector<std::string> names;
    for (const Measure& measure : all)
        names.emplace_back(measure.name);
    names.emplace_back("ms");
    for (const std::string& text : limits) {
        const NamedNumber given = parseNamedNumber("--limit", text, names);
        if (given.name == "ms") {
            budget.milliseconds = positiveMilliseconds(given, "--limit");
            continue;
        }
        const Measure& measure = measureNamed(given.name);
        require(measure, given.value, text);
        budget.*measure.limit = given.value;
    }
    if (!within.empty()) {
        if (budget.milliseconds)
            throw Error("expected either --budget ms or --limit ms, found both");
        const std::string onlyName[] = {"ms"};
        budget.milliseconds =
            positiveMilliseconds(parseNamedNumber("--budget", within, onlyName), "--budget");
        budget.best = best;
    } else if (budget.milliseconds && limits.size() == 1 && !others) {
        throw Error(fmt::format("expected a limit on errors beside --limit ms, found none: the "
                                "cheapest within any time is no occlusion at all. For the best "
                                "within it: --budget ms={:g}",
                                *budget.milliseconds));
    }
    return budget;
}

double upperBound(std::span<const double> values, double level) {
    if (values.size() < 2)
        return std::numeric_limits<double>::infinity();
    return mean(values) + reach(static_cast<int>(values.size()), level) * deviation(values);
}

double meanOf(std::span<const ViewResult> views, double ViewResult::*value) {
    std::vector<double> values;
    for (const ViewResult& view : views)
        values.push_back(view.*value);
    return mean(values);
}

std::vector<Standing> standings(const Budget& budget, std::span<const ViewResult> views) {
    std::vector<Standing> found;
    for (const Measure& measure : all)
        if (const std::optional<double> limit = budget.*measure.limit)
            found.push_back(standingOf(measure, *limit, views));
    if (budget.milliseconds)
        found.push_back(standingOf(*budget.milliseconds, views));
    std::stable_sort(found.begin(), found.end(),
                     [](const Standing& a, const Standing& b) { return a.ratio > b.ratio; });
    return found;
}

std::string inWords(const Standing& standing) {
    if (!standing.measure)
        return fmt::format("{:.3g} ms in 95 of 100 frames on the dearest view, limit {:.3g}",
                           standing.mean, standing.limit);
    const Measure& measure = *standing.measure;
    const int digits = measure.moreIsBetter() ? 2 : 3;
    if (standing.unknown)
        return fmt::format("{} unknown on {} of {} views, limit {:.{}f}", measure.spelt,
                           standing.unknown, standing.views, standing.limit, digits);
    return fmt::format("{} {:.{}f} (at {} {:.{}f} with {:.3g} % confidence), limit {:.{}f}",
                       measure.spelt, standing.mean, digits,
                       measure.moreIsBetter() ? "least" : "most", standing.bound, digits,
                       100 * boundLevel, standing.limit, digits);
}

std::string excess(const Budget& budget, std::span<const ViewResult> views) {
    std::string text;
    for (const Standing& standing : standings(budget, views))
        if (fails(standing))
            text += (text.empty() ? "" : "; ") + inWords(standing);
    return text;
}

std::string admitting(const Budget& budget, std::span<const ViewResult> views) {
    std::string text;
    for (const Standing& standing : standings(budget, views)) {
        if (!fails(standing))
            continue;
        if (!std::isfinite(standing.ratio) || standing.bound < 0)
            return "";
        const bool more = standing.measure && standing.measure->moreIsBetter();
        const double step = standing.measure ? (more ? 100 : 1000) : 10;
        const double rounded =
            (more ? std::floor(standing.bound * step) : std::ceil(standing.bound * step)) / step;
        text += fmt::format("{}{}={:g}", text.empty() ? "" : " ",
                            standing.measure ? standing.measure->name : "ms", rounded);
    }
    return text;
}

std::optional<int> viewsNeeded(const Standing& standing) {
    if (!standing.measure || standing.unknown)
        return {};
    const double room =
        standing.measure->distance(standing.limit) - standing.measure->distance(standing.mean);
    for (int n = 2; n <= mostViews && room > 0; ++n)
        if (reach(n, boundLevel) * standing.scatter <= room)
            return n;
    return {};
}

} // namespace obscura
