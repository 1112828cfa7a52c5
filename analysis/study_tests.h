#pragma once

#include "analysis/study_data.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace obscura {

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

// One result of a kind.
struct Tested {
    const TestKind* kind;
    StudyTest result;
    // Its p, adjusted for the other groups that the same question is asked of; absent where there
    // are none.
    std::optional<double> holm = {};
};
// Every kind of test that applies.
std::vector<Tested> testsOf(const StudyData& data);

} // namespace obscura
