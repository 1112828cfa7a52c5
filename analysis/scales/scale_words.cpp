#include "analysis/scales/scale_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

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
        return "–";
    return fmt::format("{} to {}", bounds.low ? spelt(*bounds.low, decimals) : "−∞",
                       bounds.high ? spelt(*bounds.high, decimals) : "∞");
}

const ScaleStep* stepFrom(const ScaleResult& result, std::size_t item) {
    for (const ScaleStep& step : result.steps)
        if (step.from == item)
            return &step;
    return nullptr;
}

std::string placeOf(const ScaleGroup& group) {
    const std::string place = group.isPooled() ? "all scenes and levels"
                                               : fmt::format("{}, {}", group.scene, group.level);
    return group.question.empty() ? place : fmt::format("{}: {}", group.question, place);
}

std::vector<std::string> scaleRemarks(const ScaleResult& result) {
    std::vector<std::string> remarks = result.notes;
    if (!result.intervals.empty())
        remarks.push_back("intervals: " + result.intervals);
    for (const ScaleDiagnostic& diagnostic : result.diagnostics)
        remarks.push_back(described(diagnostic));
    return remarks;
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

} // namespace obscura
