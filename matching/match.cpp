#include "matching/match.h"

#include "base/files.h"
#include "base/version.h"
#include "image/canvas.h"
#include "matching/fitting.h"
#include "matching/match_files.h"
#include "matching/match_sheet.h"
#include "renderer/probe.h"
#include "renderer/reference/reference_cache.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace fs = std::filesystem;

namespace {

class Matching {
  public:
    Matching(const MatchStudy& study, const Folders& folders, const fs::path& folder,
             const fs::path& cache, const gl::Driver& driver, const MatchProgress& progress)
        : study_(study), folder_(folder), driver_(driver), finished_(folder / "finished"),
          effort_(progress), fitting_(study, folders, cache, effort_) {}

    MatchResult run();

  private:
    void plan();
    std::string keyOf(const TechniqueSetting& setting);
    std::vector<MatchRow> truthRows() const;
    void writeSheet();
    const ImageSize& size(const MatchCase& at) const {
        return at.train ? study_.training : study_.image;
    }

    const MatchStudy& study_;
    const fs::path& folder_;
    const gl::Driver& driver_;
    FinishedTechniques finished_;
    Effort effort_;
    Fitting fitting_;
    std::vector<std::string> keys_; // of the techniques
    MatchResult result_;
};

// Everything that can be wrong with the study shows here, before the first ray.
void Matching::plan() {
    for (const MatchCase& at : fitting_.cases()) {
        result_.sceneSha256[at.view.file.empty() ? at.view.builtin : at.view.file] =
            fitting_.hashes().of(at.view);
        effort_.plan(static_cast<double>(truthsOf(study_, at.train).size()) *
                     truthCost(size(at), study_.rays));
    }
    for (const TechniqueSetting& setting : study_.techniques) {
        const Settings settings = settingsOf(setting, study_.train.front().radius);
        if (setting.name == study_.partner && settings.technique().passes.empty())
            throw Error(setting.place, "expected a partner that darkens, found one without passes");
        keys_.push_back(keyOf(setting));
        if (!finished_.find(keys_.back()))
            effort_.plan(fitCost(study_, setting));
    }
}

// All that a technique's result depends on: the recipe of each view, the truths, and this method.
std::string Matching::keyOf(const TechniqueSetting& setting) {
    Level level;
    level.ambient = Vec3{1, 1, 1};
    Sha256 hash;
    const auto add = [&](const TechniqueSetting& each) {
        for (const MatchCase& at : fitting_.cases()) {
            const Settings settings = settingsOf(each, at.view.radius);
            Recipe recipe;
            recipe.width = size(at).width;
            recipe.height = size(at).height;
            recipe.seed = study_.seed;
            recipe.view = at.view;
            recipe.view.name.clear();
            recipe.level = level;
            recipe.normals = study_.normals;
            recipe.sceneSha256 = fitting_.hashes().of(at.view);
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

// What is lost before any technique begins: the errors on test views of the other truths, against
// the one that is fitted to.
std::vector<MatchRow> Matching::truthRows() const {
    std::vector<MatchRow> rows;
    for (const MatchCase& at : fitting_.cases())
        for (const auto& [name, image] : at.targets)
            if (const Image& target = at.targets.at(targetOf(study_)); !at.train)
                rows.push_back({name + " reference", at.view.name, at.view.radius, at.train,
                                targetOf(study_), "raw",
                                imageError(image, target, at.probe->shown())});
    return rows;
}

void Matching::writeSheet() {
    const MatchCase& at = *std::find_if(fitting_.cases().begin(), fitting_.cases().end(),
                                        [](const MatchCase& each) { return !each.train; });
    const Image& target = at.targets.at(targetOf(study_));
    std::vector<MatchPictures> pictures;
    for (const MatchedTechnique& technique : result_.techniques) {
        if (technique.rows.empty())
            continue;
        const auto render = [&](const std::map<std::string, double>& values) {
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
    fitting_.lookAtAll();
    result_.warnings = fitting_.warnings();
    result_.truths = truthRows();
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const TechniqueSetting& setting = study_.techniques[i];
        auto known = finished_.find(keys_[i]);
        result_.kept += known.has_value();
        if (!known) {
            effort_.begin(fitCost(study_, setting), setting.name);
            known = fitting_.matched(setting);
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
