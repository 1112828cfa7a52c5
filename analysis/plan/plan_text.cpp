#include "analysis/plan/plan.h"
#include "analysis/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

std::string text(const Chance& chance) {
    std::string words = percent(chance.share);
    if (chance.interval)
        words += fmt::format(" ({:.1f} to {:.1f})", 100 * chance.interval->low,
                             100 * chance.interval->high);
    return words;
}

// Rounded up to balanced orders, in brackets.
std::string people(const std::optional<std::int64_t>& number, int balance) {
    if (!number)
        return "–";
    return fmt::format("{} ({})", *number, (*number + balance - 1) / balance * balance);
}

std::string testText(const PlannedTest& test, const Plan& plan) {
    const bool isTrend = test.claim.kind == Claim::Kind::trend;
    const bool isEquivalence = test.claim.kind == Claim::Kind::equivalent;
    Table table{{{isTrend ? "Share, highest score" : "True share", true},
                 {"JOD", true},
                 {fmt::format("Power at N = {}", plan.people), true}},
                {}};
    if (test.exact) {
        table.columns.push_back({fmt::format("N for {:.0f} %", 100 * plan.options.power), true});
        table.columns.push_back({"N for 90 %", true});
    }
    for (const EffectPower& effect : test.effects) {
        table.rows.push_back({fmt::format("{:.3g}", effect.share),
                              fmt::format("{:.2f}", jodOf(effect.share)), text(effect.power)});
        if (test.exact) {
            table.rows.back().push_back(people(effect.needed, plan.balance));
            table.rows.back().push_back(people(effect.ninety, plan.balance));
        }
    }
    std::string words = fmt::format(
        "{}: {}{}, {} condition(s); level {:.4g}, the first of {} claim(s) of its family; {}\n{}",
        test.claim.name, claimKindNames()[static_cast<std::size_t>(test.claim.kind)],
        isEquivalence ? fmt::format(" within 1/2 ± {:g}", test.claim.margin) : "",
        test.claim.conditions.size(), 0.05 / test.family, test.family,
        test.exact ? "exact"
                   : fmt::format("{} simulated studies, people spread by {:g} JOD",
                                 plan.options.studies, plan.options.spread),
        alignedText(table));
    if (test.predicted)
        words += fmt::format("Predicted: a share of {:.3f}, which {} people find with {}; N for "
                             "{:.0f} %: {}, for 90 "
                             "%: {}.\n",
                             test.predicted->share, plan.people, text(test.predicted->power),
                             100 * plan.options.power, people(test.predicted->needed, plan.balance),
                             people(test.predicted->ninety, plan.balance));
    if (test.detectable)
        words += fmt::format("{} people find a share of {:.3f} ({:.2f} JOD) with {:.0f} %.\n",
                             plan.people, *test.detectable, jodOf(*test.detectable),
                             100 * plan.options.power);
    else if (!isEquivalence)
        words += fmt::format("{} people find no effect, not even unanimity, with {:.0f} %.\n",
                             plan.people, 100 * plan.options.power);
    return words;
}

// Of each claim the smallest number that was simulated and reaches the target.
std::string smallest(const Plan& plan, std::size_t claim, double target) {
    for (const StatedPower& stated : plan.stated)
        if (stated.supported[claim].share >= target)
            return fmt::format("{}", stated.people);
    return fmt::format("> {}", plan.stated.back().people);
}

std::string statedText(const Plan& plan) {
    Table table{{{"Claim"}}, {}};
    for (const StatedPower& stated : plan.stated)
        table.columns.push_back({fmt::format("N = {}", stated.people), true});
    table.columns.push_back({fmt::format("N for {:.0f} %", 100 * plan.options.power), true});
    for (std::size_t i = 0; i < plan.tests.size(); ++i) {
        table.rows.push_back({plan.tests[i].claim.name});
        for (const StatedPower& stated : plan.stated)
            table.rows.back().push_back(text(stated.supported[i]));
        table.rows.back().push_back(smallest(plan, i, plan.options.power));
    }
    const std::string people =
        plan.predicted.empty()
            ? "as the protocol's simulated ones do (simulatedPreference; those of whom it says "
              "nothing guess)"
            : "by predicted JOD (see above; not by people)";
    return fmt::format("If people chose {}, with\n{:g} JOD between people, each claim would be "
                       "supported, Holm's correction included, in ({} simulated studies, 95 % "
                       "intervals):\n\n{}",
                       people, plan.options.spread, plan.options.studies, alignedText(table));
}

} // namespace

std::string predictedText(const Plan& plan) {
    if (plan.predicted.empty())
        return {};
    const bool mayTie = std::any_of(plan.predicted.begin(), plan.predicted.end(),
                                    [](const PredictedPair& pair) { return pair.unsure > 0; });
    Table table{{{"Condition"}, {"JOD a", true}, {"JOD b", true}, {"Share of b", true}}, {}};
    if (mayTie)
        table.columns.push_back({"Not sure", true});
    for (const PredictedPair& pair : plan.predicted) {
        table.rows.push_back({pair.condition, fmt::format("{:.2f}", pair.jodA),
                              fmt::format("{:.2f}", pair.jodB), percent(pair.shareB)});
        if (mayTie)
            table.rows.back().push_back(percent(pair.unsure));
    }
    return fmt::format("By predicted JOD (ColorVideoVDP), not by people, on {}:\nchoices by "
                       "Thurstone's case V, {:g} % lapses, position bias {:g}; the mean of both "
                       "orders.\n{}\n",
                       plan.predictedOn, 100 * plan.lapse, plan.positionBias, alignedText(table));
}

std::string planText(const Plan& plan) {
    std::string words;
    if (!plan.declared)
        words += "The protocol claims nothing: each condition is planned for, corrected within its "
                 "hypothesis.\n\n";
    words += fmt::format(
        "{} people are to finish. Orders are balanced after every {} slots: {}. With {:.0f} % who "
        "do "
        "not finish, invite about {}.\n"
        "A session has {} trials, about {:.0f} minutes by the protocol's model of times, pages and "
        "breaks not counted.\n"
        "N counts people who finish; in brackets rounded up to balanced orders. N is the number "
        "from which on the power never falls below the target again.\n\n",
        plan.people, plan.balance,
        plan.people == plan.balanced
            ? "they are"
            : fmt::format("plan {} rather than {}", plan.balanced, plan.people),
        100 * plan.options.dropout, plan.invited, plan.trials, std::ceil(plan.minutes));
    words += predictedText(plan);
    for (const PlannedTest& test : plan.tests)
        words += testText(test, plan) + "\n";
    return words + statedText(plan);
}

} // namespace obscura
