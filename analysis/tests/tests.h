#pragma once

#include "analysis/study_data.h"

#include "inference/paired.h"

#include <cstddef>
#include <string>
#include <vector>

namespace obscura {

// The functions of the rows of testKinds(), by subject. Each gives nothing where its question does
// not arise, and a result without a test, with the reason, where it cannot be answered.

// Complexity (complexity.cpp): conditions that compare the same two techniques at several levels.
std::vector<StudyTest> cochranTests(const StudyData& data);     // three or more
std::vector<StudyTest> mcNemarTests(const StudyData& data);     // two
std::vector<StudyTest> levelTrendTests(const StudyData& data);  // three or more, in order
std::vector<StudyTest> homogeneityTests(const StudyData& data); // of published counts
std::vector<StudyTest> totalsTrendTests(const StudyData& data); // the same

// Order (position.cpp).
std::vector<StudyTest> pooledPositionTests(const StudyData& data);
std::vector<StudyTest> personPositionTests(const StudyData& data);
std::vector<StudyTest> conditionPositionTests(const StudyData& data);

// People (people.cpp).
std::vector<StudyTest> varianceTests(const StudyData& data);
std::vector<StudyTest> repeatTests(const StudyData& data);          // all together
std::vector<StudyTest> conditionRepeatTests(const StudyData& data); // each condition

// Models of all answers (models.cpp).
std::vector<StudyTest> logisticTests(const StudyData& data);
std::vector<StudyTest> geeTests(const StudyData& data);
std::vector<StudyTest> mixedTests(const StudyData& data);

// Pieces that they share (complexity.cpp).
// Conditions, by their places among the tallies.
using Group = std::vector<std::size_t>;

// The answers of those people who answered all conditions of the group, and how many did not.
AnswerTable completeOf(const StudyData& data, const Group& group);
std::string leftOut(const StudyData& data, const AnswerTable& complete);

// Those that are not "", with semicolons.
std::string joined(const std::vector<std::string>& notes);

} // namespace obscura
