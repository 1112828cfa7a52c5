#include "analysis/claims.h"

#include "analysis/verdict.h"
#include "report/number.h"

#include "inference/equivalence.h"
#include "inference/multiplicity.h"
#include "inference/paired.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

namespace obscura {

namespace {

using Outcome = ClaimResult::Outcome;
using Kind = Claim::Kind;

// The votes of a claim: of each condition that has any, and of each person on each of these.
struct ClaimVotes {
    std::vector<const Tally*> tallies;
    std::vector<double> scores;             // of a trend
    std::vector<std::vector<Votes>> people; // empty for published counts
    bool known = false;                     // whose votes they are
    bool repeated = false;                  // somebody voted twice on a condition

    Votes pooled() const {
        Votes votes;
        for (const Tally* tally : tallies) {
            votes.a += tally->votes.a;
            votes.b += tally->votes.b;
        }
        return votes;
    }
};

ClaimVotes votesOf(const Claim& claim, const std::vector<Tally>& tallies,
                   const std::vector<Answer>* answers) {
    ClaimVotes votes;
    std::unordered_map<std::uint32_t, std::size_t> places;
    for (std::size_t i = 0; i < claim.conditions.size(); ++i)
        for (const Tally& tally : tallies)
            if (tally.condition == claim.conditions[i] && tally.votes.total() > 0) {
                places[Symbol(tally.condition).number()] = votes.tallies.size();
                votes.tallies.push_back(&tally);
                if (claim.kind == Kind::trend)
                    votes.scores.push_back(claim.scores[i]);
            }
    votes.known = answers != nullptr;
    if (!answers)
        return votes;
    std::unordered_map<std::uint64_t, std::size_t> people;
    for (const auto& [row, file, line] : *answers) {
        const auto place = places.find(row.conditionId.number());
        if (place == places.end())
            continue;
        const std::size_t person = people.try_emplace(row.person(), people.size()).first->second;
        if (person == votes.people.size())
            votes.people.emplace_back(votes.tallies.size());
        Votes& cell = votes.people[person][place->second];
        ++(row.choseB ? cell.b : cell.a);
        votes.repeated = votes.repeated || cell.total() > 1;
    }
    return votes;
}

double shareOf(const Votes& votes, bool ofA = false) {
    return static_cast<double>(ofA ? votes.a : votes.b) / static_cast<double>(votes.total());
}

double average(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

Votes exchangedIf(bool exchange, Votes votes) { return exchange ? Votes{votes.b, votes.a} : votes; }

// Of one number for each person, against a centre: t, or the sign test where all are the same.
void testPeople(const std::vector<double>& values, double centre, const char* what,
                ClaimResult& result) {
    result.people = static_cast<std::int64_t>(values.size());
    result.estimate = average(values);
    result.test = centreTest(values, centre);
    result.interval = tInterval(values);
    result.method =
        result.test->df
            ? fmt::format("Student's t of the people's {}, t({:g})", what, *result.test->df)
            : fmt::format("sign test of the people's {}, which are all the same", what);
}

void testSuperior(const ClaimVotes& votes, ClaimResult& result) {
    const bool ofA = result.claim.favours == "a";
    std::set<std::string> techniques;
    for (const Tally* tally : votes.tallies)
        techniques.insert(ofA ? tally->techniqueA : tally->techniqueB);
    result.measure =
        fmt::format("share of {} ({})", result.claim.favours, fmt::join(techniques, ", "));
    if (votes.known && (votes.tallies.size() > 1 || votes.repeated)) {
        std::vector<double> shares;
        for (const auto& person : votes.people) {
            Votes all;
            for (const Votes& cell : person) {
                all.a += cell.a;
                all.b += cell.b;
            }
            shares.push_back(shareOf(all, ofA));
        }
        testPeople(shares, 0.5, "shares", result);
        return;
    }
    const Votes pooled = exchangedIf(ofA, votes.pooled());
    result.method = "exact binomial test";
    result.people = static_cast<std::int64_t>(votes.people.size());
    result.estimate = shareOf(pooled);
    result.interval = clopperPearson(pooled.b, pooled.total());
    result.test = Test{{}, {}, exactP(pooled)};
    if (!votes.known && votes.tallies.size() > 1)
        result.notes.emplace_back("takes the votes on several conditions for those of different "
                                  "people, which they are not");
}

// One-sided p that the mean of the people's shares is above (or below) a limit.
double oneSided(const std::vector<double>& shares, double limit, bool above) {
    const auto t = tTest(shares, limit);
    if (!t)
        return 1;
    const bool right = (*t->statistic > 0) == above;
    return right ? t->p / 2 : 1 - t->p / 2;
}

// That the share of a condition is within the margin, and that it is beyond.
struct Closeness {
    double within = 1, beyond = 1;
    double share = 0;
    std::optional<Interval> interval; // 90 %
};

Closeness closenessOf(const ClaimVotes& votes, std::size_t condition, double margin) {
    const Votes all = votes.tallies[condition]->votes;
    if (!votes.known || !votes.repeated)
        return {equivalenceP(all, margin),
                std::min(1.0, 2 * std::min(binomialUpper(all.b, all.total(), 0.5 + margin),
                                           binomialLower(all.b, all.total(), 0.5 - margin))),
                shareOf(all), clopperPearson(all.b, all.total(), 0.9)};
    std::vector<double> shares;
    for (const auto& person : votes.people)
        if (person[condition].total() > 0)
            shares.push_back(shareOf(person[condition]));
    return {std::max(oneSided(shares, 0.5 - margin, true), oneSided(shares, 0.5 + margin, false)),
            std::min(1.0, 2 * std::min(oneSided(shares, 0.5 + margin, true),
                                       oneSided(shares, 0.5 - margin, false))),
            average(shares), tInterval(shares, 0.9)};
}

void testEquivalent(const ClaimVotes& votes, ClaimResult& result) {
    result.method = votes.repeated ? "two one-sided t tests of the people's shares"
                                   : "two exact one-sided tests";
    result.confidence = 90;
    result.people = static_cast<std::int64_t>(votes.people.size());
    double within = 0, beyond = 1;
    for (std::size_t i = 0; i < votes.tallies.size(); ++i) {
        const Closeness closeness = closenessOf(votes, i, result.claim.margin);
        beyond = std::min(beyond, closeness.beyond * static_cast<double>(votes.tallies.size()));
        if (closeness.within < within)
            continue;
        within = closeness.within; // the weakest of them decides
        result.measure = fmt::format("share of b, {}", votes.tallies[i]->condition);
        result.estimate = closeness.share;
        result.interval = closeness.interval;
    }
    result.test = Test{{}, {}, within};
    if (beyond < significance)
        result.outcome = Outcome::contradicted;
}

// How far a person's share rises from the lowest score to the highest, by least squares.
double slopeOf(const std::vector<Votes>& person, const std::vector<double>& scores, bool ofA) {
    const double centre = average(scores);
    const auto [low, high] = std::minmax_element(scores.begin(), scores.end());
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        sum += (scores[i] - centre) * shareOf(person[i], ofA);
        squares += (scores[i] - centre) * (scores[i] - centre);
    }
    return sum / squares * (*high - *low);
}

std::string riseOf(const Claim& claim) {
    return fmt::format("rise of the share of {} over the scores", claim.favours);
}

void testTotals(const ClaimVotes& votes, bool ofA, ClaimResult& result) {
    std::vector<Votes> totals;
    for (const Tally* tally : votes.tallies)
        totals.push_back(exchangedIf(ofA, tally->votes));
    result.method = "trend of totals (Cochran and Armitage)";
    result.measure = riseOf(result.claim);
    result.noEffect = 0;
    result.estimate = slopeOf(totals, votes.scores, false);
    result.test = trend(totals, votes.scores);
    result.notes.emplace_back("takes the votes for those of different people, which they are not: "
                              "only trial by trial can decide");
}

// Two conditions: the people who changed their answer between the lower score and the higher.
void testChanges(const std::vector<std::vector<Votes>>& people, const std::vector<double>& scores,
                 bool ofA, ClaimResult& result) {
    const std::size_t low = scores[0] < scores[1] ? 0 : 1;
    Votes changed; // b: towards the role
    for (const auto& person : people) {
        const bool before = shareOf(person[low], ofA) > 0.5,
                   after = shareOf(person[1 - low], ofA) > 0.5;
        if (before != after)
            ++(after ? changed.b : changed.a);
    }
    result.people = static_cast<std::int64_t>(people.size());
    result.method = "McNemar's exact test";
    result.measure = fmt::format("share of those who changed towards {}", result.claim.favours);
    result.notes.push_back(
        fmt::format("{} of {} people changed their answer, {} of them towards {}", changed.total(),
                    people.size(), changed.b, result.claim.favours));
    result.test = Test{{}, {}, changed.total() > 0 ? exactP(changed) : 1};
    if (changed.total() == 0)
        return;
    result.estimate = shareOf(changed);
    result.interval = clopperPearson(changed.b, changed.total());
}

void testTrend(const ClaimVotes& votes, ClaimResult& result) {
    const bool ofA = result.claim.favours == "a";
    std::set<std::string> scenes;
    for (const Tally* tally : votes.tallies)
        scenes.insert(tally->scene);
    if (scenes.size() > 1)
        result.notes.emplace_back("the scenes differ, too: which of them and the level matters "
                                  "cannot be told");
    if (!votes.known) {
        testTotals(votes, ofA, result);
        return;
    }
    std::vector<std::vector<Votes>> complete;
    for (const auto& person : votes.people)
        if (std::all_of(person.begin(), person.end(), [](Votes v) { return v.total() > 0; }))
            complete.push_back(person);
    if (complete.size() < votes.people.size())
        result.notes.push_back(
            fmt::format("{} people who did not answer all of its conditions are left out",
                        votes.people.size() - complete.size()));
    if (complete.empty())
        return;
    if (votes.tallies.size() == 2 && !votes.repeated) {
        testChanges(complete, votes.scores, ofA, result);
        return;
    }
    std::vector<double> slopes;
    for (const auto& person : complete)
        slopes.push_back(slopeOf(person, votes.scores, ofA));
    result.measure = riseOf(result.claim);
    result.noEffect = 0;
    testPeople(slopes, 0, "slopes", result);
}

std::string faultOf(const ClaimVotes& votes, const ClaimResult& result) {
    if (votes.tallies.empty())
        return "there are no votes on its conditions";
    for (const Tally* tally : votes.tallies)
        if (!tally->fault.empty())
            return fmt::format("{} ({})", tally->fault, tally->condition);
    if (result.claim.kind == Kind::trend &&
        std::equal(votes.scores.begin() + 1, votes.scores.end(), votes.scores.begin()))
        return "there are votes on conditions of one score only";
    const std::int64_t number =
        votes.known ? static_cast<std::int64_t>(votes.people.size()) : votes.pooled().total();
    if (number < fewestVotes)
        return fmt::format("{} {} are too few: even if they agreed, it could be chance", number,
                           votes.known ? "people" : "votes");
    return {};
}

ClaimResult testClaim(const Claim& claim, const std::vector<Tally>& tallies,
                      const std::vector<Answer>* answers) {
    ClaimResult result;
    result.claim = claim;
    const ClaimVotes votes = votesOf(claim, tallies, answers);
    result.votes = votes.pooled().total();
    result.why = faultOf(votes, result);
    if (!result.why.empty()) {
        result.outcome = Outcome::unusable;
        return result;
    }
    if (votes.tallies.size() < claim.conditions.size())
        result.notes.push_back(fmt::format("{} of its {} conditions have votes",
                                           votes.tallies.size(), claim.conditions.size()));
    if (claim.kind == Kind::superior)
        testSuperior(votes, result);
    else if (claim.kind == Kind::equivalent)
        testEquivalent(votes, result);
    else
        testTrend(votes, result);
    return result;
}

void decide(ClaimResult& result) {
    if (result.outcome != Outcome::undecided || !(result.holm < significance))
        return;
    const bool asClaimed = result.claim.kind == Kind::equivalent ||
                           result.estimate.value_or(result.noEffect) > result.noEffect;
    result.outcome = asClaimed ? Outcome::supported : Outcome::contradicted;
}

// Claims without a test are of their family, too: the correction is the one that was declared.
void adjust(std::vector<ClaimResult>& results) {
    std::map<std::string, std::vector<std::size_t>> families;
    for (std::size_t i = 0; i < results.size(); ++i)
        families[results[i].claim.family].push_back(i);
    for (const auto& [family, members] : families) {
        std::vector<double> p;
        for (const std::size_t member : members)
            p.push_back(results[member].test ? results[member].test->p : 1);
        const std::vector<double> adjusted = holm(p);
        for (std::size_t i = 0; i < members.size(); ++i)
            results[members[i]].holm = adjusted[i];
    }
}

std::string percent(double share) { return fmt::format("{:.0f}", 100 * share); }

std::string pText(double p) {
    return p < 0.001 ? "p < .001" : fmt::format("p = {}", fmt::format("{:.3f}", p).substr(p < 1));
}

// Percentage points, with their sign.
std::string points(double difference) {
    return (difference < 0 ? "−" : "+") + percent(std::abs(difference));
}

// What was found, without the test.
std::string foundOf(const ClaimResult& result) {
    if (!result.estimate)
        return {};
    const bool rise = result.noEffect == 0;
    const auto text = rise ? points : percent;
    const std::string limits =
        result.interval ? fmt::format(" ({} % interval {} to {})", result.confidence,
                                      text(result.interval->low), text(result.interval->high))
                        : "";
    if (rise)
        return fmt::format("From the lowest score to the highest, the share of {} changes by {} "
                           "points{}. ",
                           result.claim.favours, points(*result.estimate), limits);
    const std::string claimed =
        result.claim.kind == Kind::equivalent
            ? fmt::format("; claimed were {} to {}", percent(0.5 - result.claim.margin),
                          percent(0.5 + result.claim.margin))
            : "";
    return fmt::format("The {} is {} %{}{}. ", result.measure, percent(*result.estimate), limits,
                       claimed);
}

std::string meaningOf(const ClaimResult& result) {
    switch (result.outcome) {
    case Outcome::supported:
        return "the data support it";
    case Outcome::contradicted:
        return result.claim.kind == Kind::equivalent
                   ? "the data contradict it: the difference is larger than claimed"
                   : "the data contradict it: the effect is the other way round";
    case Outcome::undecided:
        return "the data do not decide, which is no evidence that there is no effect";
    case Outcome::unusable:
        return "the data cannot tell";
    }
    return {};
}

} // namespace

std::string_view nameOf(Outcome outcome) {
    constexpr std::array<std::string_view, 4> names = {"supported", "contradicted", "undecided",
                                                       "unusable"};
    return names[static_cast<std::size_t>(outcome)];
}

std::vector<ClaimResult> testClaims(const std::vector<Claim>& claims,
                                    const std::vector<Tally>& tallies,
                                    const std::vector<Answer>* answers) {
    std::vector<ClaimResult> results;
    for (const Claim& claim : claims)
        results.push_back(testClaim(claim, tallies, answers));
    adjust(results);
    for (ClaimResult& result : results)
        decide(result);
    return results;
}

std::string answerOf(const ClaimResult& result) {
    return fmt::format("\u201c{}\u201d: {}{}.", result.claim.name, meaningOf(result),
                       result.why.empty() ? "" : ": " + result.why);
}

std::string groundsOf(const ClaimResult& result) {
    std::string text = foundOf(result);
    std::string method = result.method;
    if (!method.empty())
        method[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(method[0])));
    if (result.test)
        text += fmt::format(
            "{}{}{}, {}, {} after Holm.", method,
            result.test->df ? fmt::format(" = {}", readable(*result.test->statistic)) : "",
            result.people > 0 ? fmt::format(", {} people", result.people) : "",
            pText(result.test->p), pText(result.holm));
    for (const std::string& note : result.notes)
        text += fmt::format("{}Note: {}.", text.empty() ? "" : " ", note);
    return text;
}

std::string sentenceOf(const ClaimResult& result) {
    const std::string grounds = groundsOf(result);
    return answerOf(result) + (grounds.empty() ? "" : " " + grounds);
}

void assignFamilies(std::vector<Tally>& tallies, const std::vector<Claim>& claims) {
    if (claims.empty())
        return;
    for (Tally& tally : tallies) {
        tally.family.clear();
        for (auto claim = claims.rbegin(); claim != claims.rend(); ++claim) {
            const auto& ids = claim->conditions;
            if (claim->kind == Kind::trend ||
                std::find(ids.begin(), ids.end(), tally.condition) == ids.end())
                continue;
            tally.family = claim->name;
            tally.margin = claim->kind == Kind::equivalent ? claim->margin : tally.margin;
        }
    }
}

} // namespace obscura
