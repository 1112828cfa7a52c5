#pragma once

#include "analysis/answers.h"
#include "analysis/votes.h"

#include "inference/paired.h"
#include "inference/result.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
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

// A kind of test: what it asks, who devised it, and how it is done. The terminal, tests.csv and
// the report loop over them.
struct TestKind {
    std::string_view id, question, source;
    std::vector<StudyTest> (*run)(const StudyData&); // none where it does not apply
    // Its results answer one question for several groups of conditions: those of all kinds with
    // that question are corrected together, by Holm.
    bool groups = false;
};
std::span<const TestKind> testKinds();

} // namespace obscura
