#include "analysis/tests/tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

namespace obscura {

std::vector<StudyTest> pooledPositionTests(const StudyData& data) {
    if (!data.answers)
        return {};
    Votes votes;
    for (const Answer& answer : *data.answers)
        ++(answer.row.choseSecond() ? votes.b : votes.a);
    return {{fmt::format("{} of {} votes are for the second picture", votes.b, votes.total()),
             Test{std::nullopt, std::nullopt, exactP(votes)},
             "takes every vote for another person's: trust the test by person"}};
}

std::vector<StudyTest> personPositionTests(const StudyData& data) {
    if (!data.answers)
        return {};
    std::unordered_map<std::uint64_t, Votes> votes;
    for (const Answer& answer : *data.answers) {
        Votes& person = votes[answer.row.person()];
        ++(answer.row.choseSecond() ? person.b : person.a);
    }
    std::vector<double> shares;
    double sum = 0;
    for (const auto& [person, v] : votes) {
        shares.push_back(static_cast<double>(v.b) / static_cast<double>(v.total()));
        sum += shares.back();
    }
    std::sort(shares.begin(), shares.end()); // the order of a hash table is nobody's
    return {{fmt::format("{:.1f} % of a person's votes on average, {} people",
                         100 * sum / static_cast<double>(shares.size()), shares.size()),
             tTest(shares, 0.5), ""}};
}

std::vector<StudyTest> conditionPositionTests(const StudyData& data) {
    if (!data.answers)
        return {};
    std::unordered_map<std::uint32_t, FourfoldTable> strata;
    for (const Answer& answer : *data.answers) {
        FourfoldTable& stratum = strata[answer.row.conditionId.number()];
        Votes& votes = answer.row.aFirst ? stratum.first : stratum.second;
        ++(answer.row.choseB ? votes.b : votes.a);
    }
    std::map<std::uint32_t, FourfoldTable> ordered(strata.begin(), strata.end());
    std::vector<FourfoldTable> tables;
    for (const auto& [condition, table] : ordered)
        tables.push_back(table);
    const auto result = mantelHaenszel(tables);
    const bool odds = result && result->logOddsRatio;
    return {{odds ? fmt::format("the odds of b are {:.2f} times as high when it is second",
                                std::exp(result->logOddsRatio->value))
                  : "the odds of b when it is second",
             result ? std::optional(result->test) : std::nullopt, ""}};
}

} // namespace obscura
