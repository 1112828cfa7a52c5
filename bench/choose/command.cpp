#include "base/arguments.h"
#include "bench/choose/choose.h"
#include "bench/choose/report.h"
#include "bench/commands.h"
#include "bench/measure/viewpoints.h"
#include "bench/stability/stability.h"
#include "bench/study_options.h"
#include "bench/sweep/files.h"

#include <fmt/format.h>

namespace obscura {

namespace {

namespace fs = std::filesystem;

// Choosing looks at few techniques closely, so it can afford more views to be sure.
constexpr std::size_t quickViews = 4;

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
    adjust(study, options.study, quickViews);
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

} // namespace

std::vector<Command> chooseCommands(CLI::App& app) {
    CLI::App* choosing =
        app.add_subcommand("choose", "the cheapest technique that is good enough for a scene");
    const auto options = std::make_shared<ChooseOptions>();
    StudyOptions& study = options->study;
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

    return {{choosing, [options] { return runChoose(*options); }}};
}

} // namespace obscura
