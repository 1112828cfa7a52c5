// obscura-analysis: the answers of a study, or published counts, become a table, a CSV and a page;
// its command export writes a study's data in the form of a standard.

#include "analysis/deviations.h"
#include "analysis/export/command.h"
#include "analysis/findings.h"
#include "analysis/golden/golden.h"
#include "analysis/people_table.h"
#include "analysis/plan/command.h"
#include "analysis/prices/price_table.h"
#include "analysis/report.h"
#include "analysis/results.h"
#include "analysis/scales/scale_table.h"
#include "analysis/scales/trial_findings.h"
#include "analysis/table.h"
#include "base/files.h"
#include "base/program.h"
#include "protocols/reader/protocol.h"
#include "protocols/reader/protocol_argument.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace obscura {

namespace fs = std::filesystem;

namespace {

struct Options {
    std::vector<fs::path> data;
    fs::path counts, stimuli, protocol, out = "report", csv;
    AnswerRules rules;
};

const std::map<std::string, SimulatedRows> simulatedRows = {{"refuse", SimulatedRows::refuse},
                                                            {"exclude", SimulatedRows::exclude},
                                                            {"only", SimulatedRows::only},
                                                            {"include", SimulatedRows::include}};

void declare(CLI::App& app, Options& options) {
    auto* data = app.add_option("DATA", options.data,
                                "A study's folder (participant_data/<study>), or CSV files")
                     ->option_text(" ");
    auto* counts = app.add_option("--counts", options.counts,
                                  "Instead of DATA: published counts, a CSV file such as "
                                  "analysis/thesis_table4.csv")
                       ->option_text("FILE");
    auto* stimuli = app.add_option("--stimuli", options.stimuli,
                                   "Folder of the study's stimuli (manifest.json): sets the order "
                                   "of conditions, adds the contact sheet to the report, and "
                                   "checks that these images were shown")
                        ->option_text("DIR");
    takesProtocol(app.add_option("--protocol", options.protocol,
                                 "Protocol whose [[claims]] are tested where the study's folder "
                                 "keeps no design with claims"));
    counts->excludes(data)->excludes(stimuli);
    app.add_option("--out", options.out, "Folder for report.html and the tables")
        ->option_text("DIR=report");
    app.add_option("--csv", options.csv, "Where the CSV goes instead of votes.csv in that folder")
        ->option_text("FILE");
}

void declareRules(CLI::App& app, AnswerRules& rules) {
    app.add_flag("--lenient", rules.lenient, "Report rows that cannot be read, and skip them");
    app.add_option_function<std::string>(
           "--simulated",
           [&rules](const std::string& word) { rules.simulated = simulatedRows.at(word); },
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

struct Analysis {
    Findings findings;
    std::vector<Deviation> deviations; // none where nothing is declared
};

Analysis analysisOf(const Options& options) {
    std::optional<Protocol> protocol;
    if (!options.protocol.empty())
        protocol = readProtocol(options.protocol);
    const Declared given = protocol ? declaredBy(*protocol) : Declared();
    const Protocol* known = protocol ? &*protocol : nullptr;
    if (!options.counts.empty()) {
        Findings findings =
            findingsOf(fmt::format("Published counts: {}", options.counts.filename().string()),
                       readCounts(options.counts), given.claims);
        return {std::move(findings), {}};
    }
    std::optional<Manifest> stimuli;
    if (!options.stimuli.empty())
        stimuli = readManifest(options.stimuli / "manifest.json");
    if (isTrialData(options.data))
        return {trialFindings(options.data, options.rules, stimuli), {}};
    const Answers answers = collectAnswers(options.data, options.rules);
    Analysis analysis{findingsOf(answers, std::move(stimuli), given.claims), {}};
    const Declared& declared = answers.declared.claims.empty() ? given : answers.declared;
    if (!declared.claims.empty())
        analysis.deviations = deviationsOf(analysis.findings, declared, known);
    return analysis;
}

void printFindings(const Findings& findings) {
    if (const std::string stamp = stampOf(findings); !stamp.empty())
        fmt::print("*** {} ***\n\n", stamp);
    for (const std::string& caution : cautionsOf(findings))
        fmt::print("*** {} ***\n\n", caution);
    fmt::print("{}\n\n", findings.title);
    if (!findings.tallies.empty())
        fmt::print("{}\n", alignedText(resultTable(findings.tallies)));
    for (const std::string& sentence : summaryOf(findings))
        fmt::print("{}\n", sentence);
    if (const std::string tests = testsText(findings); !tests.empty())
        fmt::print("\n{}", tests);
    if (!findings.scales.all.empty())
        fmt::print("\n{}", scalesText(findings.scales.all));
}

int analyse(CLI::App& app, int argc, char** argv) {
    Options options;
    declare(app, options);
    declareRules(app, options.rules);
    ExportOptions exported;
    const CLI::App* exporting = declareExport(app, exported);
    PlanCommand plan;
    const CLI::App* planning = declarePlan(app, plan);
    fs::path golden;
    CLI::App* checking = app.add_subcommand(
        "golden", "Compute statistics that another program has computed, and compare them");
    checking->add_option("DIR", golden, "Folder with golden_values.csv and the data files it is of")
        ->required()
        ->option_text(" ");
    app.parse(argc, argv);
    if (exporting->parsed()) {
        exportStudy(exported);
        return 0;
    }
    if (planning->parsed()) {
        planStudy(plan);
        return 0;
    }
    if (checking->parsed())
        return printGolden(golden);
    if (options.data.empty() && options.counts.empty())
        throw Error("expected a study's folder, CSV files, or --counts FILE; see --help");

    const auto [findings, deviations] = analysisOf(options);
    if (findings.conduct)
        for (const BadRow& bad : findings.conduct->bad)
            fmt::print(stderr, "skipped: {}{}\n", bad.place.prefix(), bad.message);
    const bool isPairs = !findings.tallies.empty();
    const fs::path csv =
        !options.csv.empty() ? options.csv : options.out / (isPairs ? "votes.csv" : "scales.csv");
    const fs::path report = options.out / "report.html";
    const std::string page = reportHtml(findings, deviations);
    if (isPairs) {
        writeFile(csv, resultCsv(findings));
        writeFile(options.out / "tests.csv", testsCsv(findings));
        if (findings.people) {
            writeFile(options.out / "people.csv", peopleCsv(findings));
            writeFile(options.out / "times.csv", timesCsv(findings));
        }
    }
    writeFile(options.out / "results.csv", resultsCsv(findings));
    writeFile(options.out / "results.json", resultsJson(findings));
    if (findings.stimuli && !isUnusable(findings))
        if (const std::string ladder = ladderCsv(pricedScales(findings.scales, *findings.stimuli));
            !ladder.empty())
            writeFile(options.out / "ladder.csv", ladder);
    if (!isPairs || !findings.scales.all.empty())
        writeFile(isPairs ? options.out / "scales.csv" : csv,
                  scalesCsv(findings.scales, sourceOf(findings)));
    if (!findings.exclusions.empty())
        writeFile(options.out / "exclusions.csv", exclusionsCsv(findings));
    if (!deviations.empty())
        writeFile(options.out / "deviations.csv", deviationsCsv(deviations));
    writeFile(report, page);
    writeBesideReport(options.out, csv, findings);
    printFindings(findings);
    fmt::print("\nreport: {}\ntable:  {}\n", report.string(), csv.string());
    return 0;
}

} // namespace

} // namespace obscura

int main(int argc, char** argv) {
    return obscura::runProgram("obscura-analysis",
                               "statistics and a report from the answers of a study",
                               obscura::analyse, argc, argv);
}
