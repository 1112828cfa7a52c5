#pragma once

#include "analysis/answers.h"
#include "protocols/reader/design_facts.h"

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// Trials that are no pairs, from sessions/*_answers.csv (trial_tables.h), under the rules of
// answers.h.

// What was answered to one question of a trial.
struct Given {
    Symbol question, kind; // kind: as protocols spell it
    Symbol value, role;    // "" for a question left open
    int line = 0;
};

// One trial. As a vote it has who, when and which condition; what only pairs have is empty there.
struct AnsweredTrial {
    Answer trial;
    std::vector<std::string> roles, techniques; // by place
    std::vector<Given> given;
    const DesignFacts* design = nullptr; // of its study's folder; null where none lies there

    // The technique that a role had; "" where nobody knows.
    std::string techniqueOf(const std::string& role) const;
};

struct TrialAnswers {
    Answers answers;                     // a row for each trial: for conductOf()
    std::vector<AnsweredTrial> trials;   // that count
    std::vector<AnsweredTrial> excluded; // by rules and reasons (exclusions.h)
    // Not every trial is a choice between a and b, so that declared exclusions which ask for that
    // (catch trials, one position) were not applied.
    bool isChoice = false;
    std::map<std::string, std::shared_ptr<const DesignFacts>> designs; // by folder
};

// Whether `data` are such trials: folders without rows of pairs that have tables of answers, or
// such tables. Both kinds together are an Error.
bool isTrialData(std::span<const std::filesystem::path> data);

// Errors name file, line and column. At least one trial must be left to count.
TrialAnswers collectTrials(std::span<const std::filesystem::path> data, const AnswerRules& rules);

} // namespace obscura
