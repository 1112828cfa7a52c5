#include "base/arguments.h"
#include "base/files.h"
#include "base/progress.h"
#include "bench/choose/choose.h"
#include "bench/choose/report.h"
#include "bench/commands.h"
#include "bench/measure/viewpoints.h"
#include "bench/stability/stability.h"
#include "bench/sweep/ablation.h"
#include "bench/sweep/figures.h"
#include "bench/sweep/files.h"
#include "bench/sweep/page.h"
#include "bench/sweep/summary.h"
#include "bench/sweep/sweep.h"
#include "renderer/reference/reference_cache.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <optional>

namespace obscura {

namespace {

namespace fs = std::filesystem;

struct StudyOptions {
    fs::path study, out, scenes;
    std::string device, part;
    std::vector<std::string> sizes;
    double seconds = -1, hours = 1;
    bool quick = false;
};

std::vector<ImageSize> sizesOf(const std::vector<std::string>& texts) {
    std::vector<ImageSize> sizes;
    for (const std::string& text : texts) {
        const auto pair = parsePair(text, 'x');
        if (!pair || std::min(pair->first, pair->second) < 16 ||
            std::max(pair->first, pair->second) > 8192)
            throw Error(
                fmt::format("expected --size WIDTHxHEIGHT, each 16 ... 8192, found \"{}\"", text));
        sizes.push_back({pair->first, pair->second});
    }
    return sizes;
}

// Choosing looks at few techniques closely, so it can afford more views to be sure.
constexpr std::size_t quickSweepViews = 1, quickChooseViews = 4;

void adjust(SweepStudy& study, const StudyOptions& options, std::size_t quickViews) {
    if (options.quick)
        study = quick(std::move(study), quickViews);
    if (!options.sizes.empty())
        study.sizes = sizesOf(options.sizes);
    if (options.seconds >= 0)
        study.seconds = options.seconds;
}

SweepPlan planOf(const StudyOptions& options, const fs::path& folder) {
    SweepPlan plan{folder, defaultCache()};
    plan.hours = options.hours;
    if (options.part.empty())
        return plan;
    const auto part = parsePair(options.part, '/');
    if (!part || part->first < 1 || part->first > part->second)
        throw Error(
            fmt::format("expected --part I/N with I from 1 to N, found \"{}\"", options.part));
    plan.part = part->first;
    plan.parts = part->second;
    return plan;
}

// A line that appears with the first report, on which the total is known.
class Reporting {
  public:
    explicit Reporting(std::string label) : label_(std::move(label)) {}
    SweepProgress progress() {
        return [this](double done, double total, const std::string& note) {
            if (!line_ || total != total_)
                line_.emplace(label_, total_ = total);
            line_->update(done, note);
        };
    }
    void end() { line_.reset(); }

  private:
    std::string label_;
    double total_ = 0;
    std::optional<Progress> line_;
};

// The Pareto front of each scene and size, matched RMSE against milliseconds.
std::string frontText(const Sweep& sweep) {
    std::string text;
    const ErrorMeasure& measure = errorMeasures().front();
    for (const SweepGroup& group : groupsOf(sweep.rows)) {
        text += fmt::format("{}, {}: the front\n", titleOf(group), measure.name);
        for (const std::size_t i : paretoFront(paretoPoints(group, measure)))
            text += fmt::format("  {:<34} {:>9.3g} ms  {:6.3f} x starcraft 16  {:.4f}\n",
                                group.points[i].configuration, group.points[i].total.median,
                                group.points[i].toStarcraft, measure.of(group.points[i]));
    }
    return text;
}

int runSweep(const StudyOptions& options) {
    SweepStudy study = readSweepStudy(options.study);
    adjust(study, options, quickSweepViews);
    const fs::path folder =
        options.out.empty() ? fs::path("sweep-" + study.match.name) : options.out;
    const gl::Context context(options.device);
    Reporting reporting("sweeping");
    const Sweep result = sweep(study, {options.scenes, options.study.parent_path()},
                               planOf(options, folder), context.driver(), reporting.progress());
    reporting.end();
    fmt::print("{} rows of {} configurations; {}\n", result.rows.size(),
               study.match.techniques.size(), result.machine.method);
    fmt::print("{}", frontText(result));
    fmt::print("Page: {}\n", (folder / "sweep.html").string());
    return 0;
}

void writePage(const fs::path& folder) {
    const Sweep sweep = readSweep(folder);
    writeFile(folder / "sweep.html", sweepPage(sweep, folder));
    writeFigures(folder / "figures", sweepFigures(sweep));
    fmt::print("Page: {}\n", (folder / "sweep.html").string());
}

int writeAblation(const fs::path& folder) {
    const std::vector<AblationTable> tables = ablationTables(groupsOf(readSweep(folder).rows));
    if (tables.empty())
        throw Error({folder.string(), 0, 0, {}},
                    "expected a sweep of vao_plus_plus with and without its extensions, such as "
                    "that of protocols/sweep-vao-plus-plus.toml, found none of it");
    std::vector<Figure> figures;
    for (const AblationTable& table : tables) {
        figures.push_back(ablationFigure(table, figures.size() + 1));
        fmt::print("{}", ablationText(table));
    }
    writeFile(folder / "ablation.csv", ablationCsv(tables));
    writeFigures(folder / "figures", figures);
    fmt::print("Written: {} and figures/ablation-*.svg\n", (folder / "ablation.csv").string());
    return 0;
}

struct ChooseOptions {
    StudyOptions study;
    std::string scene;
    double radius = 0;
    int cameras = 8;
    std::vector<std::string> limits, failures;
    fs::path sweep; // to be compared with; may be empty
};

// What measuring everything would have chosen, by the rows of the study's size.
std::string answerOf(Sweep sweep, const SweepStudy& study, const Folders& folders,
                     const Budget& budget) {
    SceneHashes hashes(folders);
    if (sweep.machine.study != identityOf(study, hashes))
        throw Error("expected --sweep to name a sweep of this study with these options and scenes, "
                    "found one of another study, of an earlier text of it, or with others");
    if (const std::string lacking = incompleteness(sweep); !lacking.empty())
        throw Error("expected --sweep to name a finished sweep, found " + lacking);
    const ImageSize& size = study.sizes.front();
    std::erase_if(sweep.rows, [&](const SweepRow& row) {
        return row.width != size.width || row.height != size.height;
    });
    const std::string name = chosenFrom(sweep, budget);
    return name.empty() ? "nothing" : name;
}

// The study's own views, or cameras that see the scene, half of them to fit on.
SweepStudy studyOf(const ChooseOptions& options, const Folders& folders) {
    SweepStudy study = readSweepStudy(options.study.study);
    if (options.scene.empty())
        return study;
    if (options.radius <= 0)
        throw Error("expected --radius METRES with --scene: how far occlusion is to reach there");
    View view = viewOfScene(options.scene);
    view.radius = options.radius;
    const std::vector<View> views = viewpoints(view, folders, options.cameras, study.match.seed);
    study.match.train.clear();
    study.match.test.clear();
    for (std::size_t i = 0; i < views.size(); ++i)
        (i % 2 ? study.match.test : study.match.train).push_back(views[i]);
    study.match.name = "choose";
    study.growth.reset();
    return study;
}

// Nothing at all may be good enough.
void addNone(MatchStudy& study) {
    if (std::none_of(study.techniques.begin(), study.techniques.end(),
                     [](const TechniqueSetting& each) { return each.technique == "none"; }))
        study.techniques.push_back({"none", "none", {}, {}});
}

int runChoose(const ChooseOptions& options) {
    Budget budget = budgetOf(options.limits);
    budget.failures = options.failures;
    const Folders folders{options.study.scenes, options.study.study.parent_path()};
    const gl::Context context(options.study.device);
    SweepStudy study = studyOf(options, folders);
    adjust(study, options.study, quickChooseViews);
    addNone(study.match);
    const std::string bySweep =
        options.sweep.empty() ? "" : answerOf(readSweep(options.sweep), study, folders, budget);
    study.sizes.resize(1);
    const fs::path folder =
        options.study.out.empty() ? fs::path("choose-" + study.match.name) : options.study.out;
    Reporting reporting("choosing");
    requireOwnChoice(folder);
    const Choice choice = choose(study, budget, folders, planOf(options.study, folder),
                                 context.driver(), reporting.progress());
    reporting.end();
    writeChoice(folder, study, budget, choice);
    fmt::print("{}", choiceText(study, budget, choice));
    if (!bySweep.empty())
        fmt::print("By the sweep of everything (errors and milliseconds alone): {}\n", bySweep);
    fmt::print("In {}: {}choice.svg and choice.csv\n", folder.string(),
               choice.chosen ? "choice.toml for a protocol's include, " : "");
    return choice.chosen ? 0 : 1;
}

void addStudyOptions(CLI::App& command, StudyOptions& options) {
    const char* scenes = std::getenv("OBSCURA_SCENES");
    options.scenes = scenes ? scenes : ".";
    command.add_option("--out", options.out, "result folder; default named after the study");
    command.add_option("--scenes", options.scenes, "folder of glTF scenes; default OBSCURA_SCENES");
    command.add_option("--device", options.device,
                       "render with this device of obscura-render --devices");
    command.add_option("--size", options.sizes,
                       "WIDTHxHEIGHT instead of the study's sizes; may be repeated");
    command
        .add_option("--seconds", options.seconds,
                    "timed of each configuration and view, or the study's number of frames")
        ->check(numberFrom(0, 86400));
    command.add_option("--hours", options.hours, "that references may take")
        ->check(numberFrom(0, 1e6))
        ->capture_default_str();
    command.add_flag("--quick", options.quick,
                     "a first look in minutes: few views, small, hardly timed");
}

} // namespace

std::vector<Command> sweepCommands(CLI::App& app) {
    const auto options = std::make_shared<ChooseOptions>();
    StudyOptions& study = options->study;
    CLI::App* sweeping = app.add_subcommand(
        "sweep", "speed and accuracy of a study's techniques in all their settings");
    sweeping->add_option("study", study.study, "TOML, such as protocols/sweep-builtin.toml")
        ->required();
    addStudyOptions(*sweeping, study);
    sweeping->add_option("--part", study.part, "I/N: only every Nth configuration, from the Ith");

    const auto folders = std::make_shared<std::vector<fs::path>>();
    CLI::App* merging = app.add_subcommand("merge", "one sweep of its parts");
    merging->add_option("parts", *folders, "folders of parts")->required();
    merging->add_option("--out", study.out, "result folder")->required();
    CLI::App* page = app.add_subcommand("page", "a sweep's page and figures anew from its CSV");
    page->add_option("folder", study.out, "of the sweep")->required();

    CLI::App* ablating =
        app.add_subcommand("ablation", "what the extensions of VAO++ save, from a sweep of it");
    ablating->add_option("folder", study.out, "of the sweep")->required();

    CLI::App* choosing =
        app.add_subcommand("choose", "the cheapest technique that is good enough for a scene");
    study.study = fs::path(OBSCURA_PROTOCOLS) / "sweep-builtin.toml";
    choosing->add_option("study", study.study, "TOML of candidates and views")
        ->capture_default_str();
    choosing->add_option("--scene", options->scene,
                         "glTF file or built-in scene, seen from cameras found for it");
    choosing->add_option("--radius", options->radius, "of occlusion in --scene, metres")
        ->check(numberFrom(1e-4, 1e4));
    choosing->add_option("--cameras", options->cameras, "for --scene; half fit, half judge")
        ->check(CLI::Range(4, 64))
        ->capture_default_str();
    choosing
        ->add_option("--limit", options->limits,
                     "rmse, flip, litFlip, flicker or ms = NUMBER; may be repeated")
        ->required();
    choosing
        ->add_option("--must-pass", options->failures,
                     "a test of obscura-bench stability that must not fail; may be repeated")
        ->check(CLI::IsMember(stillTestIds()));
    choosing->add_option("--sweep", options->sweep,
                         "folder of a finished sweep of the study: also say what it would choose");
    addStudyOptions(*choosing, study);

    return {{sweeping, [options] { return runSweep(options->study); }},
            {merging,
             [options, folders] {
                 const Sweep all = mergeSweeps(*folders, options->study.out);
                 if (const std::string lacking = incompleteness(all); !lacking.empty())
                     fmt::print(stderr, "Warning: {}\n", lacking);
                 writePage(options->study.out);
                 return 0;
             }},
            {page,
             [options] {
                 writePage(options->study.out);
                 return 0;
             }},
            {ablating, [options] { return writeAblation(options->study.out); }},
            {choosing, [options] { return runChoose(*options); }}};
}

} // namespace obscura
