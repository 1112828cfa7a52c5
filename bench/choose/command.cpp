#include "base/arguments.h"
#include "base/random.h"
#include "bench/choose/choose.h"
#include "bench/choose/people.h"
#include "bench/choose/report.h"
#include "bench/commands.h"
#include "bench/stability/stability.h"
#include "bench/study_options.h"
#include "bench/sweep/files.h"
#include "bench/sweep/merge.h"
#include "protocols/reader/protocol_argument.h"
#include "renderer/found_cameras.h"
#include "renderer/reference/sight.h"

#include <fmt/format.h>

namespace obscura {

namespace {

namespace fs = std::filesystem;

// Choosing looks at few techniques closely, so it can afford more views to be sure.
constexpr std::size_t quickViews = 4;

struct ChooseOptions {
    StudyOptions study;
    std::string scene;
    double radius = 0; // 0: suggested
    int cameras = 12;
    std::vector<std::string> limits, failures;
    std::string within; // --budget
    fs::path people;    // folder of a study's results; may be empty
    double margin = 0.5;
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

// Which of the views found are fitted on and which judge is drawn by lot: they were found one after
// the other, the most interesting first.
void divide(std::vector<View> views, MatchStudy& study) {
    Random(study.seed, "halves").shuffle(views);
    const auto half = views.begin() + static_cast<std::ptrdiff_t>(views.size() / 2);
    study.train.assign(views.begin(), half);
    study.test.assign(half, views.end());
}

// Seen from cameras found in the scene instead of the study's own, half of them to fit on.
SweepStudy seenFromFound(SweepStudy study, const ChooseOptions& options, const Folders& folders) {
    View view = viewOfScene(options.scene);
    const Scene scene = loadSceneOf(view, folders);
    const Sight sight(scene);
    const RayTracer tracer(scene);
    view.radius = options.radius;
    if (options.radius <= 0) {
        const SuggestedRadius suggested =
            suggestedRadius(sight, tracer, options.cameras, study.match.seed);
        fmt::print("Radius {:g} m, for --radius gives none: {}.\n", suggested.metres,
                   suggested.why);
        view.radius = suggested.metres;
    }
    std::vector<View> views;
    for (const Camera& camera :
         foundCameras(sight, tracer, view.radius, options.cameras, study.match.seed)) {
        view.camera = camera;
        view.name = fmt::format("camera-{}", views.size() + 1);
        views.push_back(view);
    }
    divide(std::move(views), study.match);
    study.match.name = "choose";
    study.growth.reset();
    return study;
}

// What is asked for; what people's answers have to do with it is said.
Budget budgetOf(const ChooseOptions& options, const SweepStudy& study) {
    if (options.limits.empty() && options.within.empty() && options.people.empty())
        throw Error("expected what is good enough, by --limit or --people, or what may be spent, "
                    "by --budget, found none of them");
    Budget budget = budgetOf(options.limits, options.within,
                             &measureNamed(study.light ? "jod" : "rmse"), !options.people.empty());
    budget.failures = options.failures;
    if (options.people.empty())
        return budget;
    if (budget.jod)
        throw Error("expected either --limit jod or --people, found both");
    const PeopleLimit limit = limitOf(readPeople(options.people), options.margin);
    fmt::print("By people's answers in {}:\n{}So the limit is --limit jod={:.2f}.\n",
               options.people.string(), limit.words, limit.jod);
    budget.jod = limit.jod;
    return budget;
}

// Nothing at all may be good enough.
void addNone(MatchStudy& study) {
    if (std::none_of(study.techniques.begin(), study.techniques.end(),
                     [](const TechniqueSetting& each) { return each.technique == "none"; }))
        study.techniques.push_back({"none", "none", {}, {}});
}

int runChoose(const ChooseOptions& options) {
    const Folders folders{options.study.scenes, options.study.study.parent_path()};
    const gl::Context context(options.study.device);
    SweepStudy study = readSweepStudy(options.study.study);
    const Budget budget = budgetOf(options, study);
    if (!options.scene.empty())
        study = seenFromFound(std::move(study), options, folders);
    adjust(study, options.study, quickViews);
    addNone(study.match);
    const std::string bySweep =
        options.sweep.empty() ? "" : answerOf(readSweep(options.sweep), study, folders, budget);
    study.sizes.resize(1);
    const fs::path folder =
        options.study.out.empty() ? fs::path("choose-" + study.match.name) : options.study.out;
    requireOwnChoice(folder);
    Reporting reporting("choosing");
    const Choice choice = choose(study, budget, folders, planOf(options.study, folder),
                                 context.driver(), reporting.progress());
    reporting.end();
    writeChoice(folder, study, folders.protocol, budget, choice);
    fmt::print("{}", choiceText(study, budget, choice));
    if (!bySweep.empty())
        fmt::print("By the sweep of everything (errors and milliseconds alone): {}\n", bySweep);
    fmt::print("In {}: {}choice.svg, choice.csv, choice-views.csv, choice.json, and study.toml to "
               "check it by a sweep\n",
               folder.string(), choice.chosen ? "choice.toml for a protocol's include, " : "");
    return choice.chosen ? 0 : 1;
}

} // namespace

std::vector<Command> chooseCommands(CLI::App& app) {
    CLI::App* choosing = app.add_subcommand(
        "choose",
        "the cheapest technique that is good enough for a scene, or the best within a time");
    const auto options = std::make_shared<ChooseOptions>();
    StudyOptions& study = options->study;
    takesProtocol(choosing->add_option("study", study.study, "candidates and views, TOML"))
        ->default_val("sweep-builtin");
    choosing->add_option("--scene", options->scene,
                         "glTF file or built-in scene, seen from cameras found for it");
    choosing
        ->add_option("--radius", options->radius,
                     "of occlusion in --scene, metres; default: one that suits the scene")
        ->check(numberFrom(1e-4, 1e4));
    choosing->add_option("--cameras", options->cameras, "for --scene; half fit, half judge")
        ->check(CLI::Range(4, 64))
        ->capture_default_str();
    choosing->add_option("--limit", options->limits,
                         "the cheapest with rmse, flip, litFlip, flicker or ms of at most, or jod "
                         "(predicted, of the lit image) of at least NUMBER, as in jod=9; may be "
                         "repeated");
    choosing->add_option("--budget", options->within,
                         "ms=NUMBER: the best within so many milliseconds, by predicted JOD, or by "
                         "RMSE where the study has no [light]");
    choosing->add_option("--people", options->people,
                         "folder of the results of a ladder study: a limit on predicted JOD from "
                         "people's answers");
    choosing
        ->add_option("--margin", options->margin,
                     "JOD that people may see a technique below the ray-traced image, for --people")
        ->check(numberFrom(0, 10))
        ->capture_default_str();
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
