#include "matching/match.h"

#include "base/files.h"
#include "base/version.h"
#include "image/canvas.h"
#include "matching/effort.h"
#include "matching/freedom.h"
#include "matching/match_files.h"
#include "matching/match_sheet.h"
#include "matching/truths.h"
#include "renderer/probe.h"
#include "renderer/reference/reference_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// The name under which results stand in tables.
std::string targetOf(const MatchStudy& study) {
    return study.partner.empty() ? nameOf(study.truth) : study.partner;
}

// Truths to be made: those fitted to, and those that only score.
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

// Seconds on two cores of software rendering, roughly: shares of the progress line.
double pixelsOf(const ImageSize& size) { return 1.0 * size.width * size.height; }
double renderCost(const ImageSize& size) { return 0.2 + pixelsOf(size) * 0.7e-6; }

// One view, and what techniques are compared with there, by name.
struct Case {
    View view;
    bool train = false;
    const Probe* probe = nullptr;
    std::map<std::string, Image> targets;
};

double significant(double value) { // as the fragment gives it
    return std::stod(fmt::format("{:.4g}", value));
}

using Values = std::map<std::string, double>;

Settings settingsAt(const TechniqueSetting& setting, const View& view, const Values& values) {
    Settings settings = settingsOf(setting, view.radius);
    for (const auto& [name, value] : values)
        if (settings.has(name))
            settings.set(name, value);
    return settings;
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

class Matching {
  public:
    Matching(const MatchStudy& study, const Folders& folders, const fs::path& folder,
             const fs::path& cache, const gl::Driver& driver, const MatchProgress& progress)
        : study_(study), folders_(folders), folder_(folder), cache_(cache), driver_(driver),
          hashes_(folders), finished_(folder / "finished"), effort_(progress) {}

    MatchResult run();

  private:
    void plan();
    void look();
    void lookAt(const std::string& sceneSha256);
    const Probe& probe(const Subject& subject, const View& view, const ImageSize& size);
    void addTruths(LazyTracer& tracer, Case& at);
    void addPartner();
    std::string keyOf(const TechniqueSetting& setting);
    MatchedTechnique matched(const TechniqueSetting& setting);
    Image visibility(const Case& at, const Settings& settings);
    Image rawVisibility(const TechniqueSetting& setting, const Case& at, Values tried,
                        double& probe);
    FittedRemap fitAt(const TechniqueSetting& setting, const Freedom& freedom, const Values& tried,
                      double& probe);
    Values fit(const TechniqueSetting& setting, std::string& note);
    std::vector<MatchRow> measure(const TechniqueSetting& setting, const Values& values,
                                  const std::string& stage);
    std::vector<MatchRow> truthRows() const;
    void writeSheet();
    const ImageSize& size(const Case& at) const {
        return at.train ? study_.training : study_.image;
    }
    double techniqueCost(const TechniqueSetting& setting) const;

    const MatchStudy& study_;
    const Folders& folders_;
    const fs::path &folder_, &cache_;
    const gl::Driver& driver_;
    SceneHashes hashes_;
    FinishedTechniques finished_;
    Effort effort_;
    std::vector<std::unique_ptr<Subject>> subjects_;
    std::map<std::string, std::unique_ptr<Probe>> probes_; // by camera's name and size
    std::vector<Case> cases_;
    std::vector<std::string> keys_; // of the techniques
    // Shaders take long to compile: shared by all renderings of a technique at one size, which is
    // that of training views or of others.
    std::map<bool, OcclusionPasses> passes_;
    MatchResult result_;
};

double Matching::techniqueCost(const TechniqueSetting& setting) const {
    const Settings settings = settingsOf(setting, study_.train.front().radius);
    const Freedom freedom(setting, settings);
    const std::span<const Parameter> parameters = settings.technique().parameters;
    const bool own = std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& each) {
        return freedom.own(each).has_value();
    });
    const auto train = static_cast<double>(study_.train.size()),
               test = static_cast<double>(study_.test.size());
    const int evaluations = fitMultiplierEvaluations + 2 + (own ? fitScalesEvaluations : 0);
    return evaluations * train * renderCost(study_.training) + 2 * test * renderCost(study_.image);
}

// Everything that can be wrong with the study shows here, before the first ray.
void Matching::plan() {
    for (const bool train : {true, false})
        for (const View& view : train ? study_.train : study_.test) {
            cases_.push_back({view, train, nullptr, {}});
            result_.sceneSha256[view.file.empty() ? view.builtin : view.file] = hashes_.of(view);
            effort_.plan(static_cast<double>(truthsOf(study_, train).size()) *
                         truthCost(size(cases_.back()), study_.rays));
        }
    for (const TechniqueSetting& setting : study_.techniques) {
        const Settings settings = settingsOf(setting, study_.train.front().radius);
        if (setting.name == study_.partner && settings.technique().passes.empty())
            throw Error(setting.place, "expected a partner that darkens, found one without passes");
        keys_.push_back(keyOf(setting));
        if (!finished_.find(keys_.back()))
            effort_.plan(techniqueCost(setting));
    }
}

const Probe& Matching::probe(const Subject& subject, const View& view, const ImageSize& size) {
    std::unique_ptr<Probe>& known =
        probes_[fmt::format("{} {} {}", view.name, size.width, size.height)];
    if (!known)
        known = std::make_unique<Probe>(subject, view.camera, size.width, size.height,
                                        study_.normals, study_.seed);
    return *known;
}

void Matching::addTruths(LazyTracer& tracer, Case& at) {
    for (const Truth kind : truthsOf(study_, at.train)) {
        effort_.begin(truthCost(size(at), study_.rays),
                      fmt::format("{} reference of {}", nameOf(kind), at.view.name));
        at.targets[nameOf(kind)] = truthOf(
            kind, {at.view, size(at), study_.rays, study_.normals, study_.seed}, *at.probe, tracer,
            hashes_.of(at.view), cache_, [&](double share) { effort_.reach(share); });
        effort_.end();
    }
}

void Matching::lookAt(const std::string& sceneSha256) {
    std::optional<Scene> scene;
    std::optional<LazyTracer> tracer;
    for (Case& at : cases_) {
        if (hashes_.of(at.view) != sceneSha256)
            continue;
        if (!scene) {
            scene = loadSceneOf(at.view, folders_);
            for (const std::string& warning : scene->warnings)
                result_.warnings.push_back(fmt::format("scene \"{}\": {}", at.view.name, warning));
            subjects_.push_back(std::make_unique<Subject>(*scene));
            tracer.emplace(*scene);
        }
        at.probe = &probe(*subjects_.back(), at.view, size(at));
        addTruths(*tracer, at);
    }
}

// One scene after the other, so that only one is held by the ray tracer.
void Matching::look() {
    std::set<std::string> seen;
    for (const auto& [name, hash] : result_.sceneSha256)
        if (seen.insert(hash).second)
            lookAt(hash);
}

void Matching::addPartner() {
    for (const TechniqueSetting& setting : study_.techniques)
        if (setting.name == study_.partner)
            for (Case& at : cases_)
                at.targets[study_.partner] =
                    at.probe->visibility(settingsOf(setting, at.view.radius));
}

// All that a technique's result depends on: the recipe of each view, the truths, and this method.
std::string Matching::keyOf(const TechniqueSetting& setting) {
    Level level;
    level.ambient = Vec3{1, 1, 1};
    Sha256 hash;
    const auto add = [&](const TechniqueSetting& each) {
        for (const Case& at : cases_) {
            const Settings settings = settingsOf(each, at.view.radius);
            Recipe recipe;
            recipe.width = size(at).width;
            recipe.height = size(at).height;
            recipe.seed = study_.seed;
            recipe.view = at.view;
            recipe.view.name.clear();
            recipe.level = level;
            recipe.normals = study_.normals;
            recipe.sceneSha256 = hashes_.of(at.view);
            recipe.technique = std::string(settings.technique().id);
            recipe.settings = settings.named();
            recipe.shaderSha256 = shaderSha256(settings, level);
            recipe.codeSha256 = std::string(imageCode());
            recipe.programVersion = std::string(version());
            recipe.glVendor = driver_.vendor;
            recipe.glRenderer = driver_.renderer;
            recipe.glVersion = driver_.version;
            hash.add(fmt::format("{} {} {}\n", at.train, at.view.name, recipe.json()));
        }
        for (const Setting& given : each.settings) // what is given is not fitted
            hash.add(given.name + "\n");
    };
    hash.add(fmt::format("match 2\n{} {} {} {} {}\n", setting.name, study_.rays, rayTracerVersion(),
                         referenceCode(), matchingCode()));
    for (const bool train : {true, false})
        for (const Truth truth : truthsOf(study_, train))
            hash.add(nameOf(truth) + "\n");
    add(setting);
    for (const TechniqueSetting& partner : study_.techniques)
        if (partner.name == study_.partner)
            add(partner);
    return hash.hex();
}

Image Matching::visibility(const Case& at, const Settings& settings) {
    auto known = passes_.find(at.train);
    if (known == passes_.end())
        known = passes_.emplace(at.train, at.probe->passesFor(settings)).first;
    return at.probe->visibility(settings, known->second);
}

// Raw visibility; `probe` is the intensity to try, and falls when that clamps.
Image Matching::rawVisibility(const TechniqueSetting& setting, const Case& at, Values tried,
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

FittedRemap Matching::fitAt(const TechniqueSetting& setting, const Freedom& freedom,
                            const Values& tried, double& probe) {
    Comparison comparison;
    for (const Case& at : cases_) {
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
Values Matching::fit(const TechniqueSetting& setting, std::string& note) {
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

std::vector<MatchRow> Matching::measure(const TechniqueSetting& setting, const Values& values,
                                        const std::string& stage) {
    std::vector<MatchRow> rows;
    for (const Case& at : cases_) {
        const Image image = visibility(at, settingsAt(setting, at.view, values));
        for (const auto& [reference, target] : at.targets)
            rows.push_back({setting.name, at.view.name, at.view.radius, at.train, reference, stage,
                            imageError(image, target, at.probe->shown())});
        effort_.spend(renderCost(size(at)));
    }
    return rows;
}

MatchedTechnique Matching::matched(const TechniqueSetting& setting) {
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

// What is lost before any technique begins: the errors on test views of the other truths, against
// the one that is fitted to.
std::vector<MatchRow> Matching::truthRows() const {
    std::vector<MatchRow> rows;
    for (const Case& at : cases_)
        for (const auto& [name, image] : at.targets)
            if (const Image& target = at.targets.at(targetOf(study_)); !at.train)
                rows.push_back({name + " reference", at.view.name, at.view.radius, at.train,
                                targetOf(study_), "raw",
                                imageError(image, target, at.probe->shown())});
    return rows;
}

void Matching::writeSheet() {
    const Case& at =
        *std::find_if(cases_.begin(), cases_.end(), [](const Case& each) { return !each.train; });
    const Image& target = at.targets.at(targetOf(study_));
    std::vector<MatchPictures> pictures;
    for (const MatchedTechnique& technique : result_.techniques) {
        if (technique.rows.empty())
            continue;
        const auto render = [&](const Values& values) {
            return at.probe->visibility(settingsAt(technique.setting, at.view, values));
        };
        MatchPictures row{{}, render({}), render(technique.fitted)};
        const ImageError raw = imageError(row.raw, target, at.probe->shown()),
                         matched = imageError(row.matched, target, at.probe->shown());
        row.title = fmt::format("{}: RMSE {:.3f} raw, {:.3f} matched ({:.3f} without bias), SSIM "
                                "{:.3f}; mean occlusion {:.3f}",
                                technique.setting.name, raw.rmse, matched.rmse, matched.biasFree,
                                matched.ssim, matched.meanOcclusion);
        for (const auto& [name, value] : technique.fitted)
            row.title += fmt::format(", {} {}", name, value);
        pictures.push_back(std::move(row));
    }
    const std::vector<Image8> pages =
        matchSheet(fmt::format("{}: test view {}, radius {:g} m, compared with {}", study_.name,
                               at.view.name, at.view.radius, targetOf(study_)),
                   target, pictures);
    for (std::size_t i = 0; i < pages.size(); ++i)
        writePng(folder_ / pageName("match", i, pages.size()), pages[i]);
}

MatchResult Matching::run() {
    removeUnfinishedFiles(folder_);
    removeUnfinishedFiles(folder_ / "finished");
    plan();
    look();
    addPartner();
    result_.truths = truthRows();
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const TechniqueSetting& setting = study_.techniques[i];
        auto known = finished_.find(keys_[i]);
        result_.kept += known.has_value();
        if (!known) {
            effort_.begin(techniqueCost(setting), setting.name);
            known = matched(setting);
            finished_.add(keys_[i], *known);
            effort_.end();
        }
        known->setting = setting;
        result_.techniques.push_back(std::move(*known));
    }
    effort_.begin(0, "writing");
    writeFile(folder_ / "match.csv", matchTable(result_));
    writeFile(folder_ / "matched.toml", matchedFragment(study_, result_));
    writeSheet(); // last: what was found outlives a picture that cannot be drawn
    return std::move(result_);
}

} // namespace

MatchResult match(const MatchStudy& study, const Folders& folders, const fs::path& folder,
                  const fs::path& cache, const gl::Driver& driver, const MatchProgress& progress) {
    return Matching(study, folders, folder, cache, driver, progress).run();
}

} // namespace obscura
