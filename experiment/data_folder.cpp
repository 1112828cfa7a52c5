#include "experiment/data_folder.h"

#include "base/error.h"
#include "base/files.h"
#include "protocols/reader/responses.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace obscura {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr std::size_t longestId = 32;

bool isAlphanumeric(char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

ordered_json variables(std::span<const Column> columns = responseColumns()) {
    ordered_json list = ordered_json::array();
    for (const Column& column : columns)
        list.push_back({{"@type", "PropertyValue"},
                        {"name", column.name},
                        {"description", column.description},
                        {"valueReference", column.expected}});
    return list;
}

std::string description(const std::string& study, const std::string& title) {
    const ordered_json json = {
        {"@context", "https://schema.org/"},
        {"@type", "Dataset"},
        {"name", study},
        {"description",
         fmt::format("{}: forced choices between two images, one row per trial", title)},
        {"keywords", {"psychophysics", "ambient occlusion", "two-alternative forced choice"}},
        {"variableMeasured", variables()},
    };
    return json.dump(2) + "\n";
}

std::string readme(const std::string& title) {
    return fmt::format(
        "# {}\n\n"
        "Data of one study, laid out as Psych-DS. `data/` has one CSV per participant and "
        "session,\n"
        "one row per trial; `dataset_description.json` says what each column means. `sessions/`\n"
        "has, for each of them, the circumstances (`_session.json`), a journal of what began and\n"
        "ended when (`_journal.jsonl`), a line for each phase of a trial (`_phases.csv`) and for\n"
        "each answer (`_answers.csv`), and the ledger of the ordering scheme's slots.\n\n"
        "Participants are named by pseudonyms. Keep the list of who they are elsewhere.\n",
        title);
}

std::vector<std::string> namesOf(const ordered_json& list) {
    std::vector<std::string> names;
    for (const ordered_json& variable : list)
        names.push_back(variable.is_object() ? variable.value("name", "") : "");
    return names;
}

// Users add authors and a licence to the description; only its columns are ours to check.
void checkDescription(const fs::path& path) {
    auto json = ordered_json::parse(readFile(path), nullptr, false);
    const bool described = json.is_object() && json.contains("variableMeasured");
    if (described && json["variableMeasured"] == variables())
        return;
    if (!described || namesOf(json["variableMeasured"]) != namesOf(variables(responseColumns(1))))
        throw Error({path.string(), 0, 0, "variableMeasured"},
                    "the columns described are not those this version writes; use a data folder "
                    "of its own for each version: --data DIR");
    json["variableMeasured"] = variables();
    writeFile(path, json.dump(2) + "\n");
    fmt::print(stderr, "{}: columns of this version added; files of earlier sessions lack them\n",
               path.string());
}

// Of a name's letters; systems whose files know no capitals take such names for one.
std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return text;
}

// A file beside `path` whose name differs in capitals only; "" when there is none.
std::string twinOf(const fs::path& path) {
    if (fs::exists(path.parent_path()))
        for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path())) {
            std::string name = entry.path().filename().string();
            if (name != path.filename() && lowerCase(name) == lowerCase(path.filename().string()))
                return name;
        }
    return {};
}

} // namespace

DataFolder::DataFolder(const fs::path& data, const Protocol& protocol, bool rehearsals)
    : root_((rehearsals ? data / "rehearsals" : data) / protocol.name),
      title_(rehearsals ? "Rehearsals of " + protocol.title : protocol.title) {
    std::copy_if(protocol.name.begin(), protocol.name.end(), std::back_inserter(study_),
                 isAlphanumeric); // Psych-DS: no hyphen within a value
}

void DataFolder::prepare() const {
    const fs::path path = root_ / "dataset_description.json";
    if (fs::exists(path))
        checkDescription(path);
    else
        writeFile(path, description(root_.filename().string(), title_));
    if (!fs::exists(root_ / "README.md"))
        writeFile(root_ / "README.md", readme(title_));
    writeNewFile(root_ / ".psychdsignore", "sessions/\n"); // which is no part of Psych-DS
    makeFolders(root_ / "data");
    makeFolders(root_ / "sessions");
}

std::string DataFolder::stem(const SessionId& session) const {
    return fmt::format("study-{}_subject-{}_session-{}", study_, session.participant,
                       session.number);
}

fs::path DataFolder::rows(const SessionId& session) const {
    return root_ / "data" / (stem(session) + "_data.csv");
}

fs::path DataFolder::phases(const SessionId& session) const {
    return root_ / "sessions" / (stem(session) + "_phases.csv");
}

fs::path DataFolder::answers(const SessionId& session) const {
    return root_ / "sessions" / (stem(session) + "_answers.csv");
}

fs::path DataFolder::journal(const SessionId& session) const {
    return root_ / "sessions" / (stem(session) + "_journal.jsonl");
}

fs::path DataFolder::design() const { return root_ / "sessions" / "design.json"; }

fs::path DataFolder::sidecar(const SessionId& session) const {
    return root_ / "sessions" / (stem(session) + "_session.json");
}

fs::path DataFolder::ledger() const { return root_ / "sessions" / "ledger.jsonl"; }

bool isParticipantId(const std::string& id) {
    return !id.empty() && id.size() <= longestId &&
           std::all_of(id.begin(), id.end(), isAlphanumeric);
}

std::string objection(const DataFolder& folder, const SessionId& session) {
    const std::string& id = session.participant;
    if (!isParticipantId(id))
        return fmt::format("expected a participant id of 1 to {} letters (a-z) and digits",
                           longestId);
    if (fs::exists(folder.rows(session)) || fs::exists(folder.journal(session)))
        return fmt::format("there are data of {}, session {}; another id, or another session", id,
                           session.number);
    if (const std::string twin = twinOf(folder.journal(session)); !twin.empty())
        return fmt::format("there are data of the same id in other letters ({}); another id", twin);
    return {};
}

} // namespace obscura
