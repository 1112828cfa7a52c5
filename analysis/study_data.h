#pragma once

#include "analysis/answer.h"
#include "analysis/votes.h"

#include "inference/result.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What tests beyond single conditions work on.
struct StudyData {
    std::vector<Tally> tallies;
    const std::vector<Answer>* answers = nullptr; // null for published counts

    // Of each person the first answer to each condition, in the order of the tallies: 1 for b, 0
    // for a, -1 for none.
    std::vector<std::vector<int>> people;
    bool repeats = false; // somebody answered a condition several times
};
StudyData studyData(std::vector<Tally> tallies, const std::vector<Answer>* answers);

// One result.
struct StudyTest {
    std::string about; // which conditions or people
    std::optional<Test> test;
    std::string note; // what to know before believing it; why there is none
};

} // namespace obscura
