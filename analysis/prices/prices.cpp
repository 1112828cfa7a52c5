#include "analysis/prices/prices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace obscura {

namespace {

// What the manifest says of a technique, over all of its images.
struct Told {
    std::string technique;
    int timed = 0, judged = 0;
    double logMilliseconds = 0, jod = 0, rmse = 0; // sums
    bool isFree = false;

    std::optional<double> milliseconds() const {
        if (isFree)
            return 0;
        return timed > 0 ? std::optional(std::exp(logMilliseconds / timed)) : std::nullopt;
    }
    std::optional<double> mean(double sum) const {
        return judged > 0 ? std::optional(sum / judged) : std::nullopt;
    }
};

void add(Told& told, const ImageRecord& image) {
    told.technique = image.recipe.technique;
    told.isFree = told.isFree || image.recipe.technique == "none";
    if (image.milliseconds && *image.milliseconds > 0) {
        ++told.timed;
        told.logMilliseconds += std::log(*image.milliseconds);
    }
    if (image.quality) {
        ++told.judged;
        told.jod += image.quality->jod;
        told.rmse += image.quality->rmse;
    }
}

// By name. Each scene and level counts once, whatever number of conditions shows it.
std::map<std::string, Told> toldOf(const Manifest& stimuli, const ScaleGroup& group) {
    std::map<std::string, Told> told;
    std::map<std::string, std::vector<std::string>> counted; // recipes
    for (const ConditionRecord& condition : stimuli.conditions) {
        if (!group.isPooled() && (condition.view != group.scene || condition.level != group.level))
            continue;
        for (const ImageRecord& image : condition.images) {
            auto& recipes = counted[image.name];
            const std::string recipe = image.recipe.sha256();
            if (std::find(recipes.begin(), recipes.end(), recipe) != recipes.end())
                continue;
            recipes.push_back(recipe);
            add(told[image.name], image);
        }
    }
    return told;
}

constexpr double unknown = std::numeric_limits<double>::infinity();

double priceOf(const Priced& priced) { return priced.milliseconds.value_or(unknown); }

// The technique from which differences are taken, among items; the traced one or the dearest.
std::size_t referenceOf(const std::vector<Priced>& techniques) {
    std::size_t dearest = 0;
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        if (techniques[i].technique == "ray_traced")
            return i;
        if (techniques[i].milliseconds &&
            *techniques[i].milliseconds >= techniques[dearest].milliseconds.value_or(-1))
            dearest = i;
    }
    return dearest;
}

std::size_t itemNamed(const ScaleResult& result, const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(result.items.begin(), result.items.end(),
                     [&](const ScaleItem& item) { return item.name == name; }) -
        result.items.begin());
}

// How `technique` compares with all that is dearer; absent where an interval has an open end.
std::optional<Plateau> against(const PricedScale& scale, const ScaleResult& result,
                               std::size_t technique) {
    const std::size_t from = itemNamed(result, scale.techniques[technique].name);
    Plateau plateau{technique, -unknown, {}, {}};
    for (std::size_t i = 0; i < scale.techniques.size(); ++i) {
        const bool isDearer = priceOf(scale.techniques[i]) > priceOf(scale.techniques[technique]);
        if (i == technique || !(isDearer || i == scale.reference))
            continue;
        const auto step = differenceOf(result, from, itemNamed(result, scale.techniques[i].name));
        if (!step || !step->interval.low || !step->interval.high)
            return std::nullopt;
        plateau.most = std::max(plateau.most, *step->interval.high);
        if (*step->interval.low > 0 &&
            (plateau.seen.empty() || *step->interval.low > *plateau.seenBy.low)) {
            plateau.seen = scale.techniques[i].name;
            plateau.seenBy = step->interval;
        }
    }
    return plateau;
}

void judge(PricedScale& scale, const ScaleResult& result) {
    double best = -unknown;
    for (std::size_t i = 0; i < scale.techniques.size(); ++i)
        if (scale.techniques[i].people > best) {
            best = scale.techniques[i].people;
            scale.front.push_back(i);
        }
    for (std::size_t i = 0; i < scale.techniques.size(); ++i) {
        if (i == scale.reference ||
            priceOf(scale.techniques[i]) > priceOf(scale.techniques[scale.reference]))
            continue;
        const auto plateau = against(scale, result, i);
        if (!plateau)
            continue;
        if (!scale.enough && plateau->most < noticeableJod)
            scale.enough = plateau;
        if (!scale.untold && plateau->seen.empty())
            scale.untold = plateau;
    }
}

PricedScale pricedScale(const ScaleKind& kind, const ScaleResult& result, const Manifest& stimuli) {
    PricedScale scale{&kind, result.group, result.intervals, result.notes, {}, 0, {}, {}, {}, {}};
    const std::map<std::string, Told> told = toldOf(stimuli, result.group);
    for (const ScaleItem& item : result.items)
        if (const auto found = told.find(item.name); found != told.end()) {
            const Told& one = found->second;
            scale.techniques.push_back({item.name, one.technique, one.milliseconds(), item.value,
                                        std::nullopt, OpenInterval{}, one.mean(one.jod),
                                        one.mean(one.rmse)});
        }
    if (scale.techniques.empty())
        return scale;
    const Priced reference = scale.techniques[referenceOf(scale.techniques)];
    scale.isTraced = reference.technique == "ray_traced";
    std::stable_sort(scale.techniques.begin(), scale.techniques.end(),
                     [](const Priced& a, const Priced& b) { return priceOf(a) < priceOf(b); });
    if (scale.hasPrices())
        std::erase_if(scale.techniques, [&](const Priced& one) {
            return !one.milliseconds && one.name != reference.name;
        });
    const std::size_t from = itemNamed(result, reference.name);
    for (std::size_t i = 0; i < scale.techniques.size(); ++i) {
        Priced& one = scale.techniques[i];
        if (one.name == reference.name)
            scale.reference = i;
        one.people -= reference.people;
        if (const auto step = differenceOf(result, from, itemNamed(result, one.name))) {
            one.standardError = step->standardError;
            one.interval = step->interval;
        }
        if (one.predicted)
            *one.predicted -= reference.predicted.value_or(10);
    }
    scale.techniques[scale.reference].interval = {0, 0};
    if (scale.hasPrices())
        judge(scale, result);
    return scale;
}

} // namespace

bool PricedScale::seesAll() const {
    return hasPrices() && !enough && !untold &&
           std::all_of(techniques.begin(), techniques.end(),
                       [](const Priced& one) { return one.interval.low.has_value(); });
}

bool PricedScale::hasPrices() const {
    return std::any_of(techniques.begin(), techniques.end(),
                       [](const Priced& one) { return one.milliseconds.value_or(0) > 0; });
}

std::vector<PricedScale> pricedScales(const ScaleFindings& scales, const Manifest& stimuli) {
    std::vector<PricedScale> priced;
    for (const auto& [kind, result] : scales.all)
        if (kind->isLeading && result.unit == "JOD" && !result.pairs.empty())
            if (PricedScale one = pricedScale(*kind, result, stimuli); one.techniques.size() >= 2)
                priced.push_back(std::move(one));
    return priced;
}

} // namespace obscura
