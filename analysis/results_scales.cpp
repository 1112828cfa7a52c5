#include "analysis/results_scales.h"

#include "analysis/prices/prices.h"
#include "analysis/scales/scale_words.h"

#include <fmt/format.h>

namespace obscura {

namespace {

// The same scale with prices; null where it has none.
const PricedScale* pricesOf(const std::vector<PricedScale>& priced, const Scaled& scale) {
    for (const PricedScale& one : priced)
        if (one.kind == scale.kind && placeOf(one.group) == placeOf(scale.result.group) &&
            one.group.items == scale.result.group.items)
            return &one;
    return nullptr;
}

void addPrices(const PricedScale& scale, const std::string& name, Numbers& numbers) {
    for (std::size_t i = 0; i < scale.techniques.size(); ++i) {
        const Priced& one = scale.techniques[i];
        if (one.name != name)
            continue;
        numbers.emplace_back("jod_people", one.people);
        if (i != scale.reference) {
            numbers.emplace_back("jod_people_standard_error", one.standardError);
            numbers.emplace_back("jod_people_low", one.interval.low);
            numbers.emplace_back("jod_people_high", one.interval.high);
        }
        numbers.emplace_back("jod_predicted", one.predicted);
        numbers.emplace_back("rmse", one.rmse);
        numbers.emplace_back("milliseconds", one.milliseconds);
    }
}

} // namespace

std::vector<ScaleNumbers> scaleNumbers(const Findings& findings) {
    const std::vector<PricedScale> priced = findings.stimuli
                                                ? pricedScales(findings.scales, *findings.stimuli)
                                                : std::vector<PricedScale>();
    std::vector<ScaleNumbers> all;
    for (const Scaled& scale : findings.scales.all) {
        const ScaleResult& result = scale.result;
        const PricedScale* prices = pricesOf(priced, scale);
        ScaleNumbers one{fmt::format("{}: {}{}", scale.kind->id, placeOf(result.group),
                                     result.curve ? ", " + result.unit : ""),
                         std::string(scale.kind->id),
                         result.group.question,
                         result.group.scene,
                         result.group.level,
                         result.unit,
                         result.intervals,
                         prices ? prices->techniques[prices->reference].name : "",
                         result.notes,
                         {}};
        for (const ScaleItem& item : result.items) {
            Numbers numbers = {{"value", item.value},
                               {"standard_error", item.standardError},
                               {"low", item.interval.low},
                               {"high", item.interval.high}};
            if (prices)
                addPrices(*prices, item.name, numbers);
            one.items.emplace_back(item.name, std::move(numbers));
        }
        all.push_back(std::move(one));
    }
    return all;
}

} // namespace obscura
