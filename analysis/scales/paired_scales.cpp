#include "analysis/scales/scale_kinds.h"

#include "inference/agreement.h"
#include "inference/boosted.h"
#include "inference/bootstrap.h"
#include "inference/counts.h"
#include "inference/pwcmp.h"
#include "inference/ties.h"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

namespace obscura {

namespace {

constexpr Eigen::Index mostForPrior = 9; // items, for its time grows with their fifth power
constexpr double priorSd = 3;            // logits: that of an item which nobody ever chose

using ScaleOf = std::optional<Scale> (*)(const Wins&);

Eigen::MatrixXd part(const Eigen::MatrixXd& whole, const std::vector<int>& items) {
    const auto n = static_cast<Eigen::Index>(items.size());
    Eigen::MatrixXd result(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            result(i, j) =
                whole(items[static_cast<std::size_t>(i)], items[static_cast<std::size_t>(j)]);
    return result;
}

std::string namesOf(const ScaleGroup& group, const std::vector<int>& items) {
    std::vector<std::string> names;
    for (const int item : items)
        names.push_back(group.items[static_cast<std::size_t>(item)]);
    return fmt::format("{}", fmt::join(names, ", "));
}

// One group for each set of items that were compared, at least through others; ties compare, too.
std::vector<Comparisons> connectedParts(const Comparisons& all) {
    const std::vector<std::vector<int>> sets = connection(all.wins + 0.5 * all.ties).groups;
    if (sets.size() == 1)
        return {all};
    std::string said;
    for (const std::vector<int>& set : sets)
        said += (said.empty() ? "{" : " and {") + namesOf(all, set) + "}";
    std::vector<Comparisons> partsOf;
    for (const std::vector<int>& set : sets) {
        Comparisons one = all;
        one.items.clear();
        for (const int item : set)
            one.items.push_back(all.items[static_cast<std::size_t>(item)]);
        one.wins = part(all.wins, set);
        one.ties = part(all.ties, set);
        one.answers = static_cast<int>(one.wins.sum() + one.ties.sum() / 2);
        one.winsOf.clear();
        one.tiesOf.clear();
        for (const Wins& wins : all.winsOf)
            one.winsOf.push_back(part(wins, set));
        for (const Eigen::MatrixXd& ties : all.tiesOf)
            one.tiesOf.push_back(part(ties, set));
        one.notes.push_back(fmt::format("{} were never compared with each other, not even through "
                                        "others: nobody can say how far apart these groups lie",
                                        said));
        if (one.items.size() >= 2)
            partsOf.push_back(std::move(one));
    }
    return partsOf;
}

// Of rows of pairs, two techniques alone have all that can be said in the table of votes.
template <typename Run>
std::vector<ScaleResult> eachPart(const ScaleData& data, bool withTies, const Run& run) {
    std::vector<ScaleResult> results;
    for (const Comparisons& group : data.comparisons) {
        if (group.mayTie != withTies || !group.source.empty())
            continue;
        const std::vector<Comparisons> all = connectedParts(group);
        const std::size_t before = results.size();
        for (const Comparisons& one : all)
            if (one.items.size() > 2 || !one.question.empty())
                results.push_back(run(one));
        if (results.size() == before && !all.empty()) { // to say why
            results.push_back(resultOf(group, {}));
            results.back().notes = all.front().notes;
        }
    }
    return results;
}

void addUnanimous(ScaleResult& result, const Comparisons& group) {
    int pairs = 0, unanimous = 0;
    for (Eigen::Index i = 0; i < group.wins.rows(); ++i)
        for (Eigen::Index j = 0; j < i; ++j) {
            const double ij = group.wins(i, j), ji = group.wins(j, i);
            pairs += ij + ji + group.ties(i, j) > 0;
            unanimous += ij + ji > 0 && std::min(ij, ji) == 0 && group.ties(i, j) == 0;
        }
    result.diagnostics.push_back({"pairs compared", static_cast<double>(pairs)});
    result.diagnostics.push_back({"of them unanimous", static_cast<double>(unanimous)});
}

// Do people agree with themselves and with each other? Of those who compared every pair once.
void addAgreement(ScaleResult& result, const Comparisons& group) {
    const Eigen::Index n = group.wins.rows();
    std::int64_t triads = 0, most = 0;
    std::vector<std::vector<double>> scores;
    std::vector<std::vector<std::int64_t>> total(
        static_cast<std::size_t>(n), std::vector<std::int64_t>(static_cast<std::size_t>(n)));
    for (const Wins& wins : group.winsOf) {
        const Eigen::MatrixXd pairs = wins + wins.transpose() + Eigen::MatrixXd::Identity(n, n);
        if (n < 3 || (pairs.array() != 1).any())
            continue;
        std::vector<std::int64_t> won;
        for (Eigen::Index i = 0; i < n; ++i) {
            won.push_back(static_cast<std::int64_t>(wins.row(i).sum()));
            for (Eigen::Index j = 0; j < n; ++j)
                total[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] +=
                    static_cast<std::int64_t>(wins(i, j));
        }
        const auto circular = circularTriads(won);
        triads += circular->triads;
        most += circular->most;
        scores.emplace_back(won.begin(), won.end());
    }
    if (scores.empty())
        return;
    result.diagnostics.push_back(
        {fmt::format("circular triads, of {} people who compared every pair once (most: {})",
                     scores.size(), most),
         static_cast<double>(triads)});
    if (const auto u = kendallU(total))
        result.diagnostics.push_back({"Kendall's u between people", u->u, u->test});
    if (const auto w = concordance(scores))
        result.diagnostics.push_back(
            {"Kendall's W of people's numbers of choices; Friedman", w->w, w->friedman});
}

void addFit(ScaleResult& result, const Scale& scale) {
    if (const auto fit = fitTest(scale))
        result.diagnostics.push_back(
            {"does the scale fit the shares? (deviance)", std::nullopt, fit});
    result.diagnostics.push_back(
        {"are all equal? (likelihood ratio)", std::nullopt, equalityTest(scale)});
}

void addPlaces(ScaleResult& result, const Comparisons& group) {
    if (group.placed > 0)
        result.diagnostics.push_back(
            {fmt::format("the second place was chosen, of {} choices", group.placed),
             static_cast<double>(group.second),
             Test{std::nullopt, std::nullopt,
                  exactP({group.placed - group.second, group.second})}});
}

Refit refitOf(const Comparisons& group,
              const std::function<std::optional<Eigen::VectorXd>(const Wins&)>& valuesOf) {
    if (group.winsOf.empty())
        return {};
    return [&group, valuesOf](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
        return valuesOf(pooled(group.winsOf, times));
    };
}

std::optional<Eigen::VectorXd> valuesOf(const std::optional<Scale>& scale) {
    return scale ? std::optional(scale->values) : std::nullopt;
}

// Which items nobody ever chose over others, so that a likelihood has no maximum.
std::string unbounded(const Comparisons& group) {
    const std::vector<std::vector<int>> tiers = connection(group.wins).tiers;
    std::string said;
    for (const std::vector<int>& tier : tiers)
        said += (said.empty() ? "{" : " over {") + namesOf(group, tier) + "}";
    return said + " in every comparison between them: their distance has no upper bound";
}

ScaleResult thurstoneOf(const Comparisons& group) {
    ScaleResult result = resultOf(group, "JOD");
    addUnanimous(result, group);
    if (const auto scale = thurstone(group.wins)) {
        addFit(result, *scale);
        addScale(result, scale->values, scale->covariance,
                 refitOf(group, [](const Wins& wins) { return valuesOf(thurstone(wins)); }));
    } else if (const auto values = group.wins.rows() <= mostForPrior
                                       ? pwcmpScaleWithPrior(group.wins)
                                       : std::nullopt) {
        result.notes.push_back(unbounded(group) +
                               "; values are with pwcmp's Gaussian prior (Perez-Ortiz, Mantiuk "
                               "2017), which makes them finite and depends on it");
        addScale(result, *values, {}, refitOf(group, pwcmpScaleWithPrior));
    } else if (const auto prior = thurstone(group.wins, priorSd / jodUnit)) {
        result.notes.push_back(unbounded(group) +
                               fmt::format("; values are with a normal prior of standard deviation "
                                           "{:.1f} JOD",
                                           priorSd / jodUnit));
        addScale(result, prior->values, prior->covariance, {});
    }
    addAgreement(result, group);
    addPlaces(result, group);
    return result;
}

ScaleResult bradleyTerryOf(const Comparisons& group) {
    ScaleResult result = resultOf(group, "logit");
    if (const auto scale = bradleyTerry(group.wins)) {
        addFit(result, *scale);
        addScale(result, scale->values, scale->covariance,
                 refitOf(group, [](const Wins& wins) { return valuesOf(bradleyTerry(wins)); }));
    } else if (const auto prior = bradleyTerry(group.wins, priorSd)) {
        result.notes.push_back(unbounded(group) +
                               fmt::format("; values are with a normal prior of standard deviation "
                                           "{:g} logits",
                                           priorSd));
        addScale(result, prior->values, prior->covariance, refitOf(group, [](const Wins& wins) {
                     return valuesOf(bradleyTerry(wins, priorSd));
                 }));
    }
    return result;
}

using TieScaleOf = std::optional<TieScale> (*)(const Wins&, const Eigen::MatrixXd&);

ScaleResult tieScale(const Comparisons& group, const std::string& unit, const std::string& name,
                     TieScaleOf scaleOf) {
    ScaleResult result = resultOf(group, unit);
    addUnanimous(result, group);
    result.diagnostics.push_back({"answers \"not sure\"", group.ties.sum() / 2});
    const auto scale = scaleOf(group.wins, group.ties);
    if (!scale) {
        result.notes.push_back("the likelihood has no finite maximum: there are ties only, or a "
                               "technique that was never the worse");
        return result;
    }
    if (scale->ties)
        result.diagnostics.push_back({name, scale->ties->value});
    addFit(result, scale->scale);
    const Refit refit = [&](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
        const auto again = scaleOf(pooled(group.winsOf, times), pooled(group.tiesOf, times));
        return again ? std::optional(again->scale.values) : std::nullopt;
    };
    addScale(result, scale->scale.values, scale->scale.covariance,
             group.winsOf.empty() ? Refit() : refit);
    addPlaces(result, group);
    return result;
}

// "Not sure" is half a vote for each.
Wins halved(const Comparisons& group) { return group.wins + 0.5 * group.ties; }

// Values grow with the difference from the source.
ScaleResult tripletsOf(const Comparisons& group, const Comparisons* plain) {
    ScaleResult result = resultOf(group, group.isBoosted ? "boosted JND" : "JND");
    result.diagnostics.push_back({"answers \"not sure\", half a vote each", group.ties.sum() / 2});
    const auto source = std::find(group.items.begin(), group.items.end(), group.source);
    if (plain && plain->items == group.items && source != group.items.end()) {
        const auto number = static_cast<int>(source - group.items.begin());
        if (const auto scale = boostedScale(halved(group), halved(*plain), number)) {
            result.unit = "JND";
            if (!scale->isMonotone)
                result.notes.push_back("plain and boosted triplets contradict each other: do not "
                                       "trust this scale");
            addScale(result, scale->scale.values, scale->scale.covariance, {});
            return result;
        }
    }
    if (group.isBoosted)
        result.notes.push_back(
            "boosted differences only: without plain triplets of the same images "
            "these are not the differences that people see");
    if (source == group.items.end())
        result.notes.push_back(fmt::format("the source ({}) was never one of the two, so its own "
                                           "place is not known",
                                           group.source));
    Comparisons halves = group;
    halves.wins = halved(group);
    for (std::size_t i = 0; i < halves.winsOf.size(); ++i)
        halves.winsOf[i] += 0.5 * halves.tiesOf[i];
    const auto scale = thurstone(halves.wins);
    if (!scale) {
        result.notes.push_back(unbounded(halves));
        if (const auto prior = pwcmpScaleWithPrior(halves.wins))
            addScale(result, *prior, {}, refitOf(halves, pwcmpScaleWithPrior));
        return result;
    }
    addFit(result, *scale);
    addScale(result, scale->values, scale->covariance,
             refitOf(halves, [](const Wins& wins) { return valuesOf(thurstone(wins)); }));
    addPlaces(result, group);
    return result;
}

} // namespace

std::vector<ScaleResult> thurstoneScales(const ScaleData& data) {
    return eachPart(data, false, thurstoneOf);
}

std::vector<ScaleResult> bradleyTerryScales(const ScaleData& data) {
    return eachPart(data, false, bradleyTerryOf);
}

std::vector<ScaleResult> davidsonScales(const ScaleData& data) {
    return eachPart(data, true, [](const Comparisons& group) {
        return tieScale(group, "logit", "nu: how readily people tie", davidson);
    });
}

std::vector<ScaleResult> thresholdScales(const ScaleData& data) {
    return eachPart(data, true, [](const Comparisons& group) {
        return tieScale(group, "JOD", "threshold below which people tie, JOD",
                        [](const Wins& wins, const Eigen::MatrixXd& ties) {
                            return thresholdScale(wins, ties, Link::probit);
                        });
    });
}

std::vector<ScaleResult> tripletScales(const ScaleData& data) {
    std::vector<ScaleResult> results;
    for (const Comparisons& group : data.comparisons) {
        if (group.source.empty())
            continue;
        const auto plain = std::find_if(
            data.comparisons.begin(), data.comparisons.end(), [&](const Comparisons& other) {
                return group.isBoosted && !other.isBoosted && other.source == group.source &&
                       other.scene == group.scene && other.level == group.level;
            });
        for (const Comparisons& one : connectedParts(group))
            results.push_back(tripletsOf(one, plain == data.comparisons.end() ? nullptr : &*plain));
    }
    return results;
}

} // namespace obscura
