#include "archive/contents.h"

#include "analysis/export/formats.h"
#include "analysis/export/study_data.h"
#include "archive/paths.h"
#include "archive/sources.h"
#include "archive/sums.h"
#include "archive/versions.h"
#include "base/files.h"
#include "base/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace obscura {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

// Files of a folder, and of those below it, that `isOurs` by their path within it; the others go to
// `left`.
template <typename Test>
void addFolder(NewFiles& files, const std::string& within, const fs::path& folder, Test isOurs,
               std::vector<std::string>& left) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_directory() && !entry.is_symlink())
            continue;
        const std::string path = entry.path().lexically_relative(folder).generic_string();
        if (entry.is_regular_file() && isOurs(path))
            files[within + "/" + path] = {{}, entry.path()};
        else
            left.push_back(entry.path().string());
    }
}

// What the presenter writes, and tables that an analysis reads. All else in the folder is
// somebody's own, who need not mean to publish it.
bool isData(const std::string& path) {
    const bool inSessions = path.starts_with("sessions/"), inData = path.starts_with("data/");
    const auto endsIn = [&](std::initializer_list<const char*> endings) {
        return std::any_of(endings.begin(), endings.end(),
                           [&](const char* ending) { return path.ends_with(ending); });
    };
    const std::string name = fs::path(path).filename().string();
    return path == "dataset_description.json" || path == "README.md" || path == ".psychdsignore" ||
           path == "sessions/ledger.jsonl" || path == "sessions/design.json" ||
           (inData && !name.starts_with('.') && name.ends_with(".csv")) ||
           (inSessions && !name.starts_with('.') &&
            endsIn({"_phases.csv", "_answers.csv", "_journal.jsonl", "_session.json"}));
}

class Packing {
  public:
    Packing(const WholeStudy& study, const Results& results)
        : study_(study), results_(results), data_("sourcedata/" + study.protocol.name) {}

    Contents contents(const fs::path& scenes, bool withSources) {
        addBids();
        addStimuli();
        const fs::path folder = study_.protocol.path.parent_path();
        sources_ = sourcesOf(study_.manifest, scenes, folder);
        addProtocol(withSources);
        if (withSources)
            addScenes();
        addFolder(files(), data_, study_.places.data, isData, left_);
        addResults();
        addRecord();
        addTexts();
        if (!left_.empty())
            contents_.remarks.push_back(fmt::format(
                "left out, because no program of ours reads it: {}", fmt::join(left_, ", ")));
        return std::move(contents_);
    }

  private:
    NewFiles& files() { return contents_.files; }

    void addBids() {
        const AnswerRules& rules = results_.request.rules;
        const RecordedStudy data = readStudy(study_.places.data, rules.simulated, rules.lenient);
        // An Error where others were shown than lie there.
        const NewFiles shown = shownImages(data, study_.places.stimuli);
        files() = bidsFiles(data, true);
        // What BIDS does not know, and images that nobody was shown, which it would ask about.
        std::string ignored =
            fmt::format("{}\nLICENCES.md\nstimuli/manifest.json\nstimuli/scenes/\n", sumsName);
        for (const FileRecord& file : filesOf(study_.manifest))
            if (!shown.contains("stimuli/" + file.path))
                ignored += "stimuli/" + file.path + "\n";
        files()[".bidsignore"] = {ignored};
        contents_.remarks = data.remarks;
    }

    void addStimuli() {
        files()["stimuli/manifest.json"] = {{}, study_.places.stimuli / "manifest.json"};
        for (const FileRecord& file : filesOf(study_.manifest))
            files()["stimuli/" + file.path] = {{}, study_.places.stimuli / file.path};
    }

    // The protocol's own folder, or one above it where it names files there.
    void addProtocol(bool withSources) {
        const fs::path protocol = fs::absolute(study_.protocol.path).lexically_normal();
        std::vector<fs::path> all{protocol};
        for (const std::string& name : namedBy(withSources)) {
            if (fs::path(name).is_absolute())
                throw Error({protocol.string(), 0, 0, "include"},
                            fmt::format("expected files that are named relative to the protocol, "
                                        "found {}; an archive lies elsewhere",
                                        name));
            all.push_back((protocol.parent_path() / name).lexically_normal());
        }
        fs::path root = protocol.parent_path();
        const auto isBelow = [&](const fs::path& path) {
            return *path.lexically_relative(root).begin() != "..";
        };
        while (!std::all_of(all.begin(), all.end(), isBelow))
            root = root.parent_path();
        for (const fs::path& path : all)
            files()["code/protocol/" + path.lexically_relative(root).generic_string()] = {{}, path};
        protocol_ = "code/protocol/" + protocol.lexically_relative(root).generic_string();
    }

    std::vector<std::string> namedBy(bool withSources) const {
        std::vector<std::string> names = study_.protocol.includes;
        for (const Source& source : sources_)
            if (withSources && source.kind == "environment image")
                names.push_back(source.name);
        return names;
    }

    void addScenes() {
        for (const Source& source : sources_) {
            if (source.kind == "built-in scene")
                continue;
            if (source.files.empty())
                throw Error(fmt::format(
                    "expected the {} \"{}\" from which the stimuli were made, of SHA-256 "
                    "{:.12}..., found none, or another; say by --scenes where it is",
                    source.kind, source.name, source.sha256));
            if (source.kind == "scene")
                files().insert(source.files.begin(), source.files.end());
        }
    }

    void addResults() {
        const auto tables = tablesOf(results_);
        const ResultsComparison comparison = comparisonOf(results_, tables);
        if (!comparison.numbers.empty() || !comparison.others.empty())
            throw Error(
                {results_.folder.string(), 0, 0, {}},
                fmt::format("expected what these data give, found {} other value(s), such as: {}; "
                            "the results were made by {}, this is {}. Analyse again, or put them "
                            "elsewhere: where there are none, they are made",
                            comparison.numbers.size() + comparison.others.size(),
                            comparison.numbers.empty() ? comparison.others.front()
                                                       : comparison.numbers.front(),
                            results_.program, thisProgram()));
        const auto isOurs = [&](const std::string& path) {
            return tables.contains(path) || path == "report.html" || path == "start.R" ||
                   path == "start.py" || path.starts_with("figures/");
        };
        std::vector<std::string> others; // as where stimuli and data lie below the results
        addFolder(files(), resultsFolder, results_.folder, isOurs, others);
        const ordered_json description = {
            {"Name", study_.protocol.name + ": results"},
            {"BIDSVersion", "1.9.0"},
            {"DatasetType", "derivative"},
            {"GeneratedBy", {{{"Name", "obscura-analysis"}, {"Version", results_.program}}}}};
        files()[std::string(resultsFolder) + "/dataset_description.json"] = {description.dump(2) +
                                                                             "\n"};
        if (!results_.excluded.empty())
            files()[excludedName] = {results_.excluded};
    }

    void addRecord() {
        ordered_json list = ordered_json::array();
        for (const Source& source : sources_) {
            const bool isIn =
                source.kind != "built-in scene" && !source.files.empty() &&
                files().contains(source.kind == "scene" ? source.files.begin()->first
                                                        : pathOfEnvironment(source.name));
            list.push_back({{"kind", source.kind},
                            {"name", source.name},
                            {"sha256", source.sha256},
                            {"licence", source.licence},
                            {"included", isIn}});
        }
        const ordered_json record = {{"formatVersion", 1},
                                     {"study", study_.protocol.name},
                                     {"protocol", protocol_},
                                     {"sources", list},
                                     {"versions", versionsOf(study_.manifest, study_.places.data)}};
        files()[recordName] = {record.dump(2) + "\n"};
    }

    std::string pathOfEnvironment(const std::string& name) const {
        return (fs::path(protocol_).parent_path() / name).lexically_normal().generic_string();
    }

    void addTexts() {
        std::string own;
        if (const auto found = files().find("dataset_description.json"); found != files().end())
            if (const auto json = ordered_json::parse(found->second.text); json.contains("License"))
                own = json["License"];
        if (own.empty())
            contents_.remarks.push_back(
                "the study has no licence, so that nobody may use it: write one as \"license\" "
                "into "
                "the data folder's dataset_description.json, and archive again");
        files()["LICENCES.md"] = {licencesText(own, sources_)};
        files()["README.md"] = {readme()};
    }

    std::string readme() const {
        const std::string title =
            study_.protocol.title.empty() ? study_.protocol.name : study_.protocol.title;
        return fmt::format(
            "# {}\n\n"
            "One study, whole, archived by Obscura {}: what was asked and shown, what people\n"
            "answered, and what came of it. `sha256sum -c {}` tells whether all of it is as it "
            "was;\n"
            "`obscura-archive --check` on this folder also renders, reads and analyses it "
            "again.\n\n"
            "| where | what |\n|---|---|\n"
            "| `sub-*/`, `participants.tsv`, `task-*.json` | the answers as BIDS 1.9.0 has them: "
            "`_beh.tsv` a line per pair or answer, `_events.tsv` one per phase and answer |\n"
            "| `stimuli/` | the images, and `manifest.json`, which says how each was made |\n"
            "| `{}` | the protocol: everything that decides the study |\n"
            "| `{}` | what was made by which program, driver and machine |\n"
            "| `{}/` | the data as they were recorded (Psych-DS): tables, journals, ledger, design "
            "|\n"
            "| `{}/` | report, tables and figures |\n"
            "| `LICENCES.md` | who may do what with it, as far as known |\n\n"
            "Participants have the names that they have in the data; who they are is not in "
            "here.\n",
            title, version(), sumsName, protocol_, recordName, data_, resultsFolder);
    }

    const WholeStudy& study_;
    const Results& results_;
    std::string data_, protocol_;
    std::vector<Source> sources_;
    std::vector<std::string> left_;
    Contents contents_;
};

} // namespace

Record readRecord(const fs::path& archive) {
    const fs::path path = archive / recordName;
    const auto json = ordered_json::parse(readFile(path), nullptr, false);
    const auto has = [&](const char* key, ordered_json::value_t type) {
        return json.is_object() && json.contains(key) && json[key].type() == type;
    };
    using Type = ordered_json::value_t;
    if (!has("study", Type::string) || !has("protocol", Type::string) ||
        !has("sources", Type::array) || !has("versions", Type::object))
        throw Error({path.string(), 0, 0, {}},
                    "expected an archive's record, as obscura-archive writes it, found another "
                    "text");
    Record record{json["study"], json["protocol"], json["sources"], json["versions"]};
    for (const std::string& part : {record.study, record.protocol})
        if (const std::string fault = faultOfPath(part); !fault.empty())
            throw Error(
                {path.string(), 0, 0, {}},
                fmt::format("expected paths within the archive: \"{:.80}\" {}", part, fault));
    return record;
}

Contents contentsOf(const WholeStudy& study, const Results& results, const fs::path& scenes,
                    bool withSources) {
    return Packing(study, results).contents(scenes, withSources);
}

} // namespace obscura
