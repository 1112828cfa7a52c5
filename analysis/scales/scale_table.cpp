#include "analysis/scales/scale_table.h"

#include "analysis/scales/scale_words.h"
#include "analysis/table.h"
#include "base/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace obscura {

namespace {

// One line of scales.csv.
struct Line {
    std::string what, name, other;
    std::optional<double> value, standardError, low, high, statistic, df, p, holm;
    std::string note;
};

std::vector<Line> linesOf(const ScaleResult& result) {
    std::vector<Line> lines;
    for (const ScaleItem& item : result.items) {
        lines.push_back({"item",
                         item.name,
                         {},
                         item.value,
                         item.standardError,
                         item.interval.low,
                         item.interval.high,
                         {},
                         {},
                         {},
                         {},
                         result.intervals});
        for (const auto& [value, count] : item.counts)
            lines.push_back({"count",
                             item.name,
                             fmt::format("{}", value),
                             static_cast<double>(count),
                             {},
                             {},
                             {},
                             {},
                             {},
                             {},
                             {},
                             {}});
    }
    for (const ScaleStep& step : result.steps)
        lines.push_back({"step",
                         result.items[step.to].name,
                         result.items[step.from].name,
                         step.difference,
                         step.standardError,
                         step.interval.low,
                         step.interval.high,
                         {},
                         {},
                         step.p,
                         step.holm,
                         {}});
    if (result.curve)
        for (Eigen::Index i = 0; i < result.curve->ladder.data.level.size(); ++i)
            lines.push_back(
                {"level",
                 result.curve->ladder.labels[static_cast<std::size_t>(i)],
                 digits(result.curve->ladder.data.level(i)),
                 result.curve->ladder.data.successes(i) / result.curve->ladder.data.trials(i),
                 {},
                 {},
                 {},
                 result.curve->ladder.data.trials(i),
                 {},
                 {},
                 {},
                 {}});
    for (const ScaleDiagnostic& one : result.diagnostics) {
        const Test test = one.test.value_or(Test());
        lines.push_back({"diagnostic",
                         one.name,
                         {},
                         one.value,
                         {},
                         {},
                         {},
                         test.statistic,
                         test.df,
                         one.test ? std::optional(test.p) : std::nullopt,
                         {},
                         {}});
    }
    for (const std::string& note : result.notes)
        lines.push_back({"note", {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, note});
    return lines;
}

} // namespace

Table scaleTable(const std::vector<Scaled>& scales) {
    Table table{{{"Scale"},
                 {"Where"},
                 {"Of"},
                 {"Value", true},
                 {"95 %", true}, //
                 {"Unit"},
                 {"p to next (Holm)", true}},
                {}};
    for (const auto& [kind, result] : scales) {
        const int decimals = decimalsOf(result);
        for (const std::size_t i : result.curve ? std::vector<std::size_t>{} : orderOf(result)) {
            const ScaleItem& item = result.items[i];
            const ScaleStep* step = stepFrom(result, i);
            table.rows.push_back({std::string(kind->heading), placeOf(result.group), item.name,
                                  spelt(item.value, decimals), spelt(item.interval, decimals),
                                  result.unit, step && step->holm ? pCell(*step->holm) : dash});
        }
        if (result.curve)
            for (const ScaleItem& item : result.items)
                table.rows.push_back({std::string(kind->heading), placeOf(result.group), item.name,
                                      spelt(item.value, decimals), spelt(item.interval, decimals),
                                      item.name == "threshold" ? result.unit : "", dash});
    }
    return table;
}

std::string scalesText(const std::vector<Scaled>& scales) {
    std::string text;
    for (const Scaled& one : scales) {
        const int people = one.result.group.people; // 0 where they are not told apart
        text += fmt::format("{} ({}), {}; {} answers{}\n", one.kind->heading, one.kind->source,
                            placeOf(one.result.group), one.result.group.answers,
                            people > 0 ? fmt::format(" of {} people", people) : "");
        Table table = scaleTable({one});
        for (auto& row : table.rows) // the heading says these
            row.erase(row.begin(), row.begin() + 2);
        table.columns.erase(table.columns.begin(), table.columns.begin() + 2);
        if (!table.rows.empty())
            text += alignedText(table);
        for (const std::string& remark : scaleRemarks(one.result))
            text += fmt::format("  {}\n", remark);
        text += "\n";
    }
    return text;
}

std::string scalesCsv(const ScaleFindings& scales, const std::string& source) {
    std::string csv = "source,excluded_answers,scale,question,scene,level,what,name,other,value,"
                      "standard_error,low,high,unit,statistic,df,p,p_holm,answers,people,note,"
                      "method\n";
    for (const auto& [excluded, list] :
         {std::pair("left out", &scales.all), std::pair("included", &scales.whole)})
        for (const auto& [kind, result] : *list)
            for (const Line& line : linesOf(result))
                csv += fmt::format(
                    "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                    csvCell(source), scales.whole.empty() ? "none" : excluded, kind->id,
                    csvCell(result.group.question), csvCell(result.group.scene),
                    csvCell(result.group.level), line.what, csvCell(line.name), csvCell(line.other),
                    digits(line.value), digits(line.standardError), digits(line.low),
                    digits(line.high), csvCell(result.unit), digits(line.statistic),
                    digits(line.df), digits(line.p), digits(line.holm), result.group.answers,
                    result.group.people, csvCell(line.note), csvCell(kind->source));
    return csv;
}

} // namespace obscura
