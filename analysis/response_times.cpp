#include "analysis/response_times.h"

#include <algorithm>
#include <unordered_map>

namespace obscura {

namespace {

constexpr NamedRule rules[] = {
    {FlagRule::fast, "fast", "below 200 ms"},
    {FlagRule::sd, "sd", "more than 3 sd from the mean"},
    {FlagRule::sdLog, "sd_log", "the same of logarithms"},
    {FlagRule::mad, "mad", "more than 2.5 MAD from the median"},
    {FlagRule::madLog, "mad_log", "the same of logarithms (the default)"},
    {FlagRule::tukey, "tukey", "more than 1.5 interquartile ranges outside of the quartiles"},
};

constexpr std::size_t mostShown = 300; // flagged times that are kept for a picture

template <auto field>
std::vector<double> valuesOf(const std::vector<Answer>& answers) {
    std::vector<double> values;
    values.reserve(answers.size());
    for (const Answer& answer : answers)
        values.push_back(answer.row.*field);
    return values;
}

ResponseTimes::Measure measureOf(std::string_view id, std::string_view name,
                                 const std::vector<double>& values) {
    ResponseTimes::Measure measure{id, name, *summary(values), {}};
    const std::vector<double> found = quantiles(values, timeShares);
    std::copy(found.begin(), found.end(), measure.quantiles.begin());
    return measure;
}

// The tallies without the flagged answers.
std::vector<Tally> withoutFlagged(const std::vector<Answer>& answers, std::vector<Tally> tallies,
                                  const std::vector<bool>& isFlagged) {
    std::unordered_map<std::uint32_t, Tally*> byCondition;
    for (Tally& tally : tallies)
        byCondition[Symbol(tally.condition).number()] = &tally;
    for (std::size_t i = 0; i < answers.size(); ++i)
        if (isFlagged[i]) {
            const Vote& row = answers[i].row;
            Votes& votes = byCondition.at(row.conditionId.number())->votes;
            --(row.choseB ? votes.b : votes.a);
        }
    if (std::any_of(tallies.begin(), tallies.end(),
                    [](const Tally& t) { return t.people.has_value(); })) {
        std::vector<Answer> kept;
        for (std::size_t i = 0; i < answers.size(); ++i)
            if (!isFlagged[i])
                kept.push_back(answers[i]);
        for (Tally& tally : tallies)
            tally.people.reset();
        judgeByPeople(tallies, kept);
    }
    return tallies;
}

std::vector<ResponseTimes::Change> changesOf(const std::vector<Tally>& with,
                                             const std::vector<Tally>& without) {
    std::vector<ResponseTimes::Change> changes;
    const auto before = verdictsOf(with), after = verdictsOf(without);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (!before[i])
            continue;
        const auto outcome = after[i] ? after[i]->outcome : Verdict::Outcome::unusable;
        if (outcome != before[i]->outcome)
            changes.push_back({i, before[i]->outcome, outcome});
    }
    return changes;
}

} // namespace

std::span<const NamedRule> flagRules() { return rules; }

std::int64_t ResponseTimes::count() const {
    return std::count(isFlagged.begin(), isFlagged.end(), true);
}

ResponseTimes responseTimes(const std::vector<Answer>& answers, const std::vector<Tally>& tallies) {
    ResponseTimes times;
    times.measures.push_back(
        measureOf("view1_ms", "first view", valuesOf<&Vote::view1Ms>(answers)));
    times.measures.push_back(
        measureOf("view2_ms", "second view", valuesOf<&Vote::view2Ms>(answers)));
    const std::vector<double> decisions = valuesOf<&Vote::decisionRtMs>(answers);
    times.measures.push_back(measureOf("decision_rt_ms", "decision", decisions));
    for (const NamedRule& rule : flagRules()) {
        std::vector<bool> flagged = flags(decisions, rule.rule);
        times.flagged.push_back(std::count(flagged.begin(), flagged.end(), true));
        if (rule.rule == defaultFlag)
            times.isFlagged = std::move(flagged);
    }
    const auto step = static_cast<std::size_t>(times.count()) / mostShown + 1;
    std::size_t found = 0;
    for (std::size_t i = 0; i < decisions.size(); ++i)
        if (times.isFlagged[i] && found++ % step == 0)
            times.flaggedMs.push_back(decisions[i]);
    if (found > 0)
        times.changes = changesOf(tallies, withoutFlagged(answers, tallies, times.isFlagged));
    return times;
}

} // namespace obscura
