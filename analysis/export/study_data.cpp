#include "analysis/export/study_data.h"

#include "analysis/answers.h"
#include "base/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <typeinfo>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longestId = 32; // as the presenter has it

bool isAlphanumeric(char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

bool isId(const std::string& id) {
    return !id.empty() && id.size() <= longestId &&
           std::all_of(id.begin(), id.end(), isAlphanumeric);
}

const Response& keyOf(const Response& row) { return row; }
const TrialKey& keyOf(const PhaseRow& row) { return row.trial; }
const TrialKey& keyOf(const AnswerRow& row) { return row.trial; }

class Reader {
  public:
    Reader(const fs::path& folder, bool lenient) : folder_(folder), lenient_(lenient) {}

    RecordedStudy read(SimulatedRows simulated) {
        for (const fs::path& file : files("data", ".csv"))
            add(file, readResponses(file, lenient_), &SessionData::rows);
        for (const fs::path& file : files("sessions", "_phases.csv"))
            add(file, readPhases(file, lenient_), &SessionData::phases);
        for (const fs::path& file : files("sessions", "_answers.csv"))
            add(file, readAnswers(file, lenient_), &SessionData::answers);
        remark(rehearsed_, "row(s) of rehearsals were left out");
        remark(empty_, "table(s) without a row were left out: somebody came and left");
        if (sessions_.empty())
            throw Error({folder_.string(), 0, 0, {}},
                        "expected the data of a study, with data/ or sessions/ in it, found no row "
                        "that counts");
        select(simulated);
        checkSpelling();
        for (SessionData& session : data_.sessions)
            finish(session);
        return std::move(data_);
    }

  private:
    // Sorted. A link is followed; one that leads nowhere is not passed over.
    std::vector<fs::path> files(const char* part, const std::string& ending) const {
        std::vector<fs::path> found;
        if (!fs::is_directory(folder_ / part))
            return found;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / part)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with('.') || !name.ends_with(ending))
                continue;
            if (!entry.is_regular_file())
                throw Error({entry.path().string(), 0, 0, {}},
                            "expected a file, found a folder, or a link that leads to none; put "
                            "the file there, or remove it");
            found.push_back(entry.path());
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    template <typename Table, typename Row>
    void add(const fs::path& file, Table table, std::vector<Placed<Row>> SessionData::*list) {
        for (const BadRow& bad : table.bad)
            data_.remarks.push_back(fmt::format("skipped: {}{}", bad.place.prefix(), bad.message));
        if constexpr (std::is_same_v<Row, Response>)
            data_.version = std::max(data_.version, table.version);
        empty_ += table.rows.empty() && table.bad.empty();
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            add(std::move(table.rows[i]), {file.string(), table.lines[i], 0, {}}, list);
    }

    template <typename Row>
    void add(Row row, const Place& place, std::vector<Placed<Row>> SessionData::*list) {
        const auto& key = keyOf(row);
        check(key, place, rowIds_[typeid(Row).name()]);
        if (key.rehearsal) {
            ++rehearsed_;
            return;
        }
        const auto [session, isNew] =
            sessions_.try_emplace(std::pair(key.participantId, key.sessionId));
        SessionData& data = session->second;
        if (isNew) {
            data.participant = key.participantId;
            data.session = key.sessionId;
            data.simulated = key.simulated;
        }
        if (data.simulated != key.simulated)
            refuse(place, "simulated",
                   fmt::format("expected {:d} as in other rows of {}, session {}, found {:d}",
                               data.simulated, data.participant, data.session, key.simulated));
        (data.*list).push_back({std::move(row), place});
    }

    template <typename Key>
    void check(const Key& key, const Place& place, std::map<std::string, Place>& rowIds) {
        if (!isId(key.participantId))
            refuse(place, "participant_id", idFault(key.participantId));
        if (!isId(key.sessionId))
            refuse(place, "session_id", idFault(key.sessionId));
        if (data_.study.empty())
            data_.study = key.studyId;
        if (key.studyId != data_.study)
            refuse(place, "study_id",
                   fmt::format("expected \"{}\" as in the rows before, found \"{}\"; an export is "
                               "of one study",
                               data_.study, key.studyId));
        const auto [first, isNew] = rowIds.try_emplace(key.rowId, place);
        if (!isNew)
            refuse(place, "row_id",
                   fmt::format("{} stands in {}:{} already; remove one of the files, or rows",
                               key.rowId, first->second.file, first->second.line));
    }

    static std::string idFault(const std::string& id) {
        return fmt::format("expected 1 to {} letters (a-z) and digits, found \"{:.40}\"", longestId,
                           id);
    }

    [[noreturn]] static void refuse(Place place, const char* column, const std::string& why) {
        place.key = column;
        throw Error(place, why);
    }

    void remark(std::size_t count, const char* rest) {
        if (count > 0)
            data_.remarks.push_back(fmt::format("{} {}", count, rest));
    }

    void select(SimulatedRows rule) {
        int real = 0, simulated = 0;
        for (const auto& [key, session] : sessions_)
            ++(session.simulated ? simulated : real);
        if (rule == SimulatedRows::refuse && real > 0 && simulated > 0)
            throw Error({folder_.string(), 0, 0, "simulated"},
                        fmt::format("{} simulated session(s) among {} of people; --simulated "
                                    "exclude leaves them out, only exports nothing else, include "
                                    "exports both, told apart by the column simulated",
                                    simulated, real));
        for (auto& [key, session] : sessions_)
            if ((rule != SimulatedRows::exclude || !session.simulated) &&
                (rule != SimulatedRows::only || session.simulated))
                data_.sessions.push_back(std::move(session));
        remark(sessions_.size() - data_.sessions.size(),
               "session(s) were left out, as --simulated says");
        if (data_.sessions.empty())
            throw Error({folder_.string(), 0, 0, "simulated"},
                        "expected a session that --simulated lets through, found none");
    }

    // Names that differ in capitals only are one file on some systems, and mostly one person.
    void checkSpelling() const {
        std::map<std::string, std::string> seen;
        for (const SessionData& session : data_.sessions)
            for (const std::string& id :
                 {session.participant, session.participant + "-" + session.session}) {
                const auto [first, isNew] = seen.try_emplace(folded(id), id);
                if (first->second != id)
                    throw Error(
                        {folder_.string(), 0, 0, "participant_id"},
                        fmt::format("found both \"{}\" and \"{}\", which differ in capitals "
                                    "only; write them one way, or with more between them",
                                    first->second, id));
            }
    }

    void finish(SessionData& session) const {
        std::set<std::pair<int, std::string>> phases;
        for (const auto& [row, place] : session.phases)
            phases.emplace(row.trial.trialIndex, row.phase);
        for (const auto& [row, place] : session.answers)
            if (!phases.count({row.trial.trialIndex, row.phase}))
                refuse(place, "phase",
                       fmt::format("the table of phases has none named \"{}\" of trial {}; if the "
                                   "session broke off, start obscura-experiment for this study "
                                   "once: it completes the tables from the journal",
                                   row.phase, row.trial.trialIndex));
        readCircumstances(session);
    }

    void readCircumstances(SessionData& session) const {
        const std::string ending = fmt::format("_subject-{}_session-{}_session.json",
                                               session.participant, session.session);
        for (const fs::path& file : files("sessions", ending)) {
            const auto json = nlohmann::json::parse(readFile(file), nullptr, false);
            if (!json.is_object())
                throw Error({file.string(), 0, 0, {}},
                            "expected a JSON object, found another text; put back a copy, or "
                            "remove the file");
            const auto text = [&](const char* key) {
                return json.contains(key) && json[key].is_string() ? json[key].get<std::string>()
                                                                   : std::string();
            };
            session.started = text("started");
            session.endReason = text("end_reason");
        }
    }

    fs::path folder_;
    bool lenient_;
    RecordedStudy data_;
    std::map<std::pair<std::string, std::string>, SessionData> sessions_;
    std::map<std::string, std::map<std::string, Place>> rowIds_; // of each kind of table
    std::size_t rehearsed_ = 0, empty_ = 0;
};

} // namespace

std::size_t SessionData::trials() const {
    std::set<int> indices;
    for (const auto& [row, place] : rows)
        indices.insert(row.trialIndex);
    for (const auto& [row, place] : phases)
        indices.insert(row.trial.trialIndex);
    indices.erase(0); // pages around the trials
    return indices.size();
}

RecordedStudy readStudy(const fs::path& folder, SimulatedRows simulated, bool lenient) {
    if (!fs::is_directory(folder))
        throw Error({folder.string(), 0, 0, {}},
                    "expected a study's folder (participant_data/<study>), found none");
    RecordedStudy data = Reader(folder, lenient).read(simulated);
    std::copy_if(data.study.begin(), data.study.end(), std::back_inserter(data.label),
                 isAlphanumeric);
    if (data.label.empty())
        throw Error({folder.string(), 0, 0, "study_id"},
                    fmt::format("expected a name with a letter (a-z) or digit, of which the names "
                                "of files are made, found \"{}\"",
                                data.study));
    if (const fs::path file = folder / "dataset_description.json"; fs::exists(file)) {
        data.description = readFile(file);
        if (!nlohmann::json::parse(data.description, nullptr, false).is_object())
            throw Error({file.string(), 0, 0, {}},
                        "expected a JSON object, found another text; mend it, or put back a copy");
    }
    return data;
}

} // namespace obscura
