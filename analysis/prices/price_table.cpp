#include "analysis/prices/price_table.h"

#include "analysis/prices/price_words.h"
#include "analysis/scales/scale_words.h"
#include "analysis/table.h"
#include "base/csv.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

// What people were shown to see of all that costs more.
std::string dearer(const PricedScale& scale, std::size_t technique) {
    if (technique == scale.reference)
        return "the reference";
    if (scale.enough && technique == scale.enough->technique)
        return fmt::format("better by {} JOD at most", spelt(scale.enough->most, 2));
    if (scale.untold && technique == scale.untold->technique)
        return fmt::format("not told apart, may be better by {} JOD", spelt(scale.untold->most, 2));
    return dash;
}

} // namespace

Table priceTable(const std::vector<const PricedScale*>& scales) {
    Table table{{{"Where"},
                 {"Technique"},
                 {"Milliseconds", true},
                 {"JOD of people", true},
                 {"95 %", true},
                 {"Predicted JOD", true},
                 {"RMSE", true},
                 {"Pareto front"},
                 {"What is dearer"}},
                {}};
    for (const PricedScale* scale : scales)
        for (std::size_t i = 0; i < scale->techniques.size(); ++i) {
            const Priced& one = scale->techniques[i];
            const bool isFront =
                std::find(scale->front.begin(), scale->front.end(), i) != scale->front.end();
            table.rows.push_back(
                {placeOf(scale->group), one.name, priceText(one), spelt(one.people, 2),
                 i == scale->reference ? dash : spelt(one.interval, 2),
                 one.predicted ? spelt(*one.predicted, 2) : dash,
                 one.rmse ? spelt(*one.rmse, 3) : dash, isFront ? "yes" : "no", dearer(*scale, i)});
        }
    return table;
}

std::string ladderCsv(const std::vector<PricedScale>& scales) {
    std::string lines;
    for (const PricedScale& scale : scales) {
        if (scale.group.isPooled() || !scale.isTraced)
            continue;
        for (const Priced& one : scale.techniques)
            lines += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csvCell(scale.group.scene),
                                 csvCell(scale.group.level), csvCell(one.technique),
                                 csvCell(one.name), digits(one.milliseconds), one.people,
                                 digits(one.interval.low), digits(one.interval.high),
                                 one.predicted ? fmt::format("{}", 10 + *one.predicted) : "",
                                 digits(one.rmse));
    }
    return lines.empty() ? lines
                         : "scene,level,technique,name,milliseconds,jod_people,low,high,"
                           "jod_predicted,rmse\n" +
                               lines;
}

} // namespace obscura
