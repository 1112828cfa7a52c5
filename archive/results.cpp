#include "archive/results.h"

#include "base/files.h"
#include "base/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace obscura {

namespace fs = std::filesystem;

std::string thisProgram() { return fmt::format("{} ({})", version(), commit()); }

Results readResults(const StudyPlaces& places, const fs::path& excluded) {
    const fs::path file = places.results / "results.json";
    const auto json = nlohmann::json::parse(readFile(file), nullptr, false);
    if (!json.is_object() || !json.contains("made") || !json["made"].is_object())
        throw Error({file.string(), 0, 0, "made"},
                    "expected results that say how they were made, as obscura-analysis writes them "
                    "now, found none; analyse again, or put them elsewhere: where there are none, "
                    "they are made");
    const nlohmann::json& made = json["made"];
    Results results{
        places.results,
        requestOf(made, file.string(), places.data, places.stimuli, places.protocol, excluded), "",
        ""};
    results.program = fmt::format("{} ({})", made.at("version").get<std::string>(),
                                  made.at("commit").get<std::string>());
    results.excluded = made.at("excluded").get<std::string>();
    return results;
}

Results makeResults(const StudyPlaces& places, const fs::path& folder) {
    Results results{
        folder, {{places.data}, {}, places.stimuli, places.protocol, {}}, thisProgram(), ""};
    writeAnalysis(analysisOf(results.request), results.request, folder);
    return results;
}

std::map<std::string, std::string> tablesOf(const Results& results) {
    return tablesOf(analysisOf(results.request), results.request);
}

ResultsComparison comparisonOf(const Results& results,
                               const std::map<std::string, std::string>& tables) {
    std::map<std::string, std::string> there;
    for (const auto& [name, table] : tables)
        if (fs::is_regular_file(results.folder / name))
            there[name] = readFile(results.folder / name);
    return comparisonOf(there, tables);
}

} // namespace obscura
