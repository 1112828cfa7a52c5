// obscura-analysis: the answers of a study, or published counts, become a table, a CSV and a page;
// its command export writes a study's data in the form of a standard.

#include "analysis/export/command.h"
#include "analysis/golden/golden.h"
#include "analysis/plan/command.h"
#include "analysis/scales/scale_table.h"
#include "analysis/table.h"
#include "analysis/whole_analysis.h"
#include "base/program.h"
#include "protocols/reader/protocol_argument.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>

namespace obscura {

namespace fs = std::filesystem;

namespace {

struct Options {
    AnalysisRequest request;
    fs::path out = "report", csv;
};

void declare(CLI::App& app, Options& options) {
    auto* data = app.add_option("DATA", options.request.data,
                                "A study's folder (participant_data/<study>), or CSV files")
                     ->option_text(" ");
    auto* counts = app.add_option("--counts", options.request.counts,
                                  "Instead of DATA: published counts, a CSV file such as "
                                  "analysis/thesis_table4.csv")
                       ->option_text("FILE");
    auto* stimuli = app.add_option("--stimuli", options.request.stimuli,
                                   "Folder of the study's stimuli (manifest.json): sets the order "
                                   "of conditions, adds the contact sheet to the report, and "
                                   "checks that these images were shown")
                        ->option_text("DIR");
    takesProtocol(app.add_option("--protocol", options.request.protocol,
                                 "Protocol whose [[claims]] are tested where the study's folder "
                                 "keeps no design with claims"));
    counts->excludes(data)->excludes(stimuli);
    app.add_option("--out", options.out, "Folder for report.html and the tables")
        ->option_text("DIR=report");
    app.add_option("--csv", options.csv, "Where the CSV goes instead of votes.csv in that folder")
        ->option_text("FILE");
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
    declareRules(app, options.request.rules);
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
    const AnalysisRequest& request = options.request;
    if (request.data.empty() && request.counts.empty())
        throw Error("expected a study's folder, CSV files, or --counts FILE; see --help");

    const Analysis analysis = analysisOf(request);
    const Findings& findings = analysis.findings;
    if (findings.conduct)
        for (const BadRow& bad : findings.conduct->bad)
            fmt::print(stderr, "skipped: {}{}\n", bad.place.prefix(), bad.message);
    const fs::path table = writeAnalysis(analysis, request, options.out, options.csv);
    printFindings(findings);
    fmt::print("\nreport: {}\ntable:  {}\n", (options.out / "report.html").string(),
               table.string());
    return 0;
}

} // namespace

} // namespace obscura

int main(int argc, char** argv) {
    return obscura::runProgram("obscura-analysis",
                               "statistics and a report from the answers of a study",
                               obscura::analyse, argc, argv);
}
