#include "bench/sweep/ablation.h"

#include "base/csv.h"
#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>

namespace obscura {

namespace {

using fmt::format;
using Named = std::map<std::string, std::string>;

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();

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
    std::string culling; // "" where it is off, which goes with every kind
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

struct VariantStyle {
    int point;
    const char* colour;
};
constexpr std::array<VariantStyle, 4> variantStyles = {
    {{7, "#000000"}, {9, "#0072B2"}, {5, "#E69F00"}, {13, "#D55E00"}}};

// Samples, then for each variant milliseconds and per cent of plain.
std::string ablationLines(const AblationTable::Column& column) {
    std::string lines;
    for (std::size_t s = 0; s < ablationSamples.size(); ++s) {
        lines += format("{}", ablationSamples[s]);
        for (const double milliseconds : column.milliseconds[s])
            lines += format(" {} {}", milliseconds, 100 * milliseconds / column.milliseconds[s][0]);
        lines += "\n";
    }
    return lines;
}

// The variants' lines of one panel: milliseconds, or per cent of plain.
std::string variants(const std::string& block, bool percent, bool published) {
    std::vector<std::string> elements;
    for (std::size_t v = percent ? 1 : 0; v < ablationVariants.size(); ++v)
        elements.push_back(format(
            "${} using 1:{} with linespoints pointtype {} pointsize 0.7 {}linecolor rgb '{}' "
            "title '{}'",
            block, 2 + 2 * v + (percent ? 1 : 0), variantStyles[v].point,
            published ? "dashtype 2 " : "", published ? "#999999" : variantStyles[v].colour,
            percent && !published ? "" : ablationVariants[v]));
    return plot::list(elements);
}

AblationTable withoutErrors(AblationTable table) {
    for (AblationTable::Column& column : table.columns) {
        for (auto& line : column.rmse)
            line.fill(unmeasured);
        column.vao.fill(unmeasured);
    }
    return table;
}

bool isUntimed(const AblationTable::Column& column) {
    return std::all_of(
        column.milliseconds.begin(), column.milliseconds.end(), [](const auto& line) {
            return std::all_of(line.begin(), line.end(), [](double ms) { return std::isnan(ms); });
        });
}

// Nothing where nothing was measured.
std::string spelt(double value) { return std::isnan(value) ? "" : format("{:.6g}", value); }

void addLines(const AblationTable& table, const std::string& scene, std::string& csv) {
    for (const AblationTable::Column& column : table.columns)
        for (std::size_t s = 0; s < ablationSamples.size(); ++s) {
            const auto& times = column.milliseconds[s];
            for (std::size_t v = 0; v < times.size(); ++v)
                csv +=
                    format("{},{},{},{},{},{},{},{}\n", csvCell(scene), csvCell(table.settings),
                           column.title, ablationSamples[s], ablationVariants[v], spelt(times[v]),
                           spelt(100 * times[v] / times[0]), spelt(column.rmse[s][v]));
            if (!std::isnan(column.vao[s]))
                csv += format("{},{},{},{},vao,{},{},\n", csvCell(scene), csvCell(table.settings),
                              column.title, ablationSamples[s], spelt(column.vao[s]),
                              spelt(100 * column.vao[s] / times[0]));
        }
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
    static const AblationTable table = withoutErrors({"",
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
                                                        {}}}});
    return table;
}

std::string ablationCsv(const std::vector<AblationTable>& tables) {
    std::string csv = "scene,settings,resolution,samples,variant,ms,percent_of_plain,rmse\n";
    for (const AblationTable& table : tables)
        addLines(table, table.scene, csv);
    addLines(publishedAblation(), "GTX 970 (paper)", csv);
    return csv;
}

std::string ablationText(const AblationTable& table) {
    std::string text;
    for (const AblationTable::Column& column : table.columns) {
        text += format("{}, {}: milliseconds (per cent of plain)\n{:>8}", table.scene, column.title,
                       "samples");
        for (const char* variant : ablationVariants)
            text += format("  {:>16}", variant);
        text += "\n";
        for (std::size_t s = 0; s < ablationSamples.size(); ++s) {
            text += format("{:>8}", ablationSamples[s]);
            for (const double time : column.milliseconds[s])
                text += std::isnan(time) ? format("  {:>16}", "-")
                                         : format("  {:>9.3g} ({:3.0f} %)", time,
                                                  100 * time / column.milliseconds[s][0]);
            text += "\n";
        }
    }
    return text + format("Equal in every cell: {}.\n", table.settings);
}

Figure ablationFigure(const AblationTable& all, std::size_t number) {
    AblationTable table = all;
    std::erase_if(table.columns, isUntimed);
    const std::size_t columns = table.columns.size();
    if (columns == 0)
        return {};
    std::string data = plot::block("paper", ablationLines(publishedAblation().columns.front())),
                above, below;
    for (std::size_t c = 0; c < columns; ++c) {
        const std::string name = format("c{}", c);
        data += plot::block(name, ablationLines(table.columns[c]));
        above += format("set title '{}'\nplot {}\n", table.columns[c].title,
                        variants(name, false, false)) +
                 "unset key\nunset ylabel\n";
        below += format("plot {}, \\\n  {}\n", variants(name, true, false),
                        variants("paper", true, true)) +
                 "unset key\nunset ylabel\n";
    }
    return {format("ablation-{}-{}", number, plainName(table.scene)),
            format("What the extensions of VAO++ save, {}", table.scene),
            plot::style + data +
                format("set logscale x\nset xrange [1.8:36]\nset xtics (2, 4, 8, 16, 32) nomirror "
                       "out\nset ytics nomirror out\nset yrange [0:*]\n"
                       "set ylabel 'milliseconds' offset 1\n"
                       "set key at screen 0.79, screen 0.95 left top\n"
                       "set multiplot layout 2,{} margins 0.09,0.77,0.1,0.94 spacing 0.06,0.1\n",
                       columns) +
                above +
                "unset title\nset xlabel 'samples'\nset ylabel 'per cent of plain' offset 1\n"
                "set key at screen 0.79, screen 0.48 left top title 'on a GTX 970, 1080p' left\n" +
                below + "unset multiplot\n",
            7.2, 4.4};
}

} // namespace obscura
