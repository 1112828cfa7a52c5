#include "analysis/export/formats.h"
#include "analysis/export/table.h"
#include "base/files.h"
#include "base/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace obscura {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

// What a column means, in BIDS' words.
ordered_json described(const TableColumn& column) {
    std::string longName = column.name;
    std::replace(longName.begin(), longName.end(), '_', ' ');
    ordered_json json = {{"LongName", longName}, {"Description", column.description}};
    if (column.expected == "0 or 1")
        json["Levels"] = {{"0", "no"}, {"1", "yes"}};
    if (column.expected == "a or b")
        json["Levels"] = {{"a", "member a"}, {"b", "member b"}};
    if (column.name.ends_with("_ms"))
        json["Units"] = "ms";
    if (column.name.ends_with("_hz"))
        json["Units"] = "Hz";
    if (column.expected == "seconds")
        json["Units"] = "s";
    return json;
}

ordered_json sidecar(const ExportTable& table) {
    ordered_json json = ordered_json::object();
    for (const TableColumn& column : table.columns)
        json[column.name] = described(column);
    return json;
}

// Columns of one long table by name.
class CellsOfRow {
  public:
    explicit CellsOfRow(const ExportTable& table) {
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            index_[table.columns[i].name] = i;
    }
    std::string of(const std::vector<std::string>& row, const std::string& column) const {
        const auto found = index_.find(column);
        return found == index_.end() ? std::string() : row[found->second];
    }

  private:
    std::map<std::string, std::size_t> index_;
};

std::string bidsSeconds(double milliseconds) { return fmt::format("{:.6f}", milliseconds / 1000); }

bool isOfTheFile(const std::string& column) { // the same in all of a file's lines, or in seconds
    const std::set<std::string> names = {
        "schema_version", "study_id",   "participant_id",  "session_id",    "simulated",
        "rehearsal",      "slot_id",    "onset_ms",        "view_ms",       "response_ms",
        "app_version",    "git_commit", "protocol_sha256", "design_sha256", "machine_id"};
    return names.count(column) > 0;
}

// Phases, and answers at the instant at which they were given, by time.
class Events {
  public:
    Events(const SessionData& session, bool withStimuli)
        : session_(session), withStimuli_(withStimuli), phases_(tableOf(session.phases)),
          answers_(tableOf(session.answers)) {
        table_.columns = {
            {"onset", "Onset on the session's clock, which starts with the program's window",
             "seconds"},
            {"duration", "How long the phase was on view; 0 for an answer", "seconds"},
            {"trial_type", "phase; image, for each of several that a phase has on view; or answer",
             "text"},
            {"response_time", "From the onset of the question's page to the answer", "seconds"}};
        if (withStimuli)
            table_.columns.push_back(
                {"stim_file",
                 "The image on view, in stimuli/; n/a for a phase that has none or several",
                 "text"});
        for (const ExportTable& table : {phases_, answers_})
            for (const TableColumn& column : table.columns)
                if (!isOfTheFile(column.name) && !isKnown(column.name))
                    table_.columns.push_back(column);
        addPhases();
        addAnswers();
        std::stable_sort(order_.begin(), order_.end(),
                         [](const auto& x, const auto& y) { return x.first < y.first; });
        for (auto& [onset, row] : order_)
            table_.rows.push_back(std::move(row));
    }

    const ExportTable& table() const { return table_; }

  private:
    bool isKnown(const std::string& name) const {
        return std::any_of(table_.columns.begin(), table_.columns.end(),
                           [&](const TableColumn& column) { return column.name == name; });
    }

    void addPhases() {
        const CellsOfRow cells(phases_);
        for (std::size_t i = 0; i < phases_.rows.size(); ++i) {
            const PhaseRow& row = session_.phases[i].row;
            const std::vector<std::string> files = split(row.files, '+');
            const auto event = [&](const char* type, const std::string& file,
                                   const CellsOfRow& of) {
                std::vector<std::string> begin = {bidsSeconds(row.onsetMs), bidsSeconds(row.viewMs),
                                                  type, ""};
                if (withStimuli_)
                    begin.push_back(file);
                add(row.onsetMs, std::move(begin), of, phases_.rows[i]);
            };
            event("phase", files.size() == 1 ? files.front() : "", cells);
            if (withStimuli_ && files.size() > 1)
                for (const std::string& file : files)
                    event("image", file, cells);
        }
    }

    void addAnswers() {
        std::map<std::pair<int, std::string>, double> onsets;
        for (const auto& [row, place] : session_.phases)
            onsets[{row.trial.trialIndex, row.phase}] = row.onsetMs;
        const CellsOfRow cells(answers_);
        for (std::size_t i = 0; i < answers_.rows.size(); ++i) {
            const AnswerRow& row = session_.answers[i].row;
            const double onset = onsets.at({row.trial.trialIndex, row.phase}) + row.responseMs;
            std::vector<std::string> begin = {bidsSeconds(onset), bidsSeconds(0), "answer",
                                              bidsSeconds(row.responseMs)};
            if (withStimuli_)
                begin.emplace_back();
            add(onset, std::move(begin), cells, answers_.rows[i]);
        }
    }

    void add(double onset, std::vector<std::string> row, const CellsOfRow& cells,
             const std::vector<std::string>& from) {
        for (std::size_t i = row.size(); i < table_.columns.size(); ++i)
            row.push_back(cells.of(from, table_.columns[i].name));
        order_.emplace_back(onset, std::move(row));
    }

    const SessionData& session_;
    bool withStimuli_;
    ExportTable phases_, answers_, table_;
    std::vector<std::pair<double, std::vector<std::string>>> order_;
};

// The images that a session's rows name, by path, with their hash.
class Images {
  public:
    explicit Images(fs::path folder) : folder_(std::move(folder)) {}

    void add(const SessionData& session) {
        for (const auto& [row, place] : session.phases) {
            const std::vector<std::string> files = split(row.files, '+'),
                                           hashes = split(row.sha256, '+');
            if (files.size() != hashes.size())
                throw Error({place.file, place.line, 0, "sha256"},
                            fmt::format("expected {} hash(es), of {}, found {}", files.size(),
                                        row.files, hashes.size()));
            for (std::size_t i = 0; i < files.size(); ++i)
                add(files[i], hashes[i], place);
        }
    }

    const std::map<std::string, std::string>& hashes() const { return hashes_; }

  private:
    void add(const std::string& file, const std::string& hash, Place place) {
        place.key = "files";
        const fs::path path = fs::path(file).lexically_normal();
        if (path.is_absolute() || path != file || *path.begin() == "..")
            throw Error(place,
                        fmt::format("expected a file of the stimuli's folder, found \"{}\"", file));
        if (const auto [known, isNew] = hashes_.try_emplace(file); isNew)
            known->second = sha256File(folder_ / path);
        if (hashes_.at(file) != hash)
            throw Error(place, fmt::format("expected in {} the image that was shown, of SHA-256 "
                                           "{:.12}..., found another; take the folder from which "
                                           "the study was run",
                                           (folder_ / path).string(), hash));
    }

    fs::path folder_;
    std::map<std::string, std::string> hashes_;
};

ordered_json textsOf(const ordered_json& value) {
    ordered_json list = ordered_json::array();
    for (const ordered_json& one : value.is_array() ? value : ordered_json::array({value}))
        if (one.is_string())
            list.push_back(one);
        else if (one.is_object() && one.contains("name") && one["name"].is_string())
            list.push_back(one["name"]);
    return list;
}

// Authors and licence are those that users have added to their study's description.
ordered_json bidsDescription(const RecordedStudy& data) {
    const ordered_json own =
        data.description.empty() ? ordered_json::object() : ordered_json::parse(data.description);
    const bool simulated = std::any_of(data.sessions.begin(), data.sessions.end(),
                                       [](const SessionData& s) { return s.simulated; });
    ordered_json json = {{"Name", (simulated ? "SIMULATED: " : "") + data.study},
                         {"BIDSVersion", "1.9.0"},
                         {"DatasetType", "raw"}};
    if (own.contains("license") && !textsOf(own["license"]).empty())
        json["License"] = textsOf(own["license"]).front();
    if (own.contains("author") && !textsOf(own["author"]).empty())
        json["Authors"] = textsOf(own["author"]);
    json["GeneratedBy"] = {{{"Name", "Obscura"}, {"Version", version()}}};
    return json;
}

std::string readme(const RecordedStudy& data) {
    return fmt::format(
        "# {}\n\n"
        "Answers of participants who compared or judged images, exported by Obscura {}.\n"
        "`_beh.tsv` has a line per pair of images, or per answer where trials are no pairs;\n"
        "`_events.tsv` one per phase of a trial and per answer. The JSON files at the root say\n"
        "what the columns mean. Practice and catch trials are among them (`trial_kind`).\n\n"
        "Participants are named by pseudonyms.\n",
        data.study, version());
}

class Bids {
  public:
    Bids(const RecordedStudy& data, bool withStimuli)
        : data_(data), withStimuli_(withStimuli),
          hasPairs_(std::any_of(data.sessions.begin(), data.sessions.end(),
                                [](const auto& s) { return !s.rows.empty(); })) {}

    NewFiles files() {
        files_["dataset_description.json"] = {bidsDescription(data_).dump(2) + "\n"};
        files_["README.md"] = {readme(data_)};
        for (const SessionData& session : data_.sessions)
            add(session);
        addPeople();
        return std::move(files_);
    }

  private:
    void add(const SessionData& session) {
        if (const ExportTable table =
                hasPairs_ ? tableOf(session.rows, data_.version) : tableOf(session.answers);
            !table.rows.empty())
            addTable(session, "beh", table);
        if (session.phases.empty())
            return;
        addTable(session, "events", Events(session, withStimuli_).table());
    }

    void addTable(const SessionData& session, const std::string& suffix, const ExportTable& table) {
        files_[fmt::format("sub-{0}/ses-{1}/beh/sub-{0}_ses-{1}_task-{2}_{3}.tsv",
                           session.participant, session.session, data_.label, suffix)] = {
            tsvText(table)};
        ordered_json json = sidecar(table);
        if (suffix == "beh") // of events it would be a column's description
            json["TaskName"] = data_.study;
        files_[fmt::format("task-{}_{}.json", data_.label, suffix)] = {json.dump(2) + "\n"};
    }

    void addPeople() {
        ExportTable people{
            {{"participant_id", "Pseudonym of the participant", "text"},
             {"sessions", "How many sessions there are", "a whole number"},
             {"trials", "How many trials were finished, of any kind", "a whole number"},
             {"simulated", "1 when a program answered, not a person", "0 or 1"}},
            {}};
        ExportTable sessions{
            {{"session_id", "Session of this participant", "text"},
             {"acq_time", "When the session began, ISO 8601, UTC", "text"},
             {"trials", "How many trials were finished, of any kind", "a whole number"},
             {"end_reason", "Why it ended: completed, left early, or broken off", "text"}},
            {}};
        std::map<std::string, std::vector<const SessionData*>> of;
        for (const SessionData& session : data_.sessions)
            of[session.participant].push_back(&session);
        for (const auto& [participant, list] : of) {
            std::size_t trials = 0;
            sessions.rows.clear();
            for (const SessionData* session : list) {
                trials += session->trials();
                sessions.rows.push_back({"ses-" + session->session, session->started,
                                         fmt::format("{}", session->trials()), session->endReason});
            }
            const std::string path = fmt::format("sub-{0}/sub-{0}_sessions", participant);
            files_[path + ".tsv"] = {tsvText(sessions)};
            // BIDS has none at the root.
            files_[path + ".json"] = {sidecar(sessions).dump(2) + "\n"};
            people.rows.push_back({"sub-" + participant, fmt::format("{}", list.size()),
                                   fmt::format("{}", trials), list.front()->simulated ? "1" : "0"});
        }
        files_["participants.tsv"] = {tsvText(people)};
        files_["participants.json"] = {sidecar(people).dump(2) + "\n"};
    }

    const RecordedStudy& data_;
    bool withStimuli_, hasPairs_;
    NewFiles files_;
};

} // namespace

NewFiles bidsFiles(const RecordedStudy& data, bool withStimuli) {
    return Bids(data, withStimuli).files();
}

NewFiles shownImages(const RecordedStudy& data, const fs::path& stimuli) {
    Images images(stimuli);
    for (const SessionData& session : data.sessions)
        images.add(session);
    NewFiles files;
    for (const auto& [path, hash] : images.hashes())
        files["stimuli/" + path] = {{}, stimuli / path};
    return files;
}

} // namespace obscura
