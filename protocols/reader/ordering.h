#pragma once

#include "protocols/reader/trial.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// [ordering]: who sees which conditions in which order, and what else comes between them. The
// schemes are in experiment/schedule.h, with their sources.
enum class OrderScheme { thesis, latin, williams, shuffle, listed, staircase, quest, information };

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

// QUEST+ (inference/quest_plus.h), and pairs by expected variance (inference/pair_choice.h).
struct Adaptive {
    int trials = 100; // main trials that end the session at the latest
    // That of the widest 95 % interval, at which it ends earlier: of quest the threshold's, in
    // units of the scores, of information an image's, in JOD. 0: none does.
    double width = 0;
    std::string answer = "choice"; // the question by whose answers it goes
    // Of quest: a number for each condition of main trials, in the order of the file; right answers
    // become likelier as it rises. No two are the same.
    std::vector<double> scores;
    double guess = 0.5; // of quest: the share of right answers where nothing is seen, 0 to 0.9
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
    Adaptive adaptive;                  // of quest and information alone
};

// Main trials at the latest, of a scheme that goes by the answers; 0 for those that do not.
int adaptiveTrials(const Ordering& ordering);

// What an order needs to know of a condition.
struct ConditionLabels {
    std::string id, scene, level;
    std::string correct; // the right answer; "" where there is none
    // Techniques of the images that the trial's `order` names, as it names them.
    std::vector<std::string> shown;
};

// Of a study that has these conditions, in the order of the file, and a trial with these questions.
// An Error with file, line and column also where no session could be as asked.
Ordering parseOrdering(TomlTable& table, const std::vector<ConditionLabels>& conditions,
                       const std::vector<Question>& questions);

} // namespace obscura
