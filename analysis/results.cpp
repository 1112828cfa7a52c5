#include "analysis/results.h"

#include "analysis/results_scales.h"
#include "analysis/statistics.h"
#include "analysis/verdict.h"
#include "base/csv.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <utility>
#include <vector>

namespace obscura {

namespace {

using Json = nlohmann::ordered_json;

Numbers numbersOf(const Tally& tally, const std::optional<Verdict>& verdict) {
    Numbers numbers = {{"votes_a", static_cast<double>(tally.votes.a)},
                       {"votes_b", static_cast<double>(tally.votes.b)}};
    if (!verdict)
        return numbers;
    for (const CountStatistic& statistic : countStatistics())
        numbers.emplace_back(statistic.golden.empty() ? statistic.id : statistic.golden,
                             statistic.of(tally.votes));
    numbers.emplace_back("p_holm", verdict->holm);
    numbers.emplace_back("p_benjamini_hochberg", verdict->benjaminiHochberg);
    if (const auto balanced = balancedShare(tally.bFirst, tally.bSecond)) {
        numbers.emplace_back("share_b_balanced", balanced->share);
        numbers.emplace_back("balanced_low", balanced->interval.low);
        numbers.emplace_back("balanced_high", balanced->interval.high);
    }
    return numbers;
}

void add(const std::optional<Test>& test, Numbers& numbers) {
    if (!test)
        return;
    numbers.emplace_back("statistic", test->statistic);
    numbers.emplace_back("df", test->df);
    numbers.emplace_back("p", test->p);
}

Numbers numbersOf(const ClaimResult& result) {
    Numbers numbers = {{"votes", static_cast<double>(result.votes)}};
    if (result.people > 0)
        numbers.emplace_back("people", static_cast<double>(result.people));
    numbers.emplace_back("estimate", result.estimate);
    if (result.interval) {
        numbers.emplace_back("confidence", result.confidence / 100.0);
        numbers.emplace_back("low", result.interval->low);
        numbers.emplace_back("high", result.interval->high);
    }
    add(result.test, numbers);
    numbers.emplace_back("p_holm", result.holm);
    return numbers;
}

Numbers numbersOf(const Tested& tested) {
    Numbers numbers;
    add(tested.result.test, numbers);
    numbers.emplace_back("p_holm", tested.holm);
    return numbers;
}

std::string lines(std::string_view of, const std::string& subject, const Numbers& numbers) {
    std::string csv;
    for (const auto& [name, value] : numbers)
        if (value)
            csv += fmt::format("{},{},{},{}\n", of, csvCell(subject), name, *value);
    return csv;
}

Json objectOf(const Numbers& numbers) {
    Json object = Json::object();
    for (const auto& [name, value] : numbers)
        if (value)
            object[name] = *value;
    return object;
}

Json objectOf(const ClaimResult& result) {
    const Claim& claim = result.claim;
    return {{"name", claim.name},
            {"kind", claimKindNames()[static_cast<std::size_t>(claim.kind)]},
            {"conditions", claim.conditions},
            {"family", claim.family},
            {"outcome", nameOf(result.outcome)},
            {"sentence", sentenceOf(result)},
            {"method", result.method},
            {"measure", result.measure},
            {"notes", result.notes},
            {"statistics", objectOf(numbersOf(result))}};
}

Json objectOf(const Tally& tally, const std::optional<Verdict>& verdict) {
    return {{"condition", tally.condition},
            {"level", tally.level},
            {"scene", tally.scene},
            {"technique_a", tally.techniqueA},
            {"technique_b", tally.techniqueB},
            {"hypothesis", tally.hypothesis},
            {"family", tally.family},
            {"verdict", verdict ? std::string(nameOf(verdict->outcome)) : "no votes"},
            {"statistics", objectOf(numbersOf(tally, verdict))}};
}

// The subject of a test: its id and what it is about.
std::string subjectOf(const Tested& tested) {
    return fmt::format("{}: {}", tested.kind->id, tested.result.about);
}

} // namespace

std::string resultsCsv(const Findings& findings) {
    std::string csv = "of,subject,statistic,value\n";
    for (const ClaimResult& claim : findings.claims)
        csv += lines("claim", claim.claim.name, numbersOf(claim));
    const auto verdicts = verdictsOf(findings.tallies);
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        csv += lines("condition", findings.tallies[i].condition,
                     numbersOf(findings.tallies[i], verdicts[i]));
    for (const Tested& tested : findings.tests)
        csv += lines("test", subjectOf(tested), numbersOf(tested));
    for (const ScaleNumbers& scale : scaleNumbers(findings))
        for (const auto& [item, numbers] : scale.items)
            csv += lines("scale", fmt::format("{}: {}", scale.subject, item), numbers);
    return csv;
}

std::string resultsJson(const Findings& findings, const Json& made) {
    Json json = {{"format_version", 2}, // 1 did not say how it was made
                 {"made", made},
                 {"source", sourceOf(findings)},
                 {"title", findings.title},
                 {"cautions", cautionsOf(findings)},
                 {"summary", summaryOf(findings)},
                 {"claims", Json::array()},
                 {"conditions", Json::array()},
                 {"tests", Json::array()},
                 {"scales", Json::array()},
                 {"exclusions", Json::array()}};
    for (const ClaimResult& claim : findings.claims)
        json["claims"].push_back(objectOf(claim));
    const auto verdicts = verdictsOf(findings.tallies);
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        json["conditions"].push_back(objectOf(findings.tallies[i], verdicts[i]));
    for (const Tested& tested : findings.tests)
        json["tests"].push_back({{"test", tested.kind->id},
                                 {"question", tested.kind->question},
                                 {"method", tested.kind->source},
                                 {"about", tested.result.about},
                                 {"note", tested.result.note},
                                 {"statistics", objectOf(numbersOf(tested))}});
    for (const ScaleNumbers& scale : scaleNumbers(findings)) {
        Json items = Json::array();
        for (const auto& [item, numbers] : scale.items)
            items.push_back({{"name", item}, {"statistics", objectOf(numbers)}});
        json["scales"].push_back({{"subject", scale.subject},
                                  {"scale", scale.id},
                                  {"question", scale.question},
                                  {"scene", scale.scene},
                                  {"level", scale.level},
                                  {"unit", scale.unit},
                                  {"reference", scale.reference},
                                  {"intervals", scale.intervals},
                                  {"notes", scale.notes},
                                  {"items", items}});
    }
    for (const Exclusion& exclusion : findings.exclusions)
        json["exclusions"].push_back({{"participant", exclusion.participant},
                                      {"session", exclusion.session},
                                      {"reason", exclusion.reason},
                                      {"trials", exclusion.trials}});
    return json.dump(1) + "\n";
}

std::string exclusionsCsv(const Findings& findings) {
    std::string csv = "participant_id,session_id,reason,trials\n";
    for (const Exclusion& exclusion : findings.exclusions)
        csv += fmt::format("{},{},{},{}\n", csvCell(exclusion.participant),
                           csvCell(exclusion.session), csvCell(exclusion.reason), exclusion.trials);
    return csv;
}

namespace {

std::string decimal(const std::optional<double>& value) {
    return value ? fmt::format("{:.3f}", *value) : "–";
}

} // namespace

Table claimTable(const std::vector<ClaimResult>& claims) {
    Table table{{{"Claim"},
                 {"Answer"},
                 {"Estimate of"},
                 {"Estimate", true},
                 {"Interval", true},
                 {"Test"},
                 {"p", true},
                 {"p (Holm)", true},
                 {"People", true},
                 {"Votes", true}},
                {}};
    for (const ClaimResult& result : claims)
        table.rows.push_back(
            {result.claim.name, std::string(nameOf(result.outcome)), result.measure,
             decimal(result.estimate),
             result.interval ? fmt::format("{:.3f} to {:.3f} ({} %)", result.interval->low,
                                           result.interval->high, result.confidence)
                             : "–",
             result.method.empty() ? result.why : result.method,
             decimal(result.test ? std::optional(result.test->p) : std::nullopt),
             decimal(result.holm), result.people > 0 ? fmt::format("{}", result.people) : "–",
             fmt::format("{}", result.votes)});
    return table;
}

// Reasons of one rule differ in their numbers; so people are named as long as they are few.
Table exclusionTable(const std::vector<Exclusion>& exclusions) {
    constexpr std::size_t shown = 20;
    Table table{{{"Who"}, {"Why"}, {"Trials", true}}, {}};
    int trials = 0;
    for (std::size_t i = 0; i < exclusions.size(); ++i) {
        const Exclusion& one = exclusions[i];
        trials += one.trials;
        if (i < shown)
            table.rows.push_back({one.participant.empty()
                                      ? "single trials"
                                      : fmt::format("{}, session {}", one.participant, one.session),
                                  one.reason, fmt::format("{}", one.trials)});
    }
    if (exclusions.size() > shown)
        table.rows.push_back(
            {"all", fmt::format("{} more are in exclusions.csv", exclusions.size() - shown),
             fmt::format("{}", trials)});
    return table;
}

} // namespace obscura
