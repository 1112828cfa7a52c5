#include "bench/choose/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using fmt::format;

// What a choice is by: limited measures, and the one that is to be best; RMSE where there is none.
std::vector<const Measure*> measuresOf(const Budget& budget) {
    std::vector<const Measure*> found;
    for (const Measure& measure : measures())
        if (budget.*measure.limit || budget.best == &measure)
            found.push_back(&measure);
    return found.empty() ? std::vector{&measureNamed("rmse")} : found;
}

std::string boundInWords(const Measure& measure, const Candidate& candidate) {
    std::vector<double> distances;
    for (const ViewResult& view : candidate.views)
        distances.push_back(measure.distance(view.*measure.value));
    const double bound = upperBound(distances);
    const int digits = measure.moreIsBetter() ? 2 : 3;
    return format(
        "{} {:.{}f} (at {} {:.{}f} with {:.3g} % confidence)", measure.spelt,
        meanOf(candidate.views, measure.value), digits, measure.moreIsBetter() ? "least" : "most",
        measure.moreIsBetter() ? measure.perfect - bound : bound, digits, 100 * boundLevel);
}

std::string resultsInWords(const Budget& budget, const Candidate& candidate) {
    std::string text = format("{:.3g} ms", candidate.milliseconds);
    for (const Measure* measure : measuresOf(budget))
        text += ", " + boundInWords(*measure, candidate);
    return text;
}

std::string countsInWords(const SweepStudy& study, const Choice& choice) {
    std::size_t measured = 0, failed = 0;
    for (const Candidate& candidate : choice.candidates) {
        measured += candidate.rung != Rung::glance;
        failed += candidate.rung != Rung::glance && !candidate.verdict.empty();
    }
    return format(
        "Of {} candidates, {} were measured on {} held-out views, of which {} missed a limit",
        choice.candidates.size(), measured, study.match.test.size(),
        failed ? std::to_string(failed) : "none");
}

Headline nothingFound(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    Headline headline{format("Nothing has {}.", inWords(budget)), ""};
    const auto nearest = nearestFirst(budget, choice);
    if (nearest.empty())
        headline.reason =
            format("All {} candidates fell out at a glance.", choice.candidates.size());
    else
        headline.reason = format("{}. {} came nearest: {}. {}", countsInWords(study, choice),
                                 nameOf(*nearest.front()), resultsInWords(budget, *nearest.front()),
                                 whatWouldAdmit(budget, *nearest.front()));
    return headline;
}

} // namespace

const std::string& nameOf(const Candidate& candidate) {
    return candidate.configuration.setting.name;
}

std::string inWords(const Budget& budget) {
    std::string text;
    const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
    for (const Measure& measure : measures())
        if (const std::optional<double> limit = budget.*measure.limit)
            add(format("{} at {} {:.4g}", measure.spelt, measure.moreIsBetter() ? "least" : "most",
                       *limit));
    if (budget.milliseconds)
        add(format("at most {:g} ms", *budget.milliseconds));
    for (const std::string& test : budget.failures)
        add("no failure of " + test);
    return text;
}

Headline headlineOf(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    if (!choice.chosen)
        return nothingFound(study, budget, choice);
    const Candidate& chosen = choice.candidates[*choice.chosen];
    Headline headline{
        budget.best ? format("{} has the best {} with {}.", nameOf(chosen), budget.best->spelt,
                             inWords(budget))
                    : format("{} is the cheapest with {}.", nameOf(chosen), inWords(budget)),
        format("{}. It takes {}.", countsInWords(study, choice), resultsInWords(budget, chosen))};
    if (!choice.alike.empty()) {
        const Candidate& cheapest = choice.candidates[choice.alike.front()];
        if (cheapest.milliseconds < chosen.milliseconds)
            headline.reason += format(" The views do not tell {} from it, which takes {:.3g} ms.",
                                      nameOf(cheapest), cheapest.milliseconds);
    }
    return headline;
}

std::string fateOf(const Budget& budget, const Choice& choice, const Candidate& candidate) {
    if (candidate.rung == Rung::chosen)
        return "chosen";
    if (!candidate.verdict.empty()) {
        const Standing worst = standings(budget, candidate.views).empty()
                                   ? Standing{}
                                   : standings(budget, candidate.views).front();
        if (!(worst.ratio > 1))
            return "fails " + candidate.verdict.substr(0, candidate.verdict.find(':'));
        if (!worst.measure)
            return "too slow";
        return format("{} too {}", worst.measure->moreIsBetter() ? "JOD" : worst.measure->spelt,
                      worst.measure->moreIsBetter() ? "low" : "high");
    }
    if (!budget.best || !choice.chosen)
        return "dearer";
    const auto index = static_cast<std::size_t>(&candidate - choice.candidates.data());
    return std::find(choice.alike.begin(), choice.alike.end(), index) != choice.alike.end()
               ? "not told from it"
               : "less good";
}

std::vector<const Candidate*> nearestFirst(const Budget& budget, const Choice& choice) {
    std::vector<std::pair<double, const Candidate*>> ranked;
    for (const Candidate& candidate : choice.candidates)
        if (candidate.rung != Rung::glance) {
            const auto all = standings(budget, candidate.views);
            ranked.emplace_back(all.empty() ? 0 : all.front().ratio, &candidate);
        }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<const Candidate*> found;
    for (const auto& [ratio, candidate] : ranked)
        found.push_back(candidate);
    return found;
}

std::string whatWouldAdmit(const Budget& budget, const Candidate& candidate) {
    const std::string limits = admitting(budget, candidate.views);
    if (limits.empty())
        return "";
    std::string text = limits + " would admit it";
    int needed = 0, over = 0;
    for (const Standing& standing : standings(budget, candidate.views)) {
        if (standing.ratio <= 1)
            continue;
        const std::optional<int> views = viewsNeeded(standing);
        over += !views;
        needed = std::max(needed, views.value_or(0));
    }
    if (over)
        return text + "; more views would not, for its mean misses the limit or is too near to it.";
    return text + format("; so might {} views that scatter like these {}, for the mean itself "
                         "meets the limit.",
                         needed, candidate.views.size());
}

} // namespace obscura
