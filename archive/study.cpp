#include "archive/study.h"

#include "analysis/export/study_data.h"
#include "archive/paths.h"
#include "base/files.h"
#include "protocols/reader/claims.h"
#include "protocols/reader/design.h"
#include "protocols/reader/stimuli.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace obscura {

namespace fs = std::filesystem;

namespace {

bool hasTables(const fs::path& folder) {
    return fs::is_directory(folder) &&
           std::any_of(
               fs::directory_iterator(folder), fs::directory_iterator(),
               [](const fs::directory_entry& entry) { return entry.path().extension() == ".csv"; });
}

bool isProtocol(const fs::path& path) {
    return path.extension() == ".toml" && fs::is_regular_file(path) &&
           readFile(path).find("[[conditions]]") != std::string::npos;
}
bool isStimuli(const fs::path& path) { return fs::is_regular_file(path / "manifest.json"); }
bool isData(const fs::path& path) {
    return fs::is_directory(path / "sessions") || hasTables(path / "data");
}
bool isResults(const fs::path& path) { return fs::is_regular_file(path / "results.json"); }

// What each part is called, by which option it is given, and how it is known.
struct Part {
    fs::path StudyPlaces::*place;
    const char* option;
    const char* what;
    bool (*is)(const fs::path&);
};
constexpr Part parts[] = {
    {&StudyPlaces::protocol, "--protocol", "the protocol, a .toml file with [[conditions]]",
     isProtocol},
    {&StudyPlaces::stimuli, "--stimuli", "the stimuli, a folder with manifest.json", isStimuli},
    {&StudyPlaces::data, "--data", "the participants' data, a folder with sessions/ or data/",
     isData},
    {&StudyPlaces::results, "--results", "the results, a folder with results.json", isResults},
};

// The folder and what lies up to three levels below it, without what is hidden.
std::vector<fs::path> pathsIn(const fs::path& folder) {
    constexpr int deepest = 2; // of the iterator, which counts from 0 for what lies in the folder
    std::vector<fs::path> paths{folder};
    for (auto at = fs::recursive_directory_iterator(folder);
         at != fs::recursive_directory_iterator(); ++at)
        if (at->path().filename().string().starts_with('.'))
            at.disable_recursion_pending();
        else {
            if (at.depth() >= deepest)
                at.disable_recursion_pending();
            paths.push_back(at->path());
        }
    std::sort(paths.begin(), paths.end());
    return paths;
}

fs::path found(const Part& part, const std::vector<fs::path>& paths, const fs::path& folder) {
    std::vector<std::string> all;
    for (const fs::path& path : paths)
        if (part.is(path))
            all.push_back(path.string());
    if (all.size() > 1)
        throw Error({folder.string(), 0, 0, {}},
                    fmt::format("expected one place with {}, found {}: {}; say which by {}",
                                part.what, all.size(), fmt::join(all, ", "), part.option));
    return all.empty() ? fs::path() : fs::path(all.front());
}

// The image's file, or one that belongs to it.
void checkFile(const Manifest& manifest, const FileRecord& record) {
    const fs::path path = manifest.folder / record.path;
    if (!fs::is_regular_file(path))
        throw Error({path.string(), 0, 0, {}},
                    "expected a file that the manifest names, found none; make the stimuli anew, "
                    "or take the folder from which the study was run");
    if (sha256File(path) != record.sha256)
        throw Error({path.string(), 0, 0, {}},
                    "is not the file that the manifest vouches for: its SHA-256 is another; make "
                    "the stimuli anew, or take the folder from which the study was run");
}

[[noreturn]] void refuseDesign(const Place& place, const std::string& what) {
    throw Error(place, fmt::format("{}; an archive holds one study: give the protocol and the "
                                   "stimuli with which these data were recorded",
                                   what));
}

template <typename Row, typename HashOf>
void checkRows(const std::vector<Placed<Row>>& rows, const std::string& expected, HashOf hashOf) {
    for (const auto& [row, place] : rows)
        if (const std::string& found = hashOf(row); !found.empty() && found != expected)
            refuseDesign(
                {place.file, place.line, 0, "design_sha256"},
                fmt::format("expected the design of protocol and stimuli, {:.12}..., found "
                            "{:.12}...",
                            expected, found));
}

} // namespace

StudyPlaces findStudy(const fs::path& folder, StudyPlaces places) {
    if (!folder.empty() && !fs::is_directory(folder))
        throw Error({folder.string(), 0, 0, {}}, "expected a study's folder, found none");
    const std::vector<fs::path> paths = folder.empty() ? std::vector<fs::path>() : pathsIn(folder);
    for (const Part& part : parts) {
        fs::path& place = places.*part.place;
        if (!place.empty() && part.place == &StudyPlaces::data && !isData(place) &&
            fs::is_directory(place)) // as the presenter takes it
            place = found(part, pathsIn(place), place);
        if (!place.empty() && !part.is(place))
            throw Error({place.string(), 0, 0, {}},
                        fmt::format("expected {}, as {} names it, found none there", part.what,
                                    part.option));
        if (place.empty())
            place = found(part, paths, folder);
        if (place.empty() && part.place != &StudyPlaces::results)
            throw Error(fmt::format(
                "expected {}; name it by {}{}", part.what, part.option,
                folder.empty() ? ", or give a folder that has it"
                               : fmt::format(", for there is none in {}", folder.string())));
    }
    return places;
}

std::vector<FileRecord> filesOf(const Manifest& manifest) {
    std::vector<FileRecord> files = manifest.contactSheets;
    for (const ConditionRecord& condition : manifest.conditions)
        for (const ImageRecord& image : condition.images) {
            files.push_back(image.image);
            for (const auto& [kind, layer] : image.layers)
                files.push_back(layer);
        }
    for (const FileRecord& file : files)
        if (const std::string fault = faultOfPath(file.path); !fault.empty())
            throw Error({(manifest.folder / "manifest.json").string(), 0, 0, {}},
                        fmt::format("expected files in its folder, found \"{:.100}\", which {}",
                                    file.path, fault));
    return files;
}

void checkStimuli(const Manifest& manifest) {
    for (const FileRecord& file : filesOf(manifest))
        checkFile(manifest, file);
}

void checkDesign(const WholeStudy& study) {
    const std::string design = designOf(study.protocol, study.manifest), hash = sha256(design);
    if (const fs::path path = study.places.data / "sessions" / "design.json"; fs::exists(path)) {
        const std::string text = readFile(path);
        if (declaredIn(text, path.string()).sha256 != hash) {
            const auto found = differences(nlohmann::json::parse(text).at("design").dump(), design);
            refuseDesign({path.string(), 0, 0, {}},
                         fmt::format("the data were recorded under another design than that of "
                                     "protocol and stimuli: {}",
                                     fmt::join(found, "; ")));
        }
    }
    const RecordedStudy data = readStudy(study.places.data, SimulatedRows::include, true);
    if (data.study != study.protocol.name)
        refuseDesign({study.places.data.string(), 0, 0, "study_id"},
                     fmt::format("expected data of the study \"{}\", found \"{}\"",
                                 study.protocol.name, data.study));
    for (const SessionData& session : data.sessions) {
        checkRows(session.rows, hash, [](const Response& row) { return row.designSha256; });
        checkRows(session.answers, hash, [](const AnswerRow& row) { return row.designSha256; });
    }
}

WholeStudy openWholeStudy(const StudyPlaces& places) {
    WholeStudy study{places, readProtocol(places.protocol), {}};
    study.manifest = readStimuli(study.protocol, places.stimuli);
    checkStimuli(study.manifest);
    checkDesign(study);
    return study;
}

} // namespace obscura
