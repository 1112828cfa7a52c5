#include "archive/check.h"

#include "analysis/export/formats.h"
#include "analysis/export/study_data.h"
#include "archive/contents.h"
#include "archive/paths.h"
#include "archive/pictures.h"
#include "archive/results.h"
#include "archive/sources.h"
#include "archive/sums.h"
#include "archive/temporary_folder.h"
#include "archive/versions.h"
#include "archive/zip.h"
#include "base/files.h"
#include "protocols/reader/stimuli.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// Does one step of a check: what it throws is told as one thing that differs.
template <typename Step>
bool tried(Checked& checked, const std::string& what, Step step) {
    try {
        step();
        return true;
    } catch (const std::exception& error) {
        checked.differs.push_back(fmt::format("{}: {}", what, error.what()));
        return false;
    }
}

class Checking {
  public:
    Checking(fs::path archive, const CheckOptions& options)
        : archive_(std::move(archive)), options_(options) {}

    std::vector<Checked> all() {
        options_.announce(0, 0, "reading");
        sums();
        if (!parts())
            return std::move(all_);
        stimuli();
        bids();
        all_.push_back(picturesAgain(*study_, scenes(), protocolFolder(), options_));
        options_.announce(0, 0, "analysing");
        results();
        return std::move(all_);
    }

  private:
    Checked& row(const std::string& what) {
        return all_.emplace_back(Checked{what, 0, 0, {}, {}, {}});
    }

    void sums() {
        const Sums list = readSums(archive_);
        Checked& checked = row("files, by their SHA-256");
        checked.differs = faultsOf(archive_, list);
        // What is not in the list adds to what was looked at.
        const auto unlisted = std::count_if(
            checked.differs.begin(), checked.differs.end(),
            [](const std::string& fault) { return fault.ends_with(" is not in the list"); });
        checked.same =
            static_cast<long>(list.size()) - (static_cast<long>(checked.differs.size()) - unlisted);
    }

    // Whether there is a study to go on with.
    bool parts() {
        Checked& checked = row("protocol, stimuli and data, of one design");
        WholeStudy study;
        const bool isThere = tried(checked, recordName, [&] {
            record_ = readRecord(archive_);
            study.places = {archive_ / record_.protocol, archive_ / "stimuli",
                            archive_ / "sourcedata" / record_.study, archive_ / resultsFolder};
        });
        if (!isThere || !tried(checked, record_.protocol, [&] { readStudyOf(study); }))
            return false;
        ++checked.same;
        if (!tried(checked, "stimuli/manifest.json", [&] {
                study.manifest = readStimuli(study.protocol, study.places.stimuli);
                filesOf(study.manifest);
            }))
            return false;
        ++checked.same;
        checked.same += tried(checked, "sourcedata", [&] { checkDesign(study); });
        for (const std::string& remark : otherVersions())
            checked.remarks.push_back(remark);
        study_ = std::move(study);
        return true;
    }

    void readStudyOf(WholeStudy& study) const {
        study.protocol = readProtocol(study.places.protocol);
        for (const std::string& name : study.protocol.includes)
            if (const fs::path path =
                    (fs::path(record_.protocol).parent_path() / name).lexically_normal();
                !faultOfPath(path.generic_string()).empty())
                throw Error({study.places.protocol.string(), 0, 0, "include"},
                            fmt::format("expected a file of the archive, found {}", name));
        if (study.protocol.name != record_.study)
            throw Error({study.places.protocol.string(), 0, 0, "name"},
                        fmt::format("expected \"{}\", as {} has it, found \"{}\"", record_.study,
                                    recordName, study.protocol.name));
    }

    // By what the archive was made, where that is not what checks it.
    std::vector<std::string> otherVersions() const {
        std::vector<std::string> remarks;
        const auto before = record_.versions.value("archive", nlohmann::ordered_json::object());
        const auto now = thisMachine();
        for (const auto& [key, value] : now.items())
            if (!before.contains(key) || before[key] != value)
                remarks.push_back(
                    fmt::format("the archive was made with another {}: {}, now {}", key,
                                before.contains(key) ? before[key].dump() : "none", value.dump()));
        return remarks;
    }

    void stimuli() {
        Checked& checked = row("stimuli, as the manifest vouches");
        for (const FileRecord& file : filesOf(study_->manifest)) {
            const fs::path path = study_->places.stimuli / file.path;
            if (!fs::is_regular_file(path))
                checked.differs.push_back(fmt::format("stimuli/{} is missing", file.path));
            else if (sha256File(path) != file.sha256)
                checked.differs.push_back(fmt::format(
                    "stimuli/{} is not the file that the manifest vouches for", file.path));
            else
                ++checked.same;
        }
    }

    // Tables that are made of the recorded data, byte for byte; what names a version is no table.
    void bids() {
        Checked& checked = row("tables of BIDS, from the data");
        tried(checked, "sourcedata", [&] {
            const AnswerRules rules = resultsHere().request.rules;
            const RecordedStudy data =
                readStudy(study_->places.data, rules.simulated, rules.lenient);
            shownImages(data, study_->places.stimuli);
            for (const auto& [path, file] : bidsFiles(data, true)) {
                if (path == "README.md" || path == "dataset_description.json")
                    continue;
                if (!fs::is_regular_file(archive_ / path))
                    checked.differs.push_back(path + " is missing");
                else if (readFile(archive_ / path) != file.text)
                    checked.differs.push_back(path + " is not what the data in sourcedata give");
                else
                    ++checked.same;
            }
        });
    }

    Results resultsHere() const { return readResults(study_->places, archive_ / excludedName); }

    void results() {
        Checked& checked = row("results, value by value");
        tried(checked, resultsFolder, [&] {
            const Results here = resultsHere();
            const ResultsComparison comparison = comparisonOf(here, tablesOf(here));
            checked.same = comparison.same;
            checked.nearly = comparison.nearly;
            checked.differs = comparison.numbers;
            if (comparison.nearly > 0)
                checked.remarks.push_back(
                    fmt::format("numbers that are nearly the same: at most {:.1g} of one apart",
                                comparison.most));
            // Another version may say things otherwise, and may know more.
            const bool isSame = here.program == thisProgram();
            auto& others = isSame ? checked.differs : checked.remarks;
            others.insert(others.end(), comparison.others.begin(), comparison.others.end());
            if (!isSame)
                checked.remarks.push_back(fmt::format("the results were made by {}, this is {}",
                                                      here.program, thisProgram()));
        });
    }

    // The archive's own scenes, if it has any.
    fs::path scenes() const {
        return fs::is_directory(archive_ / scenesFolder) ? archive_ / scenesFolder
                                                         : options_.scenes;
    }

    // Environment images lie beside the protocol, or, where the archive has none, with the scenes.
    fs::path protocolFolder() const {
        const fs::path folder = study_->places.protocol.parent_path();
        for (const ConditionRecord& condition : study_->manifest.conditions)
            for (const ImageRecord& image : condition.images)
                if (const std::string& name = image.recipe.level.environment;
                    !name.empty() && !fs::exists(folder / name))
                    return options_.scenes;
        return folder;
    }

    fs::path archive_;
    const CheckOptions& options_;
    Record record_;
    std::optional<WholeStudy> study_;
    std::vector<Checked> all_;
};

// Sentences that are the same are told once, with how many they are of; and of many, the first.
std::string linesOf(const std::string& head, const std::vector<std::string>& sentences) {
    constexpr std::size_t most = 20;
    std::vector<std::string> order;
    std::map<std::string, int> counts;
    for (const std::string& sentence : sentences)
        if (++counts[sentence] == 1)
            order.push_back(sentence);
    std::string text;
    for (std::size_t i = 0; i < std::min(order.size(), most); ++i)
        text += fmt::format(
            "{}{}: {}\n", head,
            counts[order[i]] > 1 ? fmt::format(" ({} of them)", counts[order[i]]) : "", order[i]);
    if (order.size() > most)
        text += fmt::format("{}: and {} more\n", head, order.size() - most);
    return text;
}

} // namespace

std::vector<Checked> checkArchive(const fs::path& archive, const CheckOptions& options) {
    if (fs::is_directory(archive))
        return Checking(archive, options).all();
    if (!fs::is_regular_file(archive))
        throw Error({archive.string(), 0, 0, {}},
                    "expected an archive, a folder or a .zip file, found none");
    const TemporaryFolder folder;
    return Checking(unpackZip(archive, folder.path() / "unpacked"), options).all();
}

bool isSound(const std::vector<Checked>& all) {
    return std::all_of(all.begin(), all.end(),
                       [](const Checked& checked) { return checked.differs.empty(); });
}

std::string textOf(const std::vector<Checked>& all) {
    std::string text = fmt::format("{:<42} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "", "checked", "same",
                                   "nearly", "differs", "not here");
    for (const Checked& checked : all)
        text += fmt::format("{:<42} {:>8} {:>8} {:>8} {:>8} {:>8}\n", checked.what, checked.count(),
                            checked.same, checked.nearly, checked.differs.size(),
                            checked.notHere.size());
    for (const Checked& checked : all)
        text += linesOf("differs", checked.differs);
    for (const Checked& checked : all)
        text += linesOf("cannot be checked here", checked.notHere);
    for (const Checked& checked : all)
        text += linesOf("note", checked.remarks);
    return text;
}

} // namespace obscura
