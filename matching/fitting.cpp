#include "matching/fitting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace obscura {

namespace {

double renderCost(const ImageSize& size) { return 0.2 + 0.7e-6 * size.width * size.height; }

double significant(double value) { // as the fragment gives it
    return std::stod(fmt::format("{:.4g}", value));
}

// Where the last pass clamps more than a few pixels at black, occlusion is rendered fainter: at
// this intensity a raw visibility down to 1 - 1 / 0.125 is told apart, at an eighth of the
// precision of a half-float.
constexpr double faintly = 0.125, fewPixels = 0.001;

bool clampsAtBlack(const Image& image, const std::vector<bool>& shown) {
    double black = 0, all = 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (shown[i]) {
            black += image.pixels[i] <= 0;
            ++all;
        }
    return black > fewPixels * all;
}

} // namespace

std::string targetOf(const MatchStudy& study) {
    return study.partner.empty() ? nameOf(study.truth) : study.partner;
}

std::vector<Truth> truthsOf(const MatchStudy& study, bool train) {
    std::vector<Truth> truths;
    if (study.partner.empty())
        truths.push_back(study.truth);
    if (!train)
        for (const Truth truth : study.scores)
            if (std::find(truths.begin(), truths.end(), truth) == truths.end())
                truths.push_back(truth);
    return truths;
}

Settings settingsAt(const TechniqueSetting& setting, const View& view,
                    const std::map<std::string, double>& values) {
    Settings settings = settingsOf(setting, view.radius);
    for (const auto& [name, value] : values)
        if (settings.has(name))
            settings.set(name, value);
    return settings;
}

double fitCost(const MatchStudy& study, const TechniqueSetting& setting) {
    const Settings settings = settingsOf(setting, study.train.front().radius);
    const Freedom freedom(setting, settings);
    const std::span<const Parameter> parameters = settings.technique().parameters;
    const bool own = std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& each) {
        return freedom.own(each).has_value();
    });
    const auto train = static_cast<double>(study.train.size()),
               test = static_cast<double>(study.test.size());
    const int evaluations = fitMultiplierEvaluations + 2 + (own ? fitScalesEvaluations : 0);
    return evaluations * train * renderCost(study.training) + 2 * test * renderCost(study.image);
}

// One scene at a time, so that only one is held by the ray tracer.
struct Fitting::Stage {
    Stage(std::string hash, Scene loaded)
        : sha256(std::move(hash)), scene(std::move(loaded)), tracer(scene) {}
    std::string sha256;
    Scene scene;
    LazyTracer tracer;
};

Fitting::Fitting(const MatchStudy& study, const Folders& folders,
                 const std::filesystem::path& cache, Effort& effort)
    : study_(study), folders_(folders), cache_(cache), effort_(effort), hashes_(folders) {
    for (const bool train : {true, false})
        for (const View& view : train ? study_.train : study_.test)
            cases_.push_back({view, train, nullptr, {}});
}

Fitting::~Fitting() = default;

Fitting::Stage& Fitting::stageOf(const View& view) {
    const std::string sha256 = hashes_.of(view);
    if (!stage_ || stage_->sha256 != sha256) {
        stage_ = nullptr; // before the next is loaded
        stage_ = std::make_unique<Stage>(sha256, loadSceneOf(view, folders_));
    }
    std::unique_ptr<Subject>& subject = subjects_[sha256];
    if (!subject) {
        for (const std::string& warning : stage_->scene.warnings)
            warnings_.push_back(fmt::format("scene \"{}\": {}", view.name, warning));
        subject = std::make_unique<Subject>(stage_->scene);
    }
    return *stage_;
}

const Probe& Fitting::probe(const Subject& subject, const View& view, const ImageSize& size) {
    std::unique_ptr<Probe>& known =
        probes_[fmt::format("{} {} {}", view.name, size.width, size.height)];
    if (!known)
        known = std::make_unique<Probe>(subject, view.camera, size.width, size.height,
                                        study_.normals, study_.seed);
    return *known;
}

void Fitting::addTruths(LazyTracer& tracer, MatchCase& at) {
    for (const Truth kind : truthsOf(study_, at.train)) {
        effort_.begin(truthCost(size(at), study_.rays),
                      fmt::format("{} reference of {}", nameOf(kind), at.view.name));
        at.targets[nameOf(kind)] = truthOf(
            kind, {at.view, size(at), study_.rays, study_.normals, study_.seed}, *at.probe, tracer,
            hashes_.of(at.view), cache_, [&](double share) { effort_.reach(share); });
        effort_.end();
    }
}

void Fitting::addPartner(MatchCase& at) {
    for (const TechniqueSetting& setting : study_.techniques)
        if (setting.name == study_.partner)
            at.targets[study_.partner] = at.probe->visibility(settingsOf(setting, at.view.radius));
}

void Fitting::look(std::size_t i) {
    MatchCase& at = cases_[i];
    if (at.probe)
        return;
    Stage& stage = stageOf(at.view);
    at.probe = &probe(*subjects_.at(stage.sha256), at.view, size(at));
    addTruths(stage.tracer, at);
    addPartner(at);
}

void Fitting::lookAtAll() {
    std::set<std::string> seen;
    for (const MatchCase& first : cases_)
        if (const std::string scene = hashes_.of(first.view); seen.insert(scene).second)
            for (std::size_t i = 0; i < cases_.size(); ++i)
                if (hashes_.of(cases_[i].view) == scene)
                    look(i);
    stage_ = nullptr;
}

Image Fitting::visibility(const MatchCase& at, const Settings& settings) {
    auto known = passes_.find(at.train);
    if (known == passes_.end())
        known = passes_.emplace(at.train, at.probe->passesFor(settings)).first;
    return at.probe->visibility(settings, known->second);
}

// Raw visibility; `probe` is the intensity to try, and falls when that clamps.
Image Fitting::rawVisibility(const TechniqueSetting& setting, const MatchCase& at, Values tried,
                             double& probe) {
    tried["power"] = 1;
    Settings settings = settingsAt(setting, at.view, tried);
    const auto render = [&] {
        if (settings.has("intensity"))
            settings.set("intensity", probe);
        return visibility(at, settings);
    };
    Image image = render();
    if (probe == 1 && settings.has("intensity") && clampsAtBlack(image, at.probe->shown())) {
        probe = faintly;
        image = render();
    }
    return image;
}

FittedRemap Fitting::fitAt(const TechniqueSetting& setting, const Freedom& freedom,
                           const Values& tried, double& probe) {
    Comparison comparison;
    for (const MatchCase& at : cases_) {
        if (!at.train)
            continue;
        const Image image = rawVisibility(setting, at, tried, probe);
        comparison.add(image, probe, at.targets.at(targetOf(study_)), at.probe->shown());
        effort_.spend(renderCost(study_.training));
    }
    const Tunable tunable{
        {freedom.start("intensity"), freedom.start("power")}, freedom.intensity(), freedom.power()};
    return fitRemap(comparison, tunable,
                    study_.partner.empty() ? Criterion::leastSquares : Criterion::equalMean);
}

// The values that were fitted, rounded as the fragment gives them.
Fitting::Values Fitting::fit(const TechniqueSetting& setting, std::string& note) {
    const Settings settings = settingsOf(setting, study_.train.front().radius);
    const Freedom freedom(setting, settings);
    if (setting.name == study_.partner) {
        note = "the partner: as it is";
        return {};
    }
    std::vector<std::string> names; // of what each trial is rendered with
    std::vector<Range> ranges;
    std::vector<double> best;
    const auto free = [&](std::string_view name, const std::optional<Range>& range) {
        if (!range)
            return;
        names.emplace_back(name);
        ranges.push_back(*range);
        best.push_back(freedom.start(name));
    };
    free("radiusMultiplier", freedom.multiplier());
    for (const Parameter& parameter : settings.technique().parameters)
        free(parameter.name, freedom.own(parameter));
    if (names.empty() && !freedom.intensity() && !freedom.power()) {
        note = "has nothing to fit";
        return {};
    }
    std::map<std::vector<double>, FittedRemap> tried;
    double probe = 1;
    const auto error = [&](const std::vector<double>& at) {
        const auto found = tried.find(at);
        if (found != tried.end())
            return found->second.error;
        Values values;
        for (std::size_t i = 0; i < at.size(); ++i)
            values[names[i]] = at[i];
        return (tried[at] = fitAt(setting, freedom, values, probe)).error;
    };
    if (freedom.multiplier()) {
        const auto along = [&](double multiplier) {
            std::vector<double> at = best;
            at[0] = multiplier;
            return error(at);
        };
        best[0] = fitMultiplier(along, best[0], ranges[0]);
    }
    if (names.size() > (freedom.multiplier() ? 1u : 0u))
        best = fitScales(error, best, ranges);
    error(best);
    Values values;
    const auto put = [&](const std::string& name, const std::optional<Range>& range, double value,
                         bool isExponential = false) {
        if (!range)
            return;
        const double size = std::abs(value);
        values[name] = std::copysign(std::clamp(significant(size), range->low, range->high), value);
        if (size < range->low * 1.001 || (size > range->high * 0.999 && !isExponential))
            note += fmt::format("{}{} ended at its bound", note.empty() ? "" : "; ", name);
    };
    for (std::size_t i = 0; i < names.size(); ++i)
        put(names[i], ranges[i], best[i]);
    put("intensity", freedom.intensity(), tried[best].remap.intensity);
    put("power", freedom.power(), tried[best].remap.power, freedom.intensity().has_value());
    return values;
}

std::vector<MatchRow> Fitting::measure(const TechniqueSetting& setting, const Values& values,
                                       const std::string& stage) {
    std::vector<MatchRow> rows;
    for (const MatchCase& at : cases_) {
        const Image image = visibility(at, settingsAt(setting, at.view, values));
        for (const auto& [reference, target] : at.targets)
            rows.push_back({setting.name, at.view.name, at.view.radius, at.train, reference, stage,
                            imageError(image, target, at.probe->shown())});
        effort_.spend(renderCost(size(at)));
    }
    return rows;
}

MatchedTechnique Fitting::matched(const TechniqueSetting& setting) {
    MatchedTechnique technique;
    if (settingsOf(setting, 1).technique().reads & rays) {
        technique.note = "traces rays itself: it is the reference, and not matched";
        return technique;
    }
    passes_.clear();
    technique.fitted = fit(setting, technique.note);
    for (const bool raw : {true, false}) {
        const auto rows =
            measure(setting, raw ? Values{} : technique.fitted, raw ? "raw" : "matched");
        technique.rows.insert(technique.rows.end(), rows.begin(), rows.end());
    }
    return technique;
}

} // namespace obscura
