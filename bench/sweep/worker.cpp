#include "bench/sweep/worker.h"

#include "base/files.h"
#include "bench/sweep/cost_growth.h"
#include "image/canvas.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

using Kind = SweepUnit::Kind;

MatchStudy trainedOf(MatchStudy study) {
    study.test.clear();
    study.scores.clear();
    return study;
}

// A unit whose result is in the cache of references, or can be made again for it.
const std::string made = "made";

} // namespace

struct SweepWorker::Stage {
    Stage(std::string hash, Scene loaded)
        : sha256(std::move(hash)), scene(std::move(loaded)), tracer(scene), subject(scene) {}
    std::string sha256;
    Scene scene;
    LazyTracer tracer;
    Subject subject;
};

SweepWorker::SweepWorker(const SweepStudy& study, const Folders& folders,
                         const std::filesystem::path& folder, const std::filesystem::path& cache,
                         const TimedOn& machine, gl::Timing timing, const UnitProgress& progress)
    : study_(study), folders_(folders), folder_(folder), cache_(cache), machine_(machine),
      timing_(timing), progress_(progress), hashes_(folders), trained_(trainedOf(study.match)),
      fitProgress_([this](double done, double, const std::string& note) {
          spentOnFits_ = done;
          progress_(done - spentBefore_, note);
      }),
      effort_(fitProgress_) {}

SweepWorker::~SweepWorker() = default;

Fitting& SweepWorker::fitting() {
    if (!fitting_)
        fitting_ = std::make_unique<Fitting>(trained_, folders_, cache_, effort_);
    spentBefore_ = spentOnFits_;
    return *fitting_;
}

std::string SweepWorker::fit(const SweepUnit& unit) {
    Fitting& all = fitting();
    all.lookAtAll();
    spentBefore_ = spentOnFits_;
    const TechniqueSetting& setting = study_.match.techniques[unit.configurations.front()];
    effort_.begin(unit.unit.cost, "fit of " + setting.name);
    const MatchedTechnique matched = all.matched(setting);
    effort_.end();
    return fitResult(matched.fitted);
}

SweepWorker::Stage& SweepWorker::stageOf(const View& view) {
    const std::string sha256 = hashes_.of(view);
    if (!stage_ || stage_->sha256 != sha256) {
        seen_.reset();
        timed_.reset();
        place_.clear();
        stage_ = nullptr; // before the next is loaded
        stage_ = std::make_unique<Stage>(sha256, loadSceneOf(view, folders_));
    }
    return *stage_;
}

// The unit's view with its references.
void SweepWorker::see(const SweepUnit& unit) {
    const View& view = study_.match.test[unit.view];
    Stage& stage = stageOf(view);
    if (seen_ && place_ == unit.unit.group)
        return;
    seen_.reset();
    timed_.reset();
    seen_.emplace(stage.subject, stage.tracer, study_, view, unit.size, true, folders_,
                  stage.sha256, cache_, progress_);
    place_ = unit.unit.group;
}

const Configuration& SweepWorker::configuration(std::size_t i, const Units& units) {
    const auto known = configurations_.find(i);
    if (known != configurations_.end())
        return known->second;
    const TechniqueSetting& setting = study_.match.techniques[i];
    const auto fit = units.result("fit of " + setting.name);
    return configurations_.emplace(i, Configuration{setting, fitIn(fit.value())}).first->second;
}

std::string SweepWorker::errors(const SweepUnit& unit, Units& units) {
    // Its references are a unit of their own, so that one process traces them while others wait.
    if (const std::string own = "references of " + unit.unit.group; !units.isDone(own))
        units.require(own, [&] {
            see(unit);
            return made;
        });
    see(unit);
    const Configuration& configuration = this->configuration(unit.configurations.front(), units);
    progress_(0, unit.unit.name);
    const double radius = seen_->view().radius;
    OcclusionPasses passes = seen_->probe().passesFor(settingsAt(configuration, radius, false));
    ErrorsResult result{{}, machine_.renderer};
    for (const bool matched : {false, true}) {
        const Image image =
            seen_->probe().visibility(settingsAt(configuration, radius, matched), passes);
        const ViewErrors errors = seen_->errorsOf(image);
        (matched ? result.errors.matched : result.errors.raw) = errors.full;
        (matched ? result.errors.depthMatched : result.errors.depthRaw) = errors.depth;
        (matched ? result.errors.litMatched : result.errors.litRaw) = errors.lit;
        if (!matched)
            continue;
        result.errors.thumbnail = fmt::format(
            "thumbnails/{}.png",
            plainName(fmt::format("{} {} {} {} {:g}", configuration.setting.name,
                                  seen_->view().name, unit.size.width, unit.size.height, radius)));
        const int width = 320, height = std::max(1, width * unit.size.height / unit.size.width);
        writePng(folder_ / result.errors.thumbnail,
                 sideBySide(shrunk(grey(image), width, height),
                            shrunk(signedError(image, seen_->truth(), 0.25f), width, height)));
    }
    return errorsResult(result);
}

TimingPlan SweepWorker::timingPlan() const {
    TimingPlan plan;
    plan.frames = study_.frames;
    plan.seconds = study_.seconds;
    plan.seed = study_.match.seed;
    plan.timing = timing_;
    return plan;
}

std::string SweepWorker::times(const SweepUnit& unit, Units& units) {
    const View& view = study_.match.test[unit.view];
    Stage& stage = stageOf(view);
    if (!timed_ || place_ != unit.unit.group) {
        seen_.reset();
        timed_.reset();
        timed_.emplace(stage.subject, view.camera, unit.size.width, unit.size.height,
                       study_.match.normals, study_.match.seed);
        place_ = unit.unit.group;
    }
    std::vector<Settings> settings;
    for (const std::size_t i : unit.configurations)
        settings.push_back(settingsAt(configuration(i, units), view.radius, true));
    TimesResult result{machine_, {}, {}};
    for (const TechniqueTime& time :
         timeTechniques(*timed_, settings, view.radius, timingPlan(), [&](double share) {
             progress_(share * unit.unit.cost, "timing " + unit.unit.group);
         })) {
        SweepTimes& row = result.rows.emplace_back();
        row.frames = time.frames;
        row.total = time.total;
        row.work = {};
        for (const PassTime& pass : time.passes)
            row.work[static_cast<std::size_t>(pass.work)] += pass.median;
        row.gbuffer = time.gbuffer;
        row.toGbuffer = time.total.median / time.gbuffer;
        row.toStarcraft = time.total.median / time.starcraft;
        row.starcraftRepeat = time.starcraftRepeat;
    }
    return timesResult(result);
}

std::string SweepWorker::growth() {
    std::vector<View> views = study_.match.train; // it may be one of these
    views.insert(views.end(), study_.match.test.begin(), study_.match.test.end());
    const View& view = *std::find_if(views.begin(), views.end(), [&](const View& each) {
        return each.name == study_.growth->view;
    });
    int step = 0;
    const double cost = static_cast<double>(study_.growth->techniques.size()) * study_.seconds;
    progress_(0, "how cost grows");
    return timesResult(
        {machine_,
         {},
         costGrowth(*study_.growth, view, stageOf(view).subject, study_.match.normals, timingPlan(),
                    [&] { progress_(++step * cost, "how cost grows"); })});
}

std::string SweepWorker::work(const SweepUnit& unit, Units& units) {
    if (unit.kind != Kind::training && unit.kind != Kind::fit)
        fitting_ = nullptr; // fits are done
    switch (unit.kind) {
    case Kind::training:
        fitting().look(unit.view);
        return made;
    case Kind::fit:
        return fit(unit);
    case Kind::references:
        see(unit);
        return made;
    case Kind::errors:
        return errors(unit, units);
    case Kind::times:
        return times(unit, units);
    default:
        return growth();
    }
}

} // namespace obscura
