#include "analysis/whole_analysis.h"

#include "analysis/people_table.h"
#include "analysis/prices/price_table.h"
#include "analysis/report.h"
#include "analysis/results.h"
#include "analysis/scales/scale_table.h"
#include "analysis/scales/trial_findings.h"
#include "analysis/table.h"
#include "base/files.h"
#include "base/version.h"
#include "protocols/reader/protocol.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// In the order of SimulatedRows.
constexpr std::array<const char*, 4> simulatedWords{"refuse", "exclude", "only", "include"};

SimulatedRows simulatedOf(const std::string& word) {
    return static_cast<SimulatedRows>(
        std::find(simulatedWords.begin(), simulatedWords.end(), word) - simulatedWords.begin());
}

// The flags among the rules, by their names in results.json.
constexpr std::array<std::pair<const char*, bool AnswerRules::*>, 5> ruleFlags{
    {{"mixedStudies", &AnswerRules::mixedStudies},
     {"mixedProtocols", &AnswerRules::mixedProtocols},
     {"duplicates", &AnswerRules::duplicates},
     {"interrupted", &AnswerRules::interrupted},
     {"lenient", &AnswerRules::lenient}}};

std::string mainTable(const Analysis& analysis) {
    return analysis.findings.tallies.empty() ? "scales.csv" : "votes.csv";
}

} // namespace

void declareRules(CLI::App& app, AnswerRules& rules) {
    app.add_flag("--lenient", rules.lenient, "Report rows that cannot be read, and skip them");
    app.add_option_function<std::string>(
           "--simulated",
           [&rules](const std::string& word) { rules.simulated = simulatedOf(word); },
           "Rows of simulated among those of real participants: refuse, exclude, only (the "
           "simulated), include. Data of one kind need no choice")
        ->option_text("WHAT=refuse")
        ->check(CLI::IsMember({"refuse", "exclude", "only", "include"}));
    app.add_flag("--allow-mixed-studies", rules.mixedStudies, "Pool rows of several studies");
    app.add_flag("--allow-mixed-protocols", rules.mixedProtocols,
                 "Pool rows of several designs of a study; other texts are no other design");
    app.add_flag("--allow-duplicates", rules.duplicates,
                 "Where a trial has several rows, count the first and leave out the others");
    app.add_option("--exclude", rules.excluded,
                   "Rows that do not count: a CSV file with the columns "
                   "participant_id,session_id,condition_id,reason, an empty cell for all")
        ->option_text("FILE");
    app.add_flag_callback(
        "--exclude-interrupted", [&rules] { rules.interrupted = false; },
        "Leave out trials during which the window lost the keyboard; else they count");
}

nlohmann::ordered_json toJson(const AnalysisRequest& request) {
    const AnswerRules& rules = request.rules;
    nlohmann::ordered_json json = {
        {"version", version()},
        {"commit", commit()},
        {"stimuli", !request.stimuli.empty()},
        {"protocol", !request.protocol.empty()},
        {"simulated", simulatedWords[static_cast<std::size_t>(rules.simulated)]}};
    for (const auto& [name, flag] : ruleFlags)
        json[name] = rules.*flag;
    json["excluded"] = rules.excluded.empty() ? "" : readFile(rules.excluded);
    return json;
}

AnalysisRequest requestOf(const nlohmann::json& made, const std::string& file, const fs::path& data,
                          const fs::path& stimuli, const fs::path& protocol,
                          const fs::path& excluded) {
    const auto get = [&]<typename T>(const char* key, T value) {
        try {
            return made.at(key).get<T>();
        } catch (const nlohmann::json::exception&) {
            throw Error({file, 0, 0, fmt::format("made.{}", key)},
                        fmt::format("expected {}, as obscura-analysis writes it, found another "
                                    "value or none; analyse again",
                                    std::is_same_v<T, bool> ? "true or false" : "a text"));
        }
        return value;
    };
    AnalysisRequest request{{data}, {}, {}, {}, {}};
    if (get("stimuli", false))
        request.stimuli = stimuli;
    if (get("protocol", false))
        request.protocol = protocol;
    request.rules.simulated = simulatedOf(get("simulated", std::string()));
    if (request.rules.simulated > SimulatedRows::include)
        throw Error({file, 0, 0, "made.simulated"},
                    "expected refuse, exclude, only or include, found another word; analyse again");
    for (const auto& [name, flag] : ruleFlags)
        request.rules.*flag = get(name, false);
    for (const char* key : {"version", "commit"})
        get(key, std::string());
    if (!get("excluded", std::string()).empty())
        request.rules.excluded = excluded;
    return request;
}

Analysis analysisOf(const AnalysisRequest& request) {
    std::optional<Protocol> protocol;
    if (!request.protocol.empty())
        protocol = readProtocol(request.protocol);
    const Declared given = protocol ? declaredBy(*protocol) : Declared();
    const Protocol* known = protocol ? &*protocol : nullptr;
    if (!request.counts.empty())
        return {findingsOf(fmt::format("Published counts: {}", request.counts.filename().string()),
                           readCounts(request.counts), given.claims)};
    std::optional<Manifest> stimuli;
    if (!request.stimuli.empty())
        stimuli = readManifest(request.stimuli / "manifest.json");
    if (isTrialData(request.data))
        return {trialFindings(request.data, request.rules, stimuli)};
    const Answers answers = collectAnswers(request.data, request.rules);
    Analysis analysis{findingsOf(answers, std::move(stimuli), given.claims)};
    const Declared& declared = answers.declared.claims.empty() ? given : answers.declared;
    if (!declared.claims.empty())
        analysis.deviations = deviationsOf(analysis.findings, declared, known);
    return analysis;
}

std::map<std::string, std::string> tablesOf(const Analysis& analysis,
                                            const AnalysisRequest& request) {
    const Findings& findings = analysis.findings;
    const bool isPairs = !findings.tallies.empty();
    std::map<std::string, std::string> tables{
        {"results.csv", resultsCsv(findings)},
        {"results.json", resultsJson(findings, toJson(request))}};
    if (isPairs) {
        tables["votes.csv"] = resultCsv(findings);
        tables["tests.csv"] = testsCsv(findings);
        if (findings.people) {
            tables["people.csv"] = peopleCsv(findings);
            tables["times.csv"] = timesCsv(findings);
        }
    }
    if (findings.stimuli && !isUnusable(findings))
        if (std::string ladder = ladderCsv(pricedScales(findings.scales, *findings.stimuli));
            !ladder.empty())
            tables["ladder.csv"] = std::move(ladder);
    if (!isPairs || !findings.scales.all.empty())
        tables["scales.csv"] = scalesCsv(findings.scales, sourceOf(findings));
    if (!findings.exclusions.empty())
        tables["exclusions.csv"] = exclusionsCsv(findings);
    if (!analysis.deviations.empty())
        tables["deviations.csv"] = deviationsCsv(analysis.deviations);
    return tables;
}

fs::path writeAnalysis(const Analysis& analysis, const AnalysisRequest& request,
                       const fs::path& folder, const fs::path& csv) {
    const std::string page = reportHtml(analysis.findings, analysis.deviations);
    const std::string first = mainTable(analysis);
    const fs::path table = csv.empty() ? folder / first : csv;
    for (const auto& [name, text] : tablesOf(analysis, request))
        writeFile(name == first ? table : folder / name, text);
    writeFile(folder / "report.html", page);
    writeBesideReport(folder, table, analysis.findings);
    return table;
}

} // namespace obscura
