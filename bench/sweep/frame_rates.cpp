#include "bench/sweep/frame_rates.h"

#include "bench/measure/timing.h"
#include "renderer/techniques/technique.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

namespace obscura {

namespace {

using Named = std::map<std::string, std::string>;

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t mostViews = 4; // the thesis has four cameras

std::vector<std::string> firstViews(const std::vector<const SweepRow*>& rows) {
    std::vector<std::string> views;
    for (const SweepRow* row : rows)
        if (views.size() < mostViews &&
            std::find(views.begin(), views.end(), row->view) == views.end())
            views.push_back(row->view);
    return views;
}

std::size_t placeInTable(const std::string& id) {
    const auto table = techniques();
    return static_cast<std::size_t>(
        std::find_if(table.begin(), table.end(), [&](const Technique& t) { return t.id == id; }) -
        table.begin());
}

// Of the view's rows: the pass is the same one in all of them.
double gbufferOf(const std::string& view, const std::vector<const SweepRow*>& rows) {
    std::vector<double> times;
    for (const SweepRow* row : rows)
        if (row->view == view)
            times.push_back(row->gbuffer);
    return summaryOf(std::move(times)).median;
}

void add(const SweepRow& row, double gbuffer, FrameRates& rates) {
    const auto view = std::find(rates.views.begin(), rates.views.end(), row.view);
    if (view == rates.views.end())
        return;
    auto line = std::find_if(rates.lines.begin(), rates.lines.end(),
                             [&](const auto& other) { return other.technique == row.technique; });
    if (line == rates.lines.end()) {
        rates.lines.push_back({row.technique, std::vector(rates.views.size(), unmeasured)});
        line = std::prev(rates.lines.end());
    }
    line->milliseconds[static_cast<std::size_t>(view - rates.views.begin())] =
        gbuffer + row.total.median;
}

} // namespace

std::vector<FrameRates> frameRates(const std::vector<SweepRow>& rows) {
    std::vector<FrameRates> all;
    const std::vector<SweepRow> typical = atTypicalSpeed(rows);
    for (const SweepGroup& group : groupsOf(rows)) {
        std::vector<const SweepRow*> members, defaults;
        for (const SweepRow& row : typical)
            if (row.hasTimes() && row.scene == group.scene && row.width == group.width &&
                row.height == group.height && row.radius == group.radius) {
                members.push_back(&row);
                if (hasDefaultSettings(row))
                    defaults.push_back(&row);
            }
        FrameRates rates{titleOf(group), firstViews(defaults), {}};
        for (const SweepRow* row : defaults)
            add(*row, gbufferOf(row->view, members), rates);
        std::stable_sort(rates.lines.begin(), rates.lines.end(), [](const auto& a, const auto& b) {
            return placeInTable(a.technique) < placeInTable(b.technique);
        });
        if (!rates.lines.empty())
            all.push_back(rates);
    }
    return all;
}

bool hasDefaultSettings(const SweepRow& row) {
    const std::size_t place = placeInTable(row.technique);
    if (place == techniques().size())
        return false;
    const std::span<const Parameter> parameters = techniques()[place].parameters;
    const Named settings = settingsIn(row.settings);
    return std::all_of(parameters.begin(), parameters.end(), [&](const Parameter& parameter) {
        const auto set = settings.find(std::string(parameter.name));
        return parameter.name == "radius" || set == settings.end() ||
               std::strtof(set->second.c_str(), nullptr) == parameter.value;
    });
}

} // namespace obscura
