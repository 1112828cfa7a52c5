#pragma once

#include "experiment/ledger.h"
#include "protocols/reader/protocol.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace obscura {

// Where a study's data lie, as Psych-DS wants it:
//
//   <data>/<study>/dataset_description.json   what the columns mean
//   <data>/<study>/README.md
//   <data>/<study>/.psychdsignore             sessions/, which Psych-DS does not know
//   <data>/<study>/data/study-<study>_subject-<id>_session-<n>_data.csv   one row per trial
//   <data>/<study>/sessions/study-..._phases.csv      one row per phase of a trial
//   <data>/<study>/sessions/study-..._answers.csv     one row per question
//   <data>/<study>/sessions/study-..._journal.jsonl   what began and ended when
//   <data>/<study>/sessions/study-..._session.json    display, order, how the session went
//   <data>/<study>/sessions/ledger.jsonl              who has which slot
//   <data>/<study>/sessions/design.json               what all of them were shown
//
// and, apart from them, so that nothing counts them: <data>/rehearsals/<study>/ with the same in
// it but ledger and design.
class DataFolder {
  public:
    DataFolder(const std::filesystem::path& data, const Protocol& protocol,
               bool rehearsals = false);

    // Makes the folders, the description, the README and .psychdsignore where they are missing;
    // adds to a description of an earlier version the columns that came later. An Error when a
    // description is there that speaks of other columns.
    void prepare() const;

    const std::filesystem::path& path() const { return root_; }

    std::filesystem::path rows(const SessionId& session) const;
    std::filesystem::path phases(const SessionId& session) const;
    std::filesystem::path answers(const SessionId& session) const;
    std::filesystem::path journal(const SessionId& session) const;
    std::filesystem::path sidecar(const SessionId& session) const;
    std::filesystem::path ledger() const;
    std::filesystem::path design() const;

  private:
    std::string stem(const SessionId& session) const;

    std::filesystem::path root_;
    std::string study_, title_;
};

// Why the session cannot be run under this name: not letters and digits, or there are data already.
// "" when it can.
std::string objection(const DataFolder& folder, const SessionId& session);

bool isParticipantId(const std::string& id); // short, of letters and digits

} // namespace obscura
