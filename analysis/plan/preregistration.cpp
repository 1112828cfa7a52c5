#include "analysis/plan/preregistration.h"

#include "analysis/exclusions.h"
#include "base/files.h"
#include "base/version.h"
#include "protocols/reader/balance.h"
#include "protocols/reader/design.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace obscura {

namespace {

using Kind = Claim::Kind;

const Condition& conditionOf(const Protocol& protocol, const std::string& id) {
    return *std::find_if(protocol.conditions.begin(), protocol.conditions.end(),
                         [&](const Condition& condition) { return condition.id == id; });
}

std::string testOf(const Claim& claim, int repeats) {
    const bool once = repeats == 1;
    switch (claim.kind) {
    case Kind::superior:
        return claim.conditions.size() == 1 && once
                   ? "the two-sided exact binomial test of the votes against 1/2"
                   : "Student's t test of the people's shares over these conditions against 1/2";
    case Kind::equivalent:
        return fmt::format("two one-sided {} at .05 in each condition, all of which must succeed; "
                           "equivalent means a share of b within 50 ± {:g} %",
                           once ? "exact binomial tests" : "t tests of the people's shares",
                           100 * claim.margin);
    case Kind::trend:
        return claim.conditions.size() == 2 && once
                   ? "McNemar's exact test of the people who change their answer"
                   : "Student's t test of the people's slopes over the scores against 0";
    }
    return {};
}

// What is claimed of the shares.
std::string meaningOf(const Claim& claim) {
    switch (claim.kind) {
    case Kind::superior:
        return fmt::format("The image `{}` is chosen in more than half of the trials.",
                           claim.favours);
    case Kind::equivalent:
        return "Neither image is chosen noticeably more often, in any of the conditions.";
    case Kind::trend:
        return fmt::format("The share of the image `{}` rises with the scores {:g}.", claim.favours,
                           fmt::join(claim.scores, ", "));
    }
    return {};
}

std::string hypotheses(const Protocol& protocol, const Plan& plan) {
    if (!plan.declared)
        return "The protocol claims nothing. All of its conditions are exploratory: no result of "
               "this study confirms anything.\n";
    std::string words;
    int number = 0;
    for (const PlannedTest& test : plan.tests) {
        words += fmt::format("{}. **{}** ({}). {}\n", ++number, test.claim.name,
                             claimKindNames()[static_cast<std::size_t>(test.claim.kind)],
                             meaningOf(test.claim));
        words += "   Conditions:";
        for (const std::string& id : test.claim.conditions) {
            const Condition& condition = conditionOf(protocol, id);
            words += fmt::format(" `{}` (a: {}, b: {});", id, condition.roles[0].technique,
                                 condition.roles[1].technique);
        }
        words.back() = '.';
        words += fmt::format("\n   Test: {}. Family: {}, {} claim(s).\n",
                             testOf(test.claim, protocol.ordering.repeats),
                             test.claim.family.empty() ? "that of claims that name none"
                                                       : "\"" + test.claim.family + "\"",
                             test.family);
    }
    return words + "\nThe claims of one family are corrected together by Holm's method; a claim is "
                   "supported, or contradicted, where its adjusted p is below .05. Each person "
                   "counts once. Otherwise it is undecided, which is no evidence of equality.\n";
}

std::string design(const Protocol& protocol, const Plan& plan) {
    const Ordering& ordering = protocol.ordering;
    std::string words = fmt::format(
        "Every person sees {} conditions, {} time(s) each, {} trials in all with {} for practice "
        "and {} conditions that catch inattention. Order: `{}`{}. ",
        mainConditions(protocol).size(), ordering.repeats, plan.trials, ordering.practice.size(),
        ordering.catches.size(), orderSchemeNames()[static_cast<std::size_t>(ordering.scheme)],
        ordering.blocks ? fmt::format(", in blocks of one {}",
                                      likenessNames()[static_cast<std::size_t>(*ordering.blocks)])
                        : "");
    words += fmt::format("It is balanced after every {} people, the images' order within trials "
                         "included. A trial:",
                         plan.balance);
    for (const Phase& phase : phasesOf(protocol.trial)) {
        words += fmt::format(" {}", phase.name);
        if (phase.counted())
            words += phase.frames > 0 ? fmt::format(" ({} refreshes)", phase.frames)
                                      : fmt::format(" ({:g} s)", phase.seconds);
        else if (phase.atLeast > 0)
            words += fmt::format(" (at least {:g} s)", phase.atLeast);
        words += ",";
    }
    words.back() = '.';
    return words + "\n";
}

std::string stimuli(const Protocol& protocol) {
    std::string words =
        fmt::format("Images of {} x {} pixels:\n\n", protocol.width, protocol.height);
    words += "| condition | scene | level | a | b |\n|---|---|---|---|---|\n";
    for (const int index : mainConditions(protocol)) {
        const Condition& condition = protocol.conditions[static_cast<std::size_t>(index)];
        if (condition.roles.size() == 2)
            words += fmt::format("| {} | {} | {} | {} | {} |\n", condition.id, condition.view,
                                 condition.level, condition.roles[0].technique,
                                 condition.roles[1].technique);
    }
    return words;
}

std::string numbers(const Plan& plan) {
    std::string words = fmt::format(
        "{} people finish a session. Whoever leaves before the last trial gives the place in the "
        "order back to another, so that about {} are invited if {:.0f} % do not finish. The study "
        "stops when {} have finished, whatever they answered.{}\n\n",
        plan.people, static_cast<int>(std::ceil(plan.people / (1 - plan.options.dropout) - 1e-9)),
        100 * plan.options.dropout, plan.people,
        plan.people == plan.balanced
            ? ""
            : fmt::format(" {} is no multiple of {}: the orders are not balanced.", plan.people,
                          plan.balance));
    for (const PlannedTest& test : plan.tests)
        if (test.detectable)
            words += fmt::format("- {}: a true share of {:.3f} ({:.2f} JOD) is found with a "
                                 "probability of {:.0f} %, as the first of its family{}.\n",
                                 test.claim.name, *test.detectable, jodOf(*test.detectable),
                                 100 * plan.options.power,
                                 test.exact ? ""
                                            : fmt::format(" (simulated, with people spread by {:g} "
                                                          "JOD)",
                                                          plan.options.spread));
        else if (test.claim.kind == Kind::equivalent)
            words +=
                fmt::format("- {}: shown with a probability of {:.1f} % if the true shares are "
                            "even.\n",
                            test.claim.name, 100 * test.effects.front().power.share);
    if (!plan.predicted.empty())
        words += fmt::format("\n```\n{}```\n", predictedText(plan));
    return words;
}

std::string exclusions(const Protocol& protocol) {
    std::string words;
    for (const std::string& rule : inWords(protocol.exclusions))
        words += "- " + rule + "\n";
    if (words.empty())
        words = "- Nobody's answers are left out.\n";
    return words + "\nEvery result is given with and without what is left out.\n";
}

std::string exploratory(const Protocol& protocol, const Plan& plan) {
    std::set<std::string> claimed;
    if (plan.declared)
        for (const PlannedTest& test : plan.tests)
            claimed.insert(test.claim.conditions.begin(), test.claim.conditions.end());
    std::string words = "All that is not listed under Hypotheses, among it";
    for (const int index : mainConditions(protocol))
        if (const std::string& id = protocol.conditions[static_cast<std::size_t>(index)].id;
            !claimed.contains(id))
            words += fmt::format(" the condition `{}`,", id);
    return words + " position bias, consistency, times, and every model.\n";
}

std::string section(std::string_view heading, const std::string& words) {
    return fmt::format("## {}\n\n{}\n", heading, words);
}

} // namespace

std::string preregistration(const Protocol& protocol, const Plan& plan, std::string_view date) {
    std::string text =
        section("Hypotheses", hypotheses(protocol, plan)) +
        section("Design", design(protocol, plan)) + section("Stimuli", stimuli(protocol)) +
        section("People, and when the study stops",
                numbers(plan) + fmt::format("\n{} who takes part, how they are found and paid, who "
                                            "has approved it.\n",
                                            toBeWritten)) +
        section("What does not count", exclusions(protocol)) +
        section("What is exploratory", exploratory(protocol, plan)) +
        section("Why",
                fmt::format("{} what is known, and why the answers matter.\n", toBeWritten)) +
        section("What is known already",
                fmt::format("{} whether any answers have been collected or seen by now.\n",
                            toBeWritten)) +
        section("Software",
                fmt::format("Obscura {} ({}). SHA-256 of the protocol's file: `{}`; of the design "
                            "in it: `{}`. Every answer carries `design_sha256`, which is of this "
                            "design with the images' hashes. The report lists deviations.\n",
                            version(), commit(), protocol.sha256, sha256(designOf(protocol))));
    int open = 0;
    for (std::size_t at = text.find(toBeWritten); at != std::string::npos;
         at = text.find(toBeWritten, at + 1))
        ++open;
    return fmt::format(
        "# {}\n\nPreregistration, {}. NOT COMPLETE: only a person can write {} passages "
        "below, which begin with {} All else is from the protocol `{}`.\n\n{}",
        protocol.title, date, open, toBeWritten, protocol.name, text);
}

} // namespace obscura
