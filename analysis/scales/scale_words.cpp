#include "analysis/scales/scale_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

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

// Whether the threshold lies beyond the steps that people saw.
bool isOutside(const ScaleResult& result) {
    const Ladder& ladder = result.curve->ladder;
    const double level = result.curve->parameters.threshold;
    return level < ladder.data.level.minCoeff() || level > ladder.data.level.maxCoeff();
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

std::string spelt(const OpenInterval& bounds, int decimals) {
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

namespace {

// Scales of one unit make one sentence, however many scenes and levels they are of.
void addOrders(const ScaleFindings& scales, std::vector<std::string>& sentences) {
    std::vector<std::string> beginnings;
    std::map<std::string, std::string> orders; // by beginning
    for (const auto& [kind, result] : scales.all) {
        if (!kind->isLeading || result.curve || result.items.empty())
            continue;
        std::string beginning =
            fmt::format("By {}{} (\"<\" where neighbours differ at .05, corrected by Holm)",
                        result.isOrdered ? "level, in " : "rising ", result.unit);
        std::string& order = orders[beginning];
        if (order.empty())
            beginnings.push_back(std::move(beginning));
        order += fmt::format("{}{}: {}", order.empty() ? "" : "; ", placeOf(result.group),
                             orderText(result));
    }
    for (const std::string& beginning : beginnings)
        sentences.push_back(fmt::format("{} — {}.", beginning, orders[beginning]));
}

void addThresholds(const ScaleFindings& scales, std::vector<std::string>& sentences) {
    int curves = 0, without = 0;
    for (const auto& [kind, result] : scales.all) {
        if (!kind->isLeading || !result.curve || result.items.empty())
            continue;
        ++curves;
        if (isOutside(result)) {
            ++without;
            continue;
        }
        sentences.push_back(fmt::format("{}: {} ({}threshold {}, 95 % interval {}).",
                                        placeOf(result.group), result.notes.front(),
                                        result.curve->ladder.isOrder ? "" : result.unit + ": ",
                                        spelt(result.items[0].value, decimalsOf(result)),
                                        spelt(result.items[0].interval, decimalsOf(result))));
    }
    if (without > 0)
        sentences.push_back(fmt::format("{} of {} psychometric functions have no threshold within "
                                        "the steps that were shown.",
                                        without, curves));
}

} // namespace

std::vector<std::string> scaleSentences(const ScaleFindings& scales) {
    std::vector<std::string> sentences;
    addOrders(scales, sentences);
    addThresholds(scales, sentences);
    for (const auto& [kind, result] : scales.all)
        if (kind->isLeading && result.items.empty())
            sentences.push_back(fmt::format("{}, {}: no scale, for {}.", kind->heading,
                                            placeOf(result.group), fmt::join(result.notes, "; ")));
    sentences.insert(sentences.end(), scales.notes.begin(), scales.notes.end());
    if (!scales.whole.empty())
        sentences.push_back(fmt::format("Some answers do not count, for reasons named below; {}",
                                        changesOf(scales)));
    return sentences;
}

} // namespace obscura
