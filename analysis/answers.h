#pragma once

#include "analysis/answer.h"
#include "analysis/exclusions.h"

#include <filesystem>
#include <span>
#include <vector>

namespace obscura {

// Gathers the rows of a study and makes sure that they belong together. Whatever does not is an
// Error naming two rows that disagree, unless the rules ask for it; nothing is left out in silence.

enum class SimulatedRows { refuse, exclude, only, include };

struct AnswerRules {
    // Rows of programs among rows of people. `refuse` accepts files that are all of one kind.
    SimulatedRows simulated = SimulatedRows::refuse;
    bool mixedStudies = false;   // pool several study_id
    bool mixedProtocols = false; // pool several designs of one study
    bool duplicates = false;     // count the first of rows for one trial, leave out the others
    // A trial during which the window lost the screen was still answered: it is counted and
    // reported, unless this is false.
    bool interrupted = true;
    bool lenient = false; // skip rows that cannot be read
    std::filesystem::path excluded =
        {}; // a file that names rows not to count (exclude()); "": none
};

struct LeftOut {
    int practice = 0, catches = 0, interrupted = 0, duplicates = 0;
    int simulated = 0, real = 0, rehearsed = 0;
};

struct Answers {
    std::vector<Answer> counted;   // main trials, in the order of files and lines
    Excluded excluded;             // main trials that do not count
    Declared declared;             // where a study's folder keeps its design
    std::vector<SlotRecord> slots; // every line of its ledger
    LeftOut leftOut;
    std::vector<BadRow> bad; // skipped because of `lenient`
    int files = 0;
    int earlierFiles = 0; // of those, in the format of an earlier version
};

// `data`: CSV files, or folders of them (a study's folder with its data/ in it). At least one row
// must be left to count. A design whose hash is none of the rows' is an Error, and so are several
// that claim or exclude differently, unless mixed ones are allowed: then nothing counts as
// declared.
Answers collectAnswers(std::span<const std::filesystem::path> data, const AnswerRules& rules);

// The rules alone, for trials from another table than that of pairs: those of `answers.counted`
// that count stay. `data` as above.
struct TableForm {
    int (*columnNumber)(std::string_view); // of a column in that table, for errors
    bool isChoice = true; // rows say which of a and b was chosen; else what asks for that is off
};
void applyRules(Answers& answers, std::span<const std::filesystem::path> data,
                const AnswerRules& rules, const TableForm& form);

// With Latin letters in lower case: names that differ in no more are one person's, written twice.
std::string folded(std::string text);

} // namespace obscura
