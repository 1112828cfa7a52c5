#include "analysis/verdict.h"

#include "inference/equivalence.h"
#include "inference/multiplicity.h"
#include "inference/paired.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <tuple>

namespace obscura {

namespace {

// Of people, whose interval at 95 % asks for more than two one-sided tests at .05 do.
bool isWithin(const Tally& tally, double margin) {
    if (tally.people)
        return tally.people->share.low > 0.5 - margin && tally.people->share.high < 0.5 + margin;
    return equivalenceP(tally.votes, margin) < significance;
}

void decide(const Tally& tally, Verdict& verdict) {
    const double margin = tally.margin > 0 ? tally.margin : undeclaredMargin;
    if (!tally.fault.empty()) {
        verdict.outcome = Verdict::Outcome::unusable;
        verdict.why = tally.fault;
    } else if (tally.votes.total() < fewestVotes) {
        verdict.outcome = Verdict::Outcome::unusable;
        verdict.why = "too few votes: even unanimous ones could be chance";
    } else if (verdict.holm < significance) {
        verdict.outcome = Verdict::Outcome::differs;
    } else if (isWithin(tally, margin)) {
        verdict.outcome = Verdict::Outcome::equivalent;
        verdict.margin = margin;
    }
}

Tally::People judged(const std::vector<double>& shares) {
    const double share = shares.front(); // everybody's, where there is no interval
    const Interval interval = tInterval(shares).value_or(Interval{share, share});
    return {centreTest(shares, 0.5).p, {std::max(interval.low, 0.0), std::min(interval.high, 1.0)}};
}

} // namespace

std::string_view nameOf(Verdict::Outcome outcome) {
    constexpr std::array<std::string_view, 4> names = {"differs", "equivalent", "undecided",
                                                       "unusable"};
    return names[static_cast<std::size_t>(outcome)];
}

double decidingP(const Tally& tally) {
    return tally.people ? tally.people->p : exactP(tally.votes);
}

Interval intervalOf(const Tally& tally) {
    return tally.people ? tally.people->share : clopperPearson(tally.votes.b, tally.votes.total());
}

std::vector<std::optional<Verdict>> verdictsOf(const std::vector<Tally>& tallies) {
    std::map<std::string, std::vector<std::size_t>> families;
    for (std::size_t i = 0; i < tallies.size(); ++i)
        if (tallies[i].votes.total() > 0)
            families[tallies[i].family].push_back(i);
    std::vector<std::optional<Verdict>> verdicts(tallies.size());
    for (const auto& [family, members] : families) {
        std::vector<double> p;
        for (const std::size_t member : members)
            p.push_back(decidingP(tallies[member]));
        const std::vector<double> adjusted = holm(p), discoveries = benjaminiHochberg(p);
        for (std::size_t i = 0; i < members.size(); ++i) {
            Verdict verdict{adjusted[i], discoveries[i]};
            decide(tallies[members[i]], verdict);
            verdicts[members[i]] = std::move(verdict);
        }
    }
    return verdicts;
}

void judgeByPeople(std::vector<Tally>& tallies, const std::vector<Answer>& answers) {
    std::vector<std::tuple<std::uint32_t, std::uint64_t, bool>> votes; // condition, person, b
    votes.reserve(answers.size());
    for (const auto& [row, file, line] : answers)
        votes.emplace_back(row.conditionId.number(), row.person(), row.choseB);
    std::sort(votes.begin(), votes.end());
    std::map<std::uint32_t, std::vector<double>> shares; // of the people, by condition
    for (auto one = votes.begin(); one != votes.end();) {
        const auto [condition, person, ignored] = *one;
        Votes given;
        for (; one != votes.end() && std::get<0>(*one) == condition && std::get<1>(*one) == person;
             ++one)
            ++(std::get<2>(*one) ? given.b : given.a);
        shares[condition].push_back(static_cast<double>(given.b) /
                                    static_cast<double>(given.total()));
    }
    for (Tally& tally : tallies) {
        const std::vector<double>& people = shares[Symbol(tally.condition).number()];
        if (static_cast<std::int64_t>(people.size()) < tally.votes.total())
            tally.people = judged(people);
    }
}

} // namespace obscura
