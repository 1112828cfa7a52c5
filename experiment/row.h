#pragma once

#include "experiment/ledger.h"
#include "experiment/observer.h"
#include "experiment/recorder.h"
#include "experiment/selection.h"
#include "experiment/study.h"
#include "experiment/trial.h"
#include "protocols/reader/responses.h"

#include <optional>
#include <string>
#include <string_view>

namespace obscura {

// What holds for all of a session's trials.
struct Context {
    const Study& study;
    const SessionId& session;
    const Assignment& assignment;
    const Refresh& refresh;
    std::string designSha256; // of Study::design()
};

// Where in the phases of a trial of a and b the columns of a pair come from: image 1, at once a
// locked grey, at once image 2, and a choice between the two without a third option. None in other
// trials, which have no such rows.
struct PairPhases {
    std::size_t first = 0, mask = 0, second = 0, question = 0;
    std::size_t answer = 0; // among those of the trial
};
std::optional<PairPhases> pairPhasesOf(const Trial& trial);

// A trial's outcome as the row that is kept of a pair.
Response makeRow(const Context& context, const Upcoming& trial, const TrialRecord& record,
                 const PairPhases& pair);

// The roles that an answer about images means: of the one chosen, or of those ranked, best first
// ("b>a"); "" for other answers.
std::string rolesIn(const Question& question, const std::string& value,
                    const std::vector<std::string>& order);

// The same as lines of all tables.
TrialLines linesOf(const Context& context, const Upcoming& trial, const TrialRecord& record);
// And of a page before or after the trials, `kind`: their trial's number is 0, its kind this.
TrialLines linesOf(const Context& context, std::string_view kind, const Phase& page,
                   const TrialRecord& record);
// Of one of its questions alone, from 0.
std::string answerLineOf(const Context& context, std::string_view kind, const Phase& page,
                         const TrialRecord& record, std::size_t question);

} // namespace obscura
