#pragma once

#include "analysis/answers.h"
#include "protocols/reader/trial_tables.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

template <typename Row>
struct Placed {
    Row row;
    Place place; // file and line
};

// All that one person left in one session.
struct SessionData {
    std::string participant, session;
    bool simulated = false;
    std::string started, endReason; // of the session file; "" where there is none
    std::vector<Placed<Response>> rows;
    std::vector<Placed<PhaseRow>> phases;
    std::vector<Placed<AnswerRow>> answers;

    std::size_t trials() const; // finished ones
};

// A study's folder (experiment/data_folder.h), read whole and checked, so that any export of it can
// be made without further complaint.
struct RecordedStudy {
    std::string study;                 // its name, as the rows have it
    std::string label;                 // of that, the letters and digits; never empty
    std::string description;           // dataset_description.json, an object; "" for none
    int version = 1;                   // of the rows' list of columns
    std::vector<SessionData> sessions; // by participant, then session; each has a trial
    std::vector<std::string> remarks;  // sentences on what was left out
};

// Takes the CSV files of `folder`/data and, of `folder`/sessions, those of phases and answers, with
// each session's start and end. Nothing else in the folder is looked at. Rehearsals and sessions
// without a row are left out; rows of programs among those of people are refused unless `simulated`
// says what to do. Everything that a file name or a join needs is checked: ids are of letters and
// digits, one study, every row_id unique, no two ids that differ in capitals only, an answer's
// phase is there. Errors name file, line and column; `lenient` skips lines that cannot be read.
RecordedStudy readStudy(const std::filesystem::path& folder, SimulatedRows simulated, bool lenient);

} // namespace obscura
