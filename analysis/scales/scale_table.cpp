#include "analysis/scales/scale_table.h"

#include "base/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace obscura {

namespace {

constexpr const char* dash = "–";

// With a real minus sign; more decimals for what is small.
std::string spelt(double value, int decimals) {
    const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
    const bool isZero = digits.find_first_not_of("0.") == digits.npos;
    return (value < 0 && !isZero ? "−" : "") + digits;
}

int decimalsOf(const ScaleResult& result) {
    double largest = 0;
    for (const ScaleItem& item : result.items)
        if (item.name != "lapse" && item.name != "slope")
            largest = std::max(largest, std::abs(item.value));
    return largest > 0 && largest < 0.5 ? 3 : 2;
}

std::string spelt(const Bounds& bounds, int decimals) {
    if (!bounds.low && !bounds.high)
        return dash;
    return fmt::format("{} to {}", bounds.low ? spelt(*bounds.low, decimals) : "−∞",
                       bounds.high ? spelt(*bounds.high, decimals) : "∞");
}

std::string pText(double p) { return p < 0.001 ? "<0.001" : fmt::format("{:.3f}", p); }

const ScaleStep* stepFrom(const ScaleResult& result, std::size_t item) {
    for (const ScaleStep& step : result.steps)
        if (step.from == item)
            return &step;
    return nullptr;
}

std::string digits(std::optional<double> value) { return value ? fmt::format("{}", *value) : ""; }

std::string described(const ScaleDiagnostic& one) {
    std::string text = one.name;
    if (one.value)
        text += fmt::format(": {:.4g}", *one.value);
    if (!one.test)
        return text;
    text += one.value ? "," : ":";
    if (one.test->statistic)
        text += fmt::format(" {:.3f}{},", *one.test->statistic,
                            one.test->df ? fmt::format(" at {:g} df", *one.test->df) : "");
    return text + (one.test->p < 0.001 ? " p < 0.001" : fmt::format(" p = {:.3f}", one.test->p));
}

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

// The items of a scale with the steps that differ.
std::string orderText(const ScaleResult& result) {
    std::string order;
    for (const std::size_t i : orderOf(result)) {
        const ScaleStep* step = stepFrom(result, i);
        order += result.items[i].name;
        if (step)
            order += !step->holm || *step->holm >= 0.05 ? ", "
                     : step->difference > 0             ? " < "
                                                        : " > ";
    }
    return order;
}

// Whether the excluded answers would make a difference that somebody would report.
std::string changesOf(const ScaleFindings& scales) {
    std::string changed;
    for (const Scaled& with : scales.whole)
        for (const Scaled& without : scales.all)
            if (with.kind == without.kind && with.kind->isLeading &&
                placeOf(with.result.group) == placeOf(without.result.group) &&
                with.result.unit == without.result.unit && !with.result.curve &&
                orderText(with.result) != orderText(without.result))
                changed += fmt::format("{}{} would be {}", changed.empty() ? "with them " : "; ",
                                       placeOf(with.result.group), orderText(with.result));
    return changed.empty()
               ? "with them no scale would have another order or other steps that differ."
               : changed + ".";
}

} // namespace

std::string placeOf(const ScaleGroup& group) {
    const std::string place = group.isPooled() ? "all scenes and levels"
                                               : fmt::format("{}, {}", group.scene, group.level);
    return group.question.empty() ? place : fmt::format("{}: {}", group.question, place);
}

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
                                  result.unit, step && step->holm ? pText(*step->holm) : dash});
        }
        if (result.curve)
            for (const ScaleItem& item : result.items)
                table.rows.push_back({std::string(kind->heading), placeOf(result.group), item.name,
                                      spelt(item.value, decimals), spelt(item.interval, decimals),
                                      item.name == "threshold" ? result.unit : "", dash});
    }
    return table;
}

std::vector<std::string> scaleRemarks(const ScaleResult& result) {
    std::vector<std::string> remarks = result.notes;
    if (!result.intervals.empty())
        remarks.push_back("intervals: " + result.intervals);
    for (const ScaleDiagnostic& diagnostic : result.diagnostics)
        remarks.push_back(described(diagnostic));
    return remarks;
}

std::string scalesText(const std::vector<Scaled>& scales) {
    std::string text;
    for (const Scaled& one : scales) {
        text += fmt::format("{} ({}), {}; {} answers of {} people\n", one.kind->heading,
                            one.kind->source, placeOf(one.result.group), one.result.group.answers,
                            one.result.group.people);
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

std::vector<std::string> scaleSentences(const ScaleFindings& scales) {
    std::vector<std::string> sentences;
    for (const auto& [kind, result] : scales.all) {
        if (!kind->isLeading)
            continue;
        if (result.items.empty()) {
            sentences.push_back(fmt::format("{}, {}: no scale, for {}.", kind->heading,
                                            placeOf(result.group), fmt::join(result.notes, "; ")));
            continue;
        }
        if (result.curve) {
            sentences.push_back(fmt::format("{}: {} (threshold {}, 95 % interval {}).",
                                            placeOf(result.group), result.notes.front(),
                                            spelt(result.items[0].value, decimalsOf(result)),
                                            spelt(result.items[0].interval, decimalsOf(result))));
            continue;
        }
        sentences.push_back(fmt::format("{}, by {}{}: {} (\"<\" where neighbours differ at "
                                        ".05, corrected by Holm).",
                                        placeOf(result.group),
                                        result.isOrdered ? "level, in " : "rising ", result.unit,
                                        orderText(result)));
    }
    sentences.insert(sentences.end(), scales.notes.begin(), scales.notes.end());
    if (!scales.whole.empty())
        sentences.push_back(fmt::format("Some answers do not count, for reasons named below; {}",
                                        changesOf(scales)));
    return sentences;
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
