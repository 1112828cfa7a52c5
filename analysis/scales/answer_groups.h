#pragma once

#include "analysis/scales/scale_data.h"
#include "analysis/scales/trial_answers.h"

#include <string>
#include <vector>

namespace obscura {

// A study's answers by question, scene and level, and by what is made of them.

// What an answer says, which decides what is made of it.
enum class AnswerForm { comparison, boosted, plain, triad, ladder, rating, versus, rank, none };

struct Observation {
    const AnsweredTrial* trial;
    const Given* given;
    int person;
};

struct AnswerGroup {
    ScaleGroup group; // where; nothing is counted yet
    AnswerForm form;
    std::vector<Observation> members;
};

struct AnswerGroups {
    std::vector<AnswerGroup> groups; // in the protocol's order; those of all scenes last
    std::string pivot;               // the role from which images differ, in triplets
    std::vector<std::string> conditions, techniques; // the protocol's order, or as they first come
    std::vector<std::string> notes;                  // what has no scale, and why
};
AnswerGroups answerGroups(const TrialAnswers& study);

// What the design says of the question; null where it is not known.
const DesignFacts::Asked* askedOf(const AnsweredTrial& trial, const Given& given);

// The role that is the right answer; "" where there is none.
std::string correctOf(const AnsweredTrial& trial);

// 0 where the answer is no number.
double numberOf(const Given& given);

} // namespace obscura
