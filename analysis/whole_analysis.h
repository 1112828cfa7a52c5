#pragma once

#include "analysis/deviations.h"
#include "analysis/findings.h"
#include "base/new_files.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace obscura {

// One run of the analysis, from files to files: for obscura-analysis, and for whoever wants to know
// whether the same data still give the same results.

struct AnalysisRequest {
    std::vector<std::filesystem::path> data; // a study's folder, or CSV files
    std::filesystem::path counts;            // instead of them: published counts
    std::filesystem::path stimuli, protocol; // "": not given
    AnswerRules rules;
};

// The options that AnswerRules stand for.
void declareRules(CLI::App& app, AnswerRules& rules);

// What was asked for, but for where the files lay, and by which version of the program:
// results.json has it as `made`. `excluded` is the text of the file that the rules name.
nlohmann::ordered_json toJson(const AnalysisRequest& request);

// The same request of data in another place. `made` is that part of results.json, which `file` is;
// `excluded` is where its text was put, if it has any.
AnalysisRequest requestOf(const nlohmann::json& made, const std::string& file,
                          const std::filesystem::path& data, const std::filesystem::path& stimuli,
                          const std::filesystem::path& protocol,
                          const std::filesystem::path& excluded);

struct Analysis {
    Findings findings;
    std::vector<Deviation> deviations = {}; // none where nothing is declared
};
Analysis analysisOf(const AnalysisRequest& request);

// All tables, and results.json, by file name: those for which there is something to say.
std::map<std::string, std::string> tablesOf(const Analysis& analysis,
                                            const AnalysisRequest& request);

// All of that into a folder, with the page and what lies beside it. `csv`: where the main table
// goes instead; "": among the others. Returns the path of the main table.
std::filesystem::path writeAnalysis(const Analysis& analysis, const AnalysisRequest& request,
                                    const std::filesystem::path& folder,
                                    const std::filesystem::path& csv = {});

} // namespace obscura
