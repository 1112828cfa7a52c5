#include "analysis/study_data.h"

#include <cstdint>
#include <unordered_map>
#include <utility>

namespace obscura {

StudyData studyData(std::vector<Tally> tallies, const std::vector<Answer>* answers) {
    StudyData data{std::move(tallies), answers, {}, false};
    if (!answers)
        return data;
    std::unordered_map<std::uint32_t, std::size_t> conditions;
    for (std::size_t i = 0; i < data.tallies.size(); ++i)
        conditions[Symbol(data.tallies[i].condition).number()] = i;
    std::unordered_map<std::uint64_t, std::size_t> people;
    for (const Answer& answer : *answers) {
        const std::size_t person =
            people.try_emplace(answer.row.person(), people.size()).first->second;
        if (person == data.people.size())
            data.people.emplace_back(data.tallies.size(), -1);
        int& first = data.people[person][conditions.at(answer.row.conditionId.number())];
        data.repeats = data.repeats || first >= 0;
        if (first < 0)
            first = answer.row.choseB;
    }
    return data;
}

} // namespace obscura
