#include "base/files.h"
#include "bench/commands.h"
#include "bench/study_options.h"
#include "bench/sweep/ablation.h"
#include "bench/sweep/figures.h"
#include "bench/sweep/files.h"
#include "bench/sweep/merge.h"
#include "bench/sweep/page.h"
#include "bench/sweep/summary.h"
#include "bench/sweep/sweep.h"
#include "protocols/reader/protocol_argument.h"

#include <fmt/format.h>

namespace obscura {

namespace {

namespace fs = std::filesystem;

// The Pareto front of each scene and size, matched RMSE against milliseconds, and how far to trust
// them.
std::string frontText(const Sweep& sweep) {
    std::string text;
    const ErrorMeasure& measure = errorMeasures().front();
    for (const SweepGroup& group : groupsOf(sweep.rows)) {
        const auto points = paretoPoints(group, measure);
        if (paretoFront(points).empty()) // nothing has both
            continue;
        text += fmt::format("{}, {}: the front\n", titleOf(group), measure.name);
        const auto add = [&](std::size_t i, char mark) {
            text += fmt::format("{} {:<34} {:>9.3g} ms  {:6.3f} x starcraft 16  {:.4f}\n", mark,
                                group.points[i].configuration, group.points[i].total.median,
                                group.points[i].toStarcraft, measure.of(group.points[i]));
        };
        for (const std::size_t i : paretoFront(points))
            add(i, ' ');
        for (const std::size_t i : nearFront(points, uncertaintyOf(group)))
            add(i, '~');
        if (const std::string warning = warningOf(group.straying); !warning.empty())
            text += fmt::format("{} Marked ~: on the front within that.\n", warning);
    }
    return text;
}

constexpr std::size_t quickViews = 1;

// What a reader must know of a sweep besides its rows.
void printCaveats(const Sweep& sweep) {
    if (const std::string lacking = incompleteness(sweep); !lacking.empty())
        fmt::print(stderr, "Warning: {}\n", lacking);
    if (!sweep.machine.notes.empty())
        fmt::print(stderr, "Warning: {}\n", sweep.machine.notes);
}

int runSweep(const StudyOptions& options) {
    SweepStudy study = readSweepStudy(options.study);
    adjust(study, options, quickViews);
    const fs::path folder =
        options.out.empty() ? fs::path("sweep-" + study.match.name) : options.out;
    const gl::Context context(options.device);
    Reporting reporting("sweeping");
    const Sweep result = sweep(study, {options.scenes, options.study.parent_path()},
                               planOf(options, folder), context.driver(), reporting.progress());
    reporting.end();
    fmt::print("{} rows of {} configurations{}\n", result.rows.size(),
               study.match.techniques.size(),
               result.machine.method.empty() ? "" : "; " + result.machine.method);
    printCaveats(result);
    fmt::print("{}", frontText(result));
    fmt::print("Page: {}\n", (folder / "sweep.html").string());
    return 0;
}

void writePage(const fs::path& folder) {
    const Sweep sweep = readSweep(folder);
    printCaveats(sweep);
    writeFile(folder / "sweep.html", sweepPage(sweep, folder));
    writeFigures(folder / "figures", sweepFigures(sweep));
    fmt::print("Page: {}\n", (folder / "sweep.html").string());
}

int writeAblation(const fs::path& folder) {
    const Sweep sweep = readSweep(folder);
    printCaveats(sweep);
    const std::vector<AblationTable> tables = ablationTables(groupsOf(sweep.rows));
    if (tables.empty())
        throw Error({folder.string(), 0, 0, {}},
                    "expected a sweep of vao_plus_plus with and without its extensions, such as "
                    "that of protocols/sweep-vao-plus-plus.toml, found none of it");
    std::vector<Figure> figures;
    for (const AblationTable& table : tables) {
        if (Figure figure = ablationFigure(table, figures.size() + 1); !figure.script.empty())
            figures.push_back(std::move(figure));
        fmt::print("{}", ablationText(table));
    }
    writeFile(folder / "ablation.csv", ablationCsv(tables));
    writeFigures(folder / "figures", figures);
    fmt::print("Written: {} and figures/ablation-*.svg\n", (folder / "ablation.csv").string());
    return 0;
}

} // namespace

std::vector<Command> sweepCommands(CLI::App& app) {
    const auto options = std::make_shared<StudyOptions>();
    CLI::App* sweeping = app.add_subcommand(
        "sweep", "speed and accuracy of a study's techniques in all their settings");
    takesProtocol(sweeping->add_option("study", options->study, "TOML, such as sweep-builtin"))
        ->required();
    addStudyOptions(*sweeping, *options);
    sweeping
        ->add_option("--measure", options->measure,
                     "errors, which carry over from one machine to another, times, which do not, "
                     "or both")
        ->check(CLI::IsMember({"errors", "times", "both"}))
        ->capture_default_str();
    sweeping->add_option("--part", options->part,
                         "I/N: only the Ith of N shares, into a folder of its own; without it, any "
                         "number of processes with the same --out share the work");

    const auto folders = std::make_shared<std::vector<fs::path>>();
    CLI::App* merging = app.add_subcommand("merge", "one sweep of its parts");
    merging->add_option("parts", *folders, "folders of parts")->required();
    merging->add_option("--out", options->out, "result folder")->required();
    CLI::App* page = app.add_subcommand("page", "a sweep's page and figures anew from its CSV");
    page->add_option("folder", options->out, "of the sweep")->required();

    CLI::App* ablating =
        app.add_subcommand("ablation", "what the extensions of VAO++ save, from a sweep of it");
    ablating->add_option("folder", options->out, "of the sweep")->required();

    return {{sweeping, [options] { return runSweep(*options); }},
            {merging,
             [options, folders] {
                 mergeSweeps(*folders, options->out);
                 writePage(options->out);
                 return 0;
             }},
            {page,
             [options] {
                 writePage(options->out);
                 return 0;
             }},
            {ablating, [options] { return writeAblation(options->out); }}};
}

} // namespace obscura
