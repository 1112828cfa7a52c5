#include "tests/experiment/psych_ds.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>

namespace obscura::test {

namespace fs = std::filesystem;

namespace {

using Faults = std::vector<std::string>;

const std::regex dataName("([a-z]+-[a-zA-Z0-9]+)(_[a-z]+-[a-zA-Z0-9]+)*_data\\.(csv|tsv)");

// Cells of one line; our files have no line feed within a cell.
std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result{""};
    bool quoted = false;
    for (const char c : line) {
        quoted ^= c == '"';
        if (c == ',' && !quoted)
            result.emplace_back();
        else
            result.back() += c;
    }
    return result;
}

std::set<std::string> describedVariables(const fs::path& dataset, Faults& faults) {
    const auto json =
        nlohmann::json::parse(std::ifstream(dataset / "dataset_description.json"), nullptr, false);
    std::set<std::string> names;
    if (!json.is_object()) {
        faults.push_back("dataset_description.json is missing or no JSON object");
        return names;
    }
    if (json.value("@type", "") != "Dataset" || !json.contains("@context"))
        faults.push_back("dataset_description.json is no schema.org Dataset");
    for (const char* key : {"name", "description", "variableMeasured"})
        if (!json.contains(key) || json[key].empty())
            faults.push_back(fmt::format("dataset_description.json lacks {}", key));
    for (const auto& variable : json.value("variableMeasured", nlohmann::json::array()))
        if (!names
                 .insert(variable.is_string() ? variable.get<std::string>()
                                              : variable.value("name", ""))
                 .second)
            faults.push_back("a variable is described twice");
    return names;
}

void checkFile(const fs::path& path, const std::set<std::string>& described,
               std::set<std::string>& used, Faults& faults) {
    const std::string file = path.filename().string();
    if (!std::regex_match(file, dataName))
        faults.push_back(file + ": not a name of a data file");
    std::ifstream stream(path);
    std::string line;
    std::getline(stream, line);
    const auto header = cells(line);
    const std::set<std::string> columns(header.begin(), header.end());
    if (columns.size() != header.size())
        faults.push_back(file + ": a column stands twice");
    if (!std::includes(described.begin(), described.end(), columns.begin(), columns.end()))
        faults.push_back(file + ": columns are not those described");
    used.insert(columns.begin(), columns.end());
    std::set<std::string> rowIds;
    const auto id = std::find(header.begin(), header.end(), "row_id") - header.begin();
    while (std::getline(stream, line)) {
        const auto row = cells(line);
        if (row.size() != header.size())
            faults.push_back(file + ": a row has another length");
        else if (!rowIds.insert(row.at(static_cast<std::size_t>(id))).second)
            faults.push_back(file + ": a row_id stands twice");
    }
}

} // namespace

Faults psychDsFaults(const fs::path& dataset) {
    Faults faults;
    const auto described = describedVariables(dataset, faults);
    std::set<std::string> used;
    for (const auto& entry : fs::recursive_directory_iterator(dataset / "data"))
        if (entry.is_regular_file())
            checkFile(entry.path(), described, used, faults);
    if (!std::includes(used.begin(), used.end(), described.begin(), described.end()))
        faults.push_back("a variable is described that no file has");
    // Outside data/, names that look like data files would be taken for misplaced ones.
    for (const auto& entry : fs::recursive_directory_iterator(dataset)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().parent_path() != dataset / "data" &&
            (name.ends_with("_data.csv") || name.ends_with("_data.json")))
            faults.push_back(name + ": a data file outside data/");
    }
    return faults;
}

} // namespace obscura::test
