#include "analysis/people.h"

#include "analysis/verdict.h"
#include "base/percentile.h"

#include "inference/agreement.h"
#include "inference/multiplicity.h"
#include "inference/person_rows.h"
#include "inference/tails.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <unordered_map>

namespace obscura {

namespace {

using Rows = std::span<const Eigen::Index>; // of one person, among the answers

constexpr std::size_t mostModelled = 100'000; // answers of the observers' model
constexpr double mostWork = 1e8;              // people times squared conditions

// Each answer's person, from 0 in the order of first answers.
std::vector<int> numbered(const std::vector<Answer>& answers) {
    std::unordered_map<std::uint64_t, int> numbers;
    std::vector<int> persons;
    persons.reserve(answers.size());
    for (const Answer& answer : answers)
        persons.push_back(numbers.try_emplace(answer.row.person(), static_cast<int>(numbers.size()))
                              .first->second);
    return persons;
}

template <auto field>
double medianOf(const std::vector<Answer>& answers, Rows rows) {
    std::vector<double> values;
    for (const Eigen::Index row : rows)
        values.push_back(answers[static_cast<std::size_t>(row)].row.*field);
    return percentile(std::move(values), 0.5);
}

// Pairs of answers to one condition.
Votes repeatsOf(const std::vector<Answer>& answers, Rows rows) {
    std::vector<std::pair<std::uint32_t, bool>> chosen;
    for (const Eigen::Index row : rows) {
        const Vote& vote = answers[static_cast<std::size_t>(row)].row;
        chosen.emplace_back(vote.conditionId.number(), vote.choseB);
    }
    std::sort(chosen.begin(), chosen.end());
    std::vector<Votes> cells;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (i == 0 || chosen[i].first != chosen[i - 1].first)
            cells.emplace_back();
        ++(chosen[i].second ? cells.back().b : cells.back().a);
    }
    return repeatAgreement(cells);
}

int sessionsOf(const std::vector<Answer>& answers, Rows rows) {
    std::set<std::uint32_t> sessions;
    std::optional<std::uint32_t> above; // most rows have the session of the row above
    for (const Eigen::Index row : rows) {
        const std::uint32_t session = answers[static_cast<std::size_t>(row)].row.sessionId.number();
        if (session != above)
            sessions.insert(session);
        above = session;
    }
    return static_cast<int>(sessions.size());
}

Person personOf(const std::vector<Answer>& answers, Rows rows, const std::vector<bool>& flagged) {
    const Vote& any = answers[static_cast<std::size_t>(rows.front())].row;
    Person person;
    person.study = any.studyId;
    person.participant = any.participantId;
    person.sessions = sessionsOf(answers, rows);
    for (const Eigen::Index row : rows) {
        const auto at = static_cast<std::size_t>(row);
        ++(answers[at].row.choseSecond() ? person.places.b : person.places.a);
        person.flaggedTimes += flagged[at];
    }
    person.p = exactP(person.places);
    person.repeats = repeatsOf(answers, rows);
    person.view1Ms = medianOf<&Vote::view1Ms>(answers, rows);
    person.view2Ms = medianOf<&Vote::view2Ms>(answers, rows);
    person.decisionMs = medianOf<&Vote::decisionRtMs>(answers, rows);
    return person;
}

// All conditions as one scale: item 0 stands for the a of each, so that every condition has a
// distance of its own and all of them tell of the same observers.
std::vector<Choice> choicesOf(const std::vector<Answer>& answers, const std::vector<Tally>& tallies,
                              const std::vector<int>& person) {
    std::unordered_map<std::uint32_t, int> items;
    for (std::size_t i = 0; i < tallies.size(); ++i)
        items[Symbol(tallies[i].condition).number()] = static_cast<int>(i) + 1;
    std::vector<Choice> choices;
    choices.reserve(answers.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const Vote& row = answers[i].row;
        const int b = items.at(row.conditionId.number());
        choices.push_back({person[i], row.aFirst ? 0 : b, row.aFirst ? b : 0, !row.choseSecond()});
    }
    return choices;
}

EstimatedShare shareOf(const ObserverModel& model, Eigen::Index item) {
    const double distance = model.scale.values(item) - model.scale.values(0);
    const Eigen::MatrixXd& c = model.scale.covariance;
    const double reach = probit(0.975) * std::sqrt(c(item, item) + c(0, 0) - 2 * c(item, 0));
    const auto share = [](double logit) { return 1 / (1 + std::exp(-logit)); };
    return {share(distance),
            {share(distance - reach), share(distance + reach)},
            normalP(distance / reach * probit(0.975))};
}

void addObservers(const std::vector<Answer>& answers, const std::vector<Tally>& tallies,
                  const std::vector<int>& person, People& people) {
    const auto conditions = static_cast<double>(tallies.size());
    if (answers.size() > mostModelled ||
        static_cast<double>(people.persons.size()) * conditions * conditions > mostWork)
        return;
    // Conditions without votes would belong to no scale.
    std::vector<Tally> voted;
    for (const Tally& tally : tallies)
        if (tally.votes.total() > 0)
            voted.push_back(tally);
    const auto model =
        observerModel(static_cast<int>(voted.size()) + 1, static_cast<int>(people.persons.size()),
                      choicesOf(answers, voted, person));
    if (!model)
        return;
    for (std::size_t i = 0; i < people.persons.size(); ++i)
        people.persons[i].observer = model->observers[i];
    Eigen::Index item = 0;
    for (const Tally& tally : tallies)
        people.observers.push_back(tally.votes.total() > 0 ? std::optional(shareOf(*model, ++item))
                                                           : std::nullopt);
}

} // namespace

std::vector<std::string> flagsOf(const Person& person) {
    std::vector<std::string> flags;
    if (person.holm < significance)
        flags.emplace_back("position");
    if (person.repeats.total() >= 5 && person.repeats.b <= person.repeats.a)
        flags.emplace_back("repeats");
    if (person.flaggedTimes > 0 && 5 * person.flaggedTimes >= person.trials())
        flags.emplace_back("times");
    return flags;
}

People peopleOf(const std::vector<Answer>& answers, const std::vector<Tally>& tallies) {
    People people;
    people.times = responseTimes(answers, tallies);
    const std::vector<int> person = numbered(answers);
    const PersonOrder order = orderByPerson(person, static_cast<Eigen::Index>(answers.size()));
    std::vector<double> p;
    for (std::size_t i = 0; i + 1 < order.first.size(); ++i) {
        const Rows rows =
            Rows(order.rows)
                .subspan(static_cast<std::size_t>(order.first[i]),
                         static_cast<std::size_t>(order.first[i + 1] - order.first[i]));
        people.persons.push_back(personOf(answers, rows, people.times.isFlagged));
        p.push_back(people.persons.back().p);
    }
    const std::vector<double> adjustedP = holm(p);
    for (std::size_t i = 0; i < adjustedP.size(); ++i)
        people.persons[i].holm = adjustedP[i];
    addObservers(answers, tallies, person, people);
    return people;
}

} // namespace obscura
