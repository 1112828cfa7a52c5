#pragma once

#include "matching/effort.h"
#include "matching/freedom.h"
#include "matching/match_row.h"
#include "matching/truths.h"
#include "renderer/render.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// One view of a study, and what techniques are compared with there, by name.
struct MatchCase {
    View view;
    bool train = false;
    const Probe* probe = nullptr; // nothing before it has been looked at
    std::map<std::string, Image> targets;
};

// The name under which a study's target stands in tables.
std::string targetOf(const MatchStudy& study);
// Truths to be made of a view: that which is fitted to, and those that only score.
std::vector<Truth> truthsOf(const MatchStudy& study, bool train);
// Seconds on two cores of software rendering, roughly: shares of a progress line.
double fitCost(const MatchStudy& study, const TechniqueSetting& setting);

// Fits a study's techniques on its training views, one after the other, and measures raw and fitted
// settings on all of its views. What is slow to make (scenes, truths, shaders) is made once.
class Fitting {
  public:
    // All must outlive it. Truths come from `cache` (renderer/reference/reference_cache.h).
    Fitting(const MatchStudy& study, const Folders& folders, const std::filesystem::path& cache,
            Effort& effort);
    ~Fitting();

    const std::vector<MatchCase>& cases() const { return cases_; }         // training views first
    const std::vector<std::string>& warnings() const { return warnings_; } // of scenes
    SceneHashes& hashes() { return hashes_; }

    // Makes a case's truths, unless it has them. Cases of one scene in a row load it once.
    void look(std::size_t i);
    // The same of all cases, scene by scene.
    void lookAtAll();

    // After lookAtAll().
    MatchedTechnique matched(const TechniqueSetting& setting);

  private:
    using Values = std::map<std::string, double>;
    struct Stage; // the scene at hand, whose rays are traced

    Stage& stageOf(const View& view);
    const Probe& probe(const Subject& subject, const View& view, const ImageSize& size);
    void addTruths(LazyTracer& tracer, MatchCase& at);
    void addPartner(MatchCase& at);
    Image visibility(const MatchCase& at, const Settings& settings);
    Image rawVisibility(const TechniqueSetting& setting, const MatchCase& at, Values tried,
                        double& probe);
    FittedRemap fitAt(const TechniqueSetting& setting, const Freedom& freedom, const Values& tried,
                      double& probe);
    Values fit(const TechniqueSetting& setting, std::string& note);
    std::vector<MatchRow> measure(const TechniqueSetting& setting, const Values& values,
                                  const std::string& stage);
    const ImageSize& size(const MatchCase& at) const {
        return at.train ? study_.training : study_.image;
    }

    const MatchStudy& study_;
    const Folders& folders_;
    const std::filesystem::path& cache_;
    Effort& effort_;
    SceneHashes hashes_;
    std::unique_ptr<Stage> stage_;
    std::map<std::string, std::unique_ptr<Subject>> subjects_; // by hash of the scene
    std::map<std::string, std::unique_ptr<Probe>> probes_;     // by camera's name and size
    std::vector<MatchCase> cases_;
    std::vector<std::string> warnings_;
    // Shaders take long to compile: shared by all renderings of a technique at one size, which is
    // that of training views or of others.
    std::map<bool, OcclusionPasses> passes_;
};

// A technique's settings on a view, with these values in place of its own.
Settings settingsAt(const TechniqueSetting& setting, const View& view,
                    const std::map<std::string, double>& values);

} // namespace obscura
