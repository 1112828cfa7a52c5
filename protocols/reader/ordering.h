#pragma once

#include "protocols/reader/trial.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// [ordering]: who sees which conditions in which order, and what else comes between them. The
// schemes are in experiment/schedule.h, with their sources.
enum class OrderScheme { thesis, latin, williams, shuffle, listed, staircase };

// Their spellings, in the order of the enumeration.
const std::vector<std::string>& orderSchemeNames();

// In what two conditions can be alike.
enum class Likeness { scene, level, condition };
const std::vector<std::string>& likenessNames();

// Up and down a ladder of conditions, the easiest listed first (Levitt 1971).
struct Staircase {
    int down = 2;                  // right answers in a row that lead to the next, harder condition
    int up = 1;                    // wrong ones that lead back
    int reversals = 8;             // changes of direction that end the session
    int trials = 100;              // that end it at the latest
    std::string answer = "choice"; // that the condition's `correct` is compared with
};

struct Ordering {
    OrderScheme scheme = OrderScheme::williams;
    int participants = 28;          // planned; what --simulate runs when no number is given
    int resumeMinutes = 60;         // after which nobody goes on with a session that broke off
    int repeats = 1;                // presentations of each condition to each participant
    std::optional<Likeness> blocks; // trials alike in this (scene or level) follow one another
    std::optional<Likeness> apart;  // trials of a block that are alike in this never do
    std::vector<std::string> practice, catches; // ids; these conditions are shown as nothing else
    int catchEvery = 0, breakEvery = 0; // after so many main trials, except the last; 0: never
    Staircase staircase;                // of that scheme alone
};

// What an order needs to know of a condition.
struct ConditionLabels {
    std::string id, scene, level;
    std::string correct; // the right answer; "" where there is none
};

// Of a study that has these conditions, in the order of the file, and a trial with these questions.
// An Error with file, line and column also where no session could be as asked.
Ordering parseOrdering(TomlTable& table, const std::vector<ConditionLabels>& conditions,
                       const std::vector<Question>& questions);

} // namespace obscura
