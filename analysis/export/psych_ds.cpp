#include "analysis/export/formats.h"
#include "analysis/export/table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace obscura {

using nlohmann::ordered_json;

namespace {

std::string readme(const std::string& study) {
    return fmt::format(
        "# {}\n\n"
        "Data of one study as Psych-DS. In data/ each participant and session has a file with a\n"
        "line per phase of a trial (_description-phases), one with a line per answer\n"
        "(_description-answers) and, where trials are pairs, one with a line per trial.\n"
        "`dataset_description.json` says what the columns mean; row_id names a line of its file.\n"
        "\n"
        "Participants are named by pseudonyms.\n",
        study);
}

// A column that several tables have is described once; where their descriptions differ, by all.
class Variables {
  public:
    void add(const ExportTable& table) {
        for (const TableColumn& column : table.columns) {
            const auto known = std::find_if(list_.begin(), list_.end(), [&](const auto& other) {
                return other.name == column.name;
            });
            if (known == list_.end())
                list_.push_back(column);
            else if (known->description.find(column.description) == std::string::npos)
                known->description += "; or: " + column.description;
        }
    }

    ordered_json json() const {
        ordered_json list = ordered_json::array();
        for (const TableColumn& column : list_)
            list.push_back({{"@type", "PropertyValue"},
                            {"name", column.name},
                            {"description", column.description},
                            {"valueReference", column.expected}});
        return list;
    }

  private:
    std::vector<TableColumn> list_;
};

// What users have added to their study's description is theirs to keep.
ordered_json psychDsDescription(const RecordedStudy& data) {
    ordered_json json = {
        {"@context", "https://schema.org/"},
        {"@type", "Dataset"},
        {"name", data.study},
        {"description", fmt::format("Answers of participants in the study {}", data.study)},
        {"keywords", {"psychophysics"}}};
    if (!data.description.empty())
        json.update(ordered_json::parse(data.description));
    return json;
}

} // namespace

NewFiles psychDsFiles(const RecordedStudy& data) {
    NewFiles files;
    Variables variables;
    for (const SessionData& session : data.sessions) {
        const auto add = [&](const std::string& kind, const ExportTable& table) {
            if (table.rows.empty())
                return;
            files[fmt::format("data/study-{}_subject-{}_session-{}{}_data.csv", data.label,
                              session.participant, session.session, kind)] = {csvText(table)};
            variables.add(table);
        };
        add("", tableOf(session.rows, data.version));
        add("_description-phases", tableOf(session.phases));
        add("_description-answers", tableOf(session.answers));
    }
    ordered_json description = psychDsDescription(data);
    description["variableMeasured"] = variables.json();
    files["dataset_description.json"] = {description.dump(2) + "\n"};
    files["README.md"] = {readme(data.study)};
    return files;
}

} // namespace obscura
