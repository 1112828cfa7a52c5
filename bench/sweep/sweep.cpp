#include "bench/sweep/sweep.h"

#include "base/files.h"
#include "base/random.h"
#include "bench/measure/machine.h"
#include "bench/measure/measured_view.h"
#include "bench/measure/timing.h"
#include "bench/sweep/cost_growth.h"
#include "bench/sweep/figures.h"
#include "bench/sweep/files.h"
#include "bench/sweep/page.h"
#include "image/canvas.h"
#include "matching/match.h"
#include "renderer/techniques/fetches.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t groupSize = 12; // configurations that are timed in turn, then written

std::string settingsText(const Settings& settings) {
    std::string text;
    for (std::size_t i = 0; i < settings.values().size(); ++i)
        text += fmt::format("{}{}={:g}", text.empty() ? "" : " ",
                            settings.technique().parameters[i].name, settings.values()[i]);
    return text;
}

std::vector<View> viewsOf(const SweepStudy& study) {
    std::vector<View> views = study.match.train;
    views.insert(views.end(), study.match.test.begin(), study.match.test.end());
    return views;
}

// Seconds that a configuration takes on one view, roughly: shares of the progress line.
double renderCost(const ImageSize& size) { return 0.2 + 1e-6 * size.width * size.height; }

class Sweeping {
  public:
    Sweeping(const SweepStudy& study, const Folders& folders, const SweepPlan& plan,
             const gl::Driver& driver, const SweepProgress& progress)
        : study_(study), folders_(folders), plan_(plan), driver_(driver), progress_(progress),
          hashes_(folders), timing_(gl::honestTiming()) {}

    Sweep run();

  private:
    void open();
    void estimate();
    void match();
    void measureScene(const std::string& sceneSha256);
    std::vector<std::size_t> missing(const View& view, const ImageSize& size) const;
    void measureGroup(MeasuredView& seen, std::span<const std::size_t> group);
    SweepRow rowOf(MeasuredView& seen, const Configuration& configuration,
                   const TechniqueTime& time);
    void addErrors(SweepRow& row, MeasuredView& seen, const Configuration& configuration);
    void grow(const Subject& subject, const View& view);
    void write();
    TimingPlan timingPlan() const;
    void tell(const std::string& note) { progress_(done_, std::max(total_, done_), note); }
    void spend(double cost, const std::string& note) {
        done_ += cost;
        tell(note);
    }
    double configurationCost(const ImageSize& size) const {
        return study_.seconds + 4 * renderCost(size);
    }
    bool lacksGrowth() const;
    double growthCost() const;

    const SweepStudy& study_;
    const Folders& folders_;
    const SweepPlan& plan_;
    const gl::Driver& driver_;
    const SweepProgress& progress_;
    SceneHashes hashes_;
    gl::TimingChoice timing_;
    std::vector<Configuration> configurations_;
    Sweep sweep_;
    std::set<std::string> measured_;
    double done_ = 0, total_ = 0;
};

std::string keyOf(const std::string& configuration, const std::string& scene,
                  const std::string& view, double radius, int width, int height) {
    return fmt::format("{}\n{}\n{}\n{}\n{}x{}", configuration, scene, view, radius, width, height);
}

// Rows of an earlier run count when nothing that decides them has changed since.
void Sweeping::open() {
    sweep_.machine = machineOf(driver_, timing_, identityOf(study_, hashes_));
    sweep_.machine.display = inWords(study_.display);
    sweep_.machine.rows = static_cast<int>(study_.match.techniques.size() *
                                           study_.match.test.size() * study_.sizes.size());
    removeUnfinishedFiles(plan_.folder);
    if (!fs::exists(plan_.folder / "sweep.json"))
        return;
    Sweep known = readSweep(plan_.folder);
    joinMachines(sweep_.machine, std::move(known.machine), "now", plan_.folder);
    sweep_.rows = std::move(known.rows);
    sweep_.growth = std::move(known.growth);
    for (const SweepRow& row : sweep_.rows)
        measured_.insert(
            keyOf(row.configuration, row.scene, row.view, row.radius, row.width, row.height));
}

bool Sweeping::lacksGrowth() const {
    return study_.growth && plan_.part == 1 && sweep_.growth.empty();
}

double Sweeping::growthCost() const {
    if (!lacksGrowth())
        return 0;
    return growthSteps(*study_.growth) * static_cast<double>(study_.growth->techniques.size()) *
           study_.seconds;
}

// What references and timing will take, before the first of them.
void Sweeping::estimate() {
    double references = 0;
    for (const View& view : study_.match.test)
        for (const ImageSize& size : study_.sizes) {
            const auto todo = static_cast<double>(missing(view, size).size());
            references += todo > 0 ? 2 * truthCost(size, study_.match.rays) : 0;
            total_ += todo * configurationCost(size);
        }
    total_ += references + growthCost();
    requireMeasurable(study_, references, plan_.hours);
}

void Sweeping::match() {
    MatchStudy study = study_.match;
    std::erase_if(study.techniques, [&, i = -1](const TechniqueSetting&) mutable {
        return ++i % plan_.parts != plan_.part - 1;
    });
    study.test.resize(1); // the fit alone is wanted
    study.scores.clear();
    double matched = 0;
    const MatchResult result =
        obscura::match(study, folders_, plan_.folder / "match", plan_.cache, driver_,
                       [&](double done, double total, const std::string& note) {
                           matched = total;
                           progress_(done, total + total_, "matching: " + note);
                       });
    done_ += matched;
    total_ += matched;
    for (const MatchedTechnique& technique : result.techniques)
        configurations_.push_back({technique.setting, technique.fitted});
}

// Neighbours in a study are much alike, and machines drift; so those that are timed together are
// drawn by lot.
std::vector<std::size_t> Sweeping::missing(const View& view, const ImageSize& size) const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < study_.match.techniques.size(); ++i)
        if (static_cast<int>(i) % plan_.parts == plan_.part - 1 &&
            !measured_.contains(keyOf(study_.match.techniques[i].name, sceneOf(view), view.name,
                                      view.radius, size.width, size.height)))
            result.push_back(i / static_cast<std::size_t>(plan_.parts));
    Random(study_.match.seed, "groups of " + view.name).shuffle(result);
    return result;
}

TimingPlan Sweeping::timingPlan() const {
    TimingPlan plan;
    plan.frames = study_.frames;
    plan.seconds = study_.seconds;
    plan.seed = study_.match.seed;
    plan.timing = timing_.timing;
    return plan;
}

void Sweeping::measureGroup(MeasuredView& seen, std::span<const std::size_t> group) {
    const std::string note =
        fmt::format("{} {}x{}", seen.view().name, seen.size().width, seen.size().height);
    std::vector<Settings> settings;
    for (const std::size_t i : group)
        settings.push_back(settingsAt(configurations_[i], seen.view().radius, true));
    const double before = done_, cost = static_cast<double>(group.size()) * study_.seconds;
    const auto times =
        timeTechniques(seen.probe(), settings, seen.view().radius, timingPlan(), [&](double share) {
            done_ = before + share * cost;
            tell("timing " + note);
        });
    done_ = before + cost;
    for (std::size_t i = 0; i < group.size(); ++i) {
        sweep_.rows.push_back(rowOf(seen, configurations_[group[i]], times[i]));
        spend(4 * renderCost(seen.size()), "errors of " + note);
    }
    writeSweep(plan_.folder, sweep_);
}

SweepRow Sweeping::rowOf(MeasuredView& seen, const Configuration& configuration,
                         const TechniqueTime& time) {
    const Settings settings = settingsAt(configuration, seen.view().radius, false);
    SweepRow row;
    row.configuration = configuration.setting.name;
    row.technique = std::string(settings.technique().id);
    row.name = variedName(row.configuration);
    row.settings = settingsText(settings);
    for (const auto& [name, value] : configuration.fitted)
        row.fitted += fmt::format("{}{}={:g}", row.fitted.empty() ? "" : " ", name, value);
    row.scene = sceneOf(seen.view());
    row.view = seen.view().name;
    row.radius = seen.view().radius;
    row.width = seen.size().width;
    row.height = seen.size().height;
    row.frames = time.frames;
    row.total = time.total;
    for (const PassTime& pass : time.passes)
        row.work[static_cast<std::size_t>(pass.work)] += pass.median;
    row.gbuffer = time.gbuffer;
    row.toGbuffer = time.total.median / time.gbuffer;
    row.toStarcraft = time.total.median / time.starcraft;
    row.starcraftRepeat = time.starcraftRepeat;
    row.bytes = time.bytes / (1.0 * row.width * row.height);
    row.fetches = fetchesPerPixel(settings) * (1 + guardShare(settings, row.width, row.height));
    addErrors(row, seen, configuration);
    return row;
}

void Sweeping::addErrors(SweepRow& row, MeasuredView& seen, const Configuration& configuration) {
    OcclusionPasses passes =
        seen.probe().passesFor(settingsAt(configuration, seen.view().radius, false));
    for (const bool matched : {false, true}) {
        const Image image =
            seen.probe().visibility(settingsAt(configuration, seen.view().radius, matched), passes);
        const ViewErrors errors = seen.errorsOf(image);
        (matched ? row.matched : row.raw) = errors.full;
        (matched ? row.depthMatched : row.depthRaw) = errors.depth;
        (matched ? row.litMatched : row.litRaw) = errors.lit;
        if (!matched)
            continue;
        row.thumbnail =
            fmt::format("thumbnails/{}.png",
                        plainName(fmt::format("{} {} {} {} {:g}", row.configuration, row.view,
                                              row.width, row.height, row.radius)));
        const int width = 320, height = std::max(1, width * row.height / row.width);
        writePng(plan_.folder / row.thumbnail,
                 sideBySide(shrunk(grey(image), width, height),
                            shrunk(signedError(image, seen.truth(), 0.25f), width, height)));
    }
}

void Sweeping::grow(const Subject& subject, const View& view) {
    const double step = growthCost() / growthSteps(*study_.growth);
    sweep_.growth = costGrowth(*study_.growth, view, subject, study_.match.normals, timingPlan(),
                               [&] { spend(step, "how cost grows"); });
    writeSweep(plan_.folder, sweep_);
}

void Sweeping::measureScene(const std::string& sceneSha256) {
    std::optional<Scene> scene;
    std::optional<LazyTracer> tracer;
    std::optional<Subject> subject;
    const auto load = [&](const View& view) {
        if (!scene) {
            scene = loadSceneOf(view, folders_);
            tracer.emplace(*scene);
            subject.emplace(*scene);
        }
    };
    for (const View& view : study_.match.test)
        for (const ImageSize& size : study_.sizes) {
            const auto todo = missing(view, size);
            if (hashes_.of(view) != sceneSha256 || todo.empty())
                continue;
            load(view);
            const double before = done_;
            MeasuredView seen(*subject, *tracer, study_, view, size, true, folders_,
                              hashes_.of(view), plan_.cache,
                              [&](double seconds, const std::string& note) {
                                  done_ = before + seconds;
                                  tell(note);
                              });
            for (std::size_t first = 0; first < todo.size(); first += groupSize)
                measureGroup(
                    seen, std::span(todo).subspan(first, std::min(groupSize, todo.size() - first)));
        }
    for (const View& view : viewsOf(study_))
        if (lacksGrowth() && view.name == study_.growth->view && hashes_.of(view) == sceneSha256) {
            load(view);
            grow(*subject, view);
        }
}

void Sweeping::write() {
    tell("writing");
    writeSweep(plan_.folder, sweep_);
    writeFile(plan_.folder / "sweep.html", sweepPage(sweep_, plan_.folder));
    writeFigures(plan_.folder / "figures", sweepFigures(sweep_));
}

Sweep Sweeping::run() {
    open();
    estimate();
    match();
    std::set<std::string> seen;
    for (const View& view : viewsOf(study_)) // growth may be of a training view
        if (seen.insert(hashes_.of(view)).second)
            measureScene(hashes_.of(view));
    write();
    return std::move(sweep_);
}

} // namespace

std::string identityOf(const SweepStudy& study, SceneHashes& hashes) {
    std::string text = fmt::format("{}\n{} {:g} {}\n", study.match.sha256, study.frames,
                                   study.seconds, study.match.rays);
    const auto add = [&](const ImageSize& size) {
        text += fmt::format("{}x{} ", size.width, size.height);
    };
    add(study.match.training);
    for (const View& view : viewsOf(study))
        text += fmt::format("\n{} {:g} {}", view.name, view.radius, hashes.of(view));
    std::for_each(study.sizes.begin(), study.sizes.end(), add);
    text += "\n" + inWords(study.display);
    if (study.light && !study.light->environment.empty())
        text += "\n" + sha256(readFile(hashes.folders().protocol / study.light->environment));
    if (study.growth) {
        std::for_each(study.growth->sizes.begin(), study.growth->sizes.end(), add);
        text += fmt::format("\n{}", fmt::join(study.growth->radii, " "));
    }
    return sha256(text);
}

void requireMeasurable(const SweepStudy& study, double referenceSeconds, double hours) {
    for (const TechniqueSetting& each : study.match.techniques)
        if (settingsOf(each, 1).technique().reads & rays)
            throw Error(each.place, "expected a technique that runs on the GPU, found one that "
                                    "traces rays: it is the reference");
    for (std::size_t i = 0; i < study.match.train.size(); ++i)
        referenceSeconds += truthCost(study.match.training, study.match.rays);
    if (referenceSeconds > hours * 3600)
        throw Error(fmt::format(
            "expected references of at most {:g} h, found views, sizes and rays "
            "that take about {:.1f} h, less those in the cache; ask for fewer, or allow it "
            "by --hours",
            hours, referenceSeconds / 3600));
}

Sweep sweep(const SweepStudy& study, const Folders& folders, const SweepPlan& plan,
            const gl::Driver& driver, const SweepProgress& progress) {
    return Sweeping(study, folders, plan, driver, progress).run();
}

} // namespace obscura
