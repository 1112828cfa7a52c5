#include "bench/sweep_tables.h"

#include "bench/timing.h"
#include "renderer/technique.h"

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

std::string taken(Named& settings, const std::string& name) {
    const auto node = settings.extract(name);
    return node.empty() ? "" : node.mapped();
}

std::string spelt(const Named& settings) {
    std::string text;
    for (const auto& [name, value] : settings)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
    return text;
}

// One measured cell, and what it must share with others to stand in one table.
struct Cell {
    std::string settings;
    std::string culling; // "" where it is off, so that it fits to every kind
    std::size_t samples = 0, variant = 0;
    double milliseconds = 0, rmse = 0;
};

bool fits(const Cell& cell, const std::string& settings, const std::string& culling) {
    return cell.settings == settings && (cell.culling.empty() || cell.culling == culling);
}

// Where the count stands among ablationSamples; their number when it does not.
std::size_t placeOfSamples(const std::string& count) {
    return static_cast<std::size_t>(
        std::find(ablationSamples.begin(), ablationSamples.end(), std::atoi(count.c_str())) -
        ablationSamples.begin());
}

std::vector<Cell> cellsOf(const SweepGroup& group) {
    std::vector<Cell> cells;
    for (const SweepRow& row : group.points) {
        if (row.technique != "vao_plus_plus")
            continue;
        Named settings = settingsIn(row.settings);
        const std::size_t samples = placeOfSamples(taken(settings, "samples"));
        const bool adaptive = taken(settings, "adaptive") == "1";
        std::string culling = taken(settings, "culling");
        if (culling == "0")
            culling.clear();
        if (samples < ablationSamples.size())
            cells.push_back({spelt(settings), culling, samples,
                             (adaptive ? 1u : 0u) + (culling.empty() ? 0u : 2u), row.total.median,
                             row.matched.rmse});
    }
    return cells;
}

AblationTable::Column emptyColumn(const SweepGroup& group) {
    AblationTable::Column column;
    column.title = fmt::format("{}×{}", group.width, group.height);
    for (auto* values : {&column.milliseconds, &column.rmse})
        for (auto& line : *values)
            line.fill(unmeasured);
    column.vao.fill(unmeasured);
    return column;
}

// What both have is the same.
bool agree(const Named& one, const Named& other) {
    return std::all_of(one.begin(), one.end(), [&](const auto& setting) {
        const auto at = other.find(setting.first);
        return at == other.end() || at->second == setting.second;
    });
}

// The tables that a scene's cells call for: their settings and kinds of culling, where they hold
// more than one variant. Adaptive alone is a table only where nothing was culled.
std::set<std::pair<std::string, std::string>> tablesIn(const std::vector<Cell>& cells) {
    std::set<std::pair<std::string, std::string>> tables;
    for (const Cell& cell : cells)
        tables.emplace(cell.settings, cell.culling);
    for (const Cell& cell : cells)
        if (!cell.culling.empty())
            tables.erase({cell.settings, ""});
    std::erase_if(tables, [&](const auto& table) {
        std::set<std::size_t> variants;
        for (const Cell& cell : cells)
            if (fits(cell, table.first, table.second))
                variants.insert(cell.variant);
        return variants.size() < 2;
    });
    return tables;
}

void fill(AblationTable& table, const std::string& settings, const std::string& culling,
          const SweepGroup& group) {
    AblationTable::Column column = emptyColumn(group);
    for (const Cell& cell : cellsOf(group))
        if (fits(cell, settings, culling)) {
            column.milliseconds[cell.samples][cell.variant] = cell.milliseconds;
            column.rmse[cell.samples][cell.variant] = cell.rmse;
        }
    for (const SweepRow& row : group.points)
        if (row.technique == "vao") {
            Named own = settingsIn(row.settings);
            const std::size_t samples = placeOfSamples(taken(own, "samples"));
            if (samples < column.vao.size() && agree(own, settingsIn(settings)))
                column.vao[samples] = row.total.median;
        }
    table.columns.push_back(column);
}

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

std::vector<AblationTable> ablationTables(const std::vector<SweepGroup>& groups) {
    std::map<std::string, std::vector<Cell>> cells;
    std::vector<std::string> scenes;
    for (const SweepGroup& group : groups) {
        if (!cells.contains(group.scene))
            scenes.push_back(group.scene);
        for (const Cell& cell : cellsOf(group))
            cells[group.scene].push_back(cell);
    }
    std::vector<AblationTable> tables;
    for (const std::string& scene : scenes)
        for (const auto& [settings, culling] : tablesIn(cells[scene])) {
            tables.push_back({scene, settings, {}});
            if (!culling.empty())
                tables.back().settings += "; culling=" + culling + " where it is on";
            for (const SweepGroup& group : groups)
                if (group.scene == scene)
                    fill(tables.back(), settings, culling, group);
        }
    return tables;
}

const AblationTable& publishedAblation() {
    static const AblationTable table{"",
                                     "",
                                     {{"1920×1080",
                                       {{{0.65, 0.75, 0.88, 0.93},
                                         {0.93, 0.92, 1.04, 1.02},
                                         {1.53, 1.27, 1.37, 1.2},
                                         {2.67, 1.88, 2.04, 1.59},
                                         {5.04, 3.09, 3.38, 2.33}}},
                                       {}},
                                      {"3840×2160",
                                       {{{2.75, 3.14, 3.65, 3.88},
                                         {4.08, 3.91, 4.31, 4.26},
                                         {6.87, 5.53, 5.77, 4.97},
                                         {12.74, 8.24, 8.67, 6.59},
                                         {23.71, 13.76, 14.47, 9.77}}},
                                       {}}}};
    return table;
}

std::vector<FrameRates> frameRates(const std::vector<SweepRow>& rows) {
    std::vector<FrameRates> all;
    const std::vector<SweepRow> typical = atTypicalSpeed(rows);
    for (const SweepGroup& group : groupsOf(rows)) {
        std::vector<const SweepRow*> members, defaults;
        for (const SweepRow& row : typical)
            if (row.scene == group.scene && row.width == group.width &&
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
