#include "analysis/scales/scale_kinds.h"
#include "base/error.h"

#include "inference/agreement.h"
#include "inference/mlds.h"
#include "inference/plackett_luce.h"
#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace obscura {

namespace {

// Those of people, each as often as the person counts.
template <typename One>
std::vector<One> repeated(const std::vector<One>& all, const std::vector<int>& person,
                          std::span<const int> times) {
    std::vector<One> result;
    for (std::size_t i = 0; i < all.size(); ++i)
        result.insert(result.end(),
                      static_cast<std::size_t>(times[static_cast<std::size_t>(person[i])]), all[i]);
    return result;
}

void addRankAgreement(ScaleResult& result, const Rankings& group) {
    std::vector<std::vector<double>> scores; // places, of whole rankings
    std::set<int> ranked;
    for (std::size_t i = 0; i < group.rankings.size(); ++i) {
        if (group.rankings[i].size() != group.items.size() ||
            !ranked.insert(group.person[i]).second)
            continue; // of each person the first whole ranking
        std::vector<double> places(group.items.size());
        for (std::size_t place = 0; place < group.rankings[i].size(); ++place)
            places[static_cast<std::size_t>(group.rankings[i][place])] =
                static_cast<double>(place + 1);
        scores.push_back(std::move(places));
    }
    if (const auto w = concordance(scores))
        result.diagnostics.push_back(
            {fmt::format("Kendall's W of {} people's rankings; Friedman", scores.size()), w->w,
             w->friedman});
}

std::optional<DifferenceScale> differenceScaleOf(int levels, std::span<const Quadruple> triads,
                                                 std::string* why = nullptr) {
    try {
        return differenceScale(levels, triads);
    } catch (const Error& error) { // answers that cannot tell all levels apart
        if (why)
            *why = error.what();
        return std::nullopt;
    }
}

ScaleResult differenceScaleOf(const Triads& group) {
    ScaleResult result = resultOf(group, "sd of judgement");
    result.isOrdered = true;
    std::string why =
        "the answers are as if without noise, or the last level equals the first: the "
        "likelihood has no finite maximum";
    const auto levels = static_cast<int>(group.items.size());
    const auto scale = differenceScaleOf(levels, group.triads, &why);
    if (!scale) {
        result.notes.push_back(why);
        return result;
    }
    addScale(result, scale->values, scale->covariance,
             [&](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
                 const auto again =
                     differenceScaleOf(levels, repeated(group.triads, group.person, times));
                 return again ? std::optional(again->values) : std::nullopt;
             });
    if (scale->sigma > 0)
        result.diagnostics.push_back({"noise, the last level being at 1", scale->sigma});
    return result;
}

} // namespace

std::vector<ScaleResult> rankingScales(const ScaleData& data) {
    std::vector<ScaleResult> results;
    for (const Rankings& group : data.rankings) {
        ScaleResult result = resultOf(group, "logit");
        const auto items = static_cast<int>(group.items.size());
        if (const auto scale = items < 2 ? std::nullopt : plackettLuce(items, group.rankings)) {
            result.diagnostics.push_back(
                {"are all equal? (likelihood ratio)", std::nullopt, equalityTest(*scale)});
            addScale(result, scale->values, scale->covariance,
                     [&](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
                         const auto again =
                             plackettLuce(items, repeated(group.rankings, group.person, times));
                         return again ? std::optional(again->values) : std::nullopt;
                     });
        } else {
            result.notes.push_back("some technique was never ranked above the others, so that its "
                                   "distance has no bound");
        }
        addRankAgreement(result, group);
        results.push_back(std::move(result));
    }
    return results;
}

std::vector<ScaleResult> differenceScales(const ScaleData& data) {
    std::vector<ScaleResult> results;
    for (const Triads& group : data.triads)
        results.push_back(differenceScaleOf(group));
    return results;
}

} // namespace obscura
