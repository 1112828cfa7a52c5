#include "analysis/prices/price_words.h"

#include "analysis/scales/scale_words.h"
#include "report/number.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

using fmt::format;

std::string priceText(const Priced& priced) {
    if (!priced.milliseconds)
        return "not timed";
    return *priced.milliseconds == 0 ? "free" : readable(*priced.milliseconds, 2) + " ms";
}

namespace {

std::string named(const PricedScale& scale, std::size_t technique) {
    const Priced& one = scale.techniques[technique];
    return format("{} ({})", one.name, priceText(one));
}

std::string jod(double value) { return spelt(value, 2) + " JOD"; }

std::string atMost(double most) {
    return most > 0 ? format("at most {} better", jod(most)) : "not better at all";
}

std::string enough(const PricedScale& scale) {
    const Plateau& place = *scale.enough;
    if (!place.seen.empty())
        return format("beyond {} more milliseconds bought less than {:g} JOD: {} was seen to be "
                      "better by {} JOD",
                      named(scale, place.technique), noticeableJod, place.seen,
                      spelt(place.seenBy, 2));
    return format(
        "beyond {} more milliseconds bought nothing that people saw: what is dearer is {} "
        "(95 %)",
        named(scale, place.technique), atMost(place.most));
}

// The dearest technique below the reference, which still falls short.
std::string nothing(const PricedScale& scale) {
    std::size_t last = scale.techniques.size();
    for (std::size_t i = 0; i < scale.techniques.size(); ++i)
        if (i != scale.reference && (scale.isTraced || i < scale.reference))
            last = i;
    if (last == scale.techniques.size() || !scale.seesAll())
        return "without intervals nobody can say from where on milliseconds bought nothing";
    const Priced& one = scale.techniques[last];
    return format("people saw what the dearest milliseconds bought: each cheaper technique falls "
                  "short of a dearer one, {} of {} by {} JOD ({} to {})",
                  named(scale, last), scale.techniques[scale.reference].name, spelt(-one.people, 2),
                  spelt(-*one.interval.high, 2), spelt(-*one.interval.low, 2));
}

} // namespace

std::string plateauSentence(const PricedScale& scale) {
    std::string text = placeOf(scale.group) + ": ";
    if (scale.enough) {
        text += enough(scale);
        if (scale.untold && scale.untold->technique < scale.enough->technique)
            text += format("; {} is not told apart from what is dearer either, but could be worse "
                           "by {}",
                           named(scale, scale.untold->technique), jod(scale.untold->most));
    } else if (scale.untold) {
        text += format("beyond {} nobody was shown to see more milliseconds, which is not to say "
                       "that nobody does: something dearer may be better by {} (95 %)",
                       named(scale, scale.untold->technique), jod(scale.untold->most));
    } else {
        text += nothing(scale);
    }
    return text + ".";
}

std::string predictionSentence(const Prediction& prediction) {
    if (!prediction.line || !prediction.ranks)
        return {};
    const auto interval = [](const Correlation& one) {
        return one.interval ? format(" ({} to {})", spelt(one.interval->low, 2),
                                     spelt(one.interval->high, 2))
                            : std::string();
    };
    return format("Predicted differences from the reference and those of people correlate by {}{}, "
                  "their ranks by {}{}: {} techniques in {} scenes and levels, taken for "
                  "independent. On rendering artefacts the best such metrics reach about {:g} "
                  "(CGVQM, arXiv 2506.11546).",
                  spelt(prediction.line->value, 2), interval(*prediction.line),
                  spelt(prediction.ranks->value, 2), interval(*prediction.ranks),
                  prediction.points.size(), prediction.places, bestCorrelation);
}

std::vector<std::string> priceSentences(const std::vector<PricedScale>& scales) {
    std::vector<std::string> sentences;
    for (const bool pooled : {true, false})
        for (const PricedScale& scale : scales)
            if (scale.hasPrices() && scale.group.isPooled() == pooled)
                sentences.push_back(plateauSentence(scale));
    if (sentences.empty() && !scales.empty())
        sentences.push_back(
            "No chart of milliseconds and JOD: the stimuli's manifest has no times, "
            "for it was written before they were measured; run obscura-stimuli "
            "again.");
    if (const std::string text = predictionSentence(predictionOf(scales)); !text.empty())
        sentences.push_back(text);
    return sentences;
}

} // namespace obscura
