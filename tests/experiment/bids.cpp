#include "tests/experiment/bids.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace obscura::test {

namespace fs = std::filesystem;

namespace {

using Faults = std::vector<std::string>;

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result{""};
    for (const char c : line)
        if (c == '\t')
            result.emplace_back();
        else
            result.back() += c;
    return result;
}

class Checker {
  public:
    explicit Checker(const fs::path& dataset) : root_(dataset) {}

    Faults check() {
        const auto description = json("dataset_description.json");
        for (const char* key : {"Name", "BIDSVersion"})
            if (!description.contains(key) || !description[key].is_string())
                fault("dataset_description.json", fmt::format("lacks {}", key));
        checkNames();
        for (const std::string& name : names_)
            if (name.ends_with(".tsv"))
                checkTable(name);
        for (const fs::directory_entry& entry : fs::directory_iterator(root_))
            if (entry.is_directory() && entry.path().filename().string().starts_with("sub-"))
                folders_.insert(entry.path().filename().string());
        if (people_ != folders_)
            fault("participants.tsv", "names other participants than there are folders");
        return std::move(faults_);
    }

  private:
    void fault(const std::string& file, const std::string& what) {
        faults_.push_back(fmt::format("{}: {}", file, what));
    }

    nlohmann::json json(const std::string& name) {
        auto parsed = nlohmann::json::parse(std::ifstream(root_ / name), nullptr, false);
        if (!parsed.is_object())
            fault(name, "is missing or no JSON object");
        return parsed.is_object() ? parsed : nlohmann::json::object();
    }

    void checkNames() {
        const std::regex known(
            "README\\.md|dataset_description\\.json|participants\\.(tsv|json)|"
            "(stimuli|code|sourcedata|derivatives)/.+|\\.bidsignore|"
            "task-[a-zA-Z0-9]+_(beh|events)\\.json|"
            "(sub-[a-zA-Z0-9]+)/\\4_sessions\\.(tsv|json)|"
            "(sub-[a-zA-Z0-9]+)/(ses-[a-zA-Z0-9]+)/beh/\\6_\\7_task-[a-zA-Z0-9]+_(beh|events)"
            "\\.tsv");
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root_))
            if (!entry.is_directory())
                names_.insert(fs::relative(entry.path(), root_).generic_string());
        std::set<std::string> ignored; // as the dataset asks, a name a line
        std::ifstream list(root_ / ".bidsignore");
        for (std::string line; std::getline(list, line);)
            ignored.insert(line);
        for (const std::string& name : names_)
            if (!std::regex_match(name, known) && !ignored.contains(name))
                fault(name, "not a name of BIDS");
    }

    // The sidecar that describes a table: beside it, or at the root for what a task shares.
    std::string sidecarOf(const std::string& table) const {
        const std::string beside = table.substr(0, table.size() - 4) + ".json";
        const std::size_t task = table.find("_task-");
        return names_.count(beside) || task == table.npos
                   ? beside
                   : table.substr(task + 1, table.size() - task - 5) + ".json";
    }

    void checkTable(const std::string& name) {
        std::ifstream stream(root_ / name);
        std::string line;
        std::getline(stream, line);
        const auto header = cells(line);
        const std::set<std::string> columns(header.begin(), header.end());
        if (columns.size() != header.size())
            fault(name, "a column stands twice");
        const auto described = json(sidecarOf(name));
        for (const std::string& column : columns)
            if (!described.contains(column) || !described[column].contains("Description"))
                fault(name, fmt::format("column {} is not described", column));
        const bool events = name.ends_with("_events.tsv");
        if (events && (header.size() < 2 || header[0] != "onset" || header[1] != "duration"))
            fault(name, "does not begin with onset and duration");
        while (std::getline(stream, line))
            checkRow(name, header, cells(line), events);
    }

    void checkRow(const std::string& name, const std::vector<std::string>& header,
                  const std::vector<std::string>& row, bool events) {
        if (row.size() != header.size())
            return fault(name, "a row has another length");
        const std::regex number("-?[0-9]+(\\.[0-9]+)?|n/a");
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (row[i].find_first_not_of(' ') == std::string::npos)
                fault(name, fmt::format("an empty cell in {}", header[i]));
            if (events && i < 2 && !std::regex_match(row[i], number))
                fault(name, fmt::format("{} is no number: {}", header[i], row[i]));
            if (header[i] == "stim_file" && row[i] != "n/a" && !names_.count("stimuli/" + row[i]))
                fault(name, fmt::format("{} is not in stimuli/", row[i]));
        }
        if (name == "participants.tsv")
            people_.insert(row.front());
    }

    fs::path root_;
    Faults faults_;
    std::set<std::string> names_, people_, folders_;
};

std::string validator() {
    if (const char* named = std::getenv("OBSCURA_BIDS_VALIDATOR"))
        return named;
    return std::system("command -v bids-validator >/dev/null 2>&1") == 0 ? "bids-validator" : "";
}

} // namespace

std::vector<std::string> bidsFaults(const fs::path& dataset) { return Checker(dataset).check(); }

std::vector<std::string> validatorFaults(const fs::path& dataset, bool& installed) {
    const std::string program = validator();
    installed = !program.empty();
    if (!installed)
        return {};
    const std::string command =
        fmt::format("'{}' '{}' --json 2>/dev/null", program, dataset.string());
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::string output;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
        output.append(buffer, count);
    ::pclose(pipe);
    const auto json = nlohmann::json::parse(output, nullptr, false);
    if (!json.is_object())
        return {"bids-validator said nothing that can be read: " + output};
    Faults faults;
    for (const char* kind : {"errors", "warnings"})
        for (const auto& issue : json["issues"][kind])
            if (const std::string key = issue.value("key", ""); key != "NO_AUTHORS")
                faults.push_back(
                    fmt::format("{}: {} ({} file(s))", kind, key, issue["files"].size()));
    return faults;
}

} // namespace obscura::test
