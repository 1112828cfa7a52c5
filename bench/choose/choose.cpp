#include "bench/choose/choose.h"

#include "bench/measure/timing.h"
#include "bench/motion/steadiness.h"
#include "bench/sweep/summary.h"
#include "matching/match.h"
#include "matching/match_files.h"
#include "matching/truths.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

namespace obscura {

namespace {

constexpr ImageSize glanceSize{160, 90};
constexpr int glanceRays = 64, glanceFrames = 5;
// A glance sees one small view: what is over the budget by less than this may still meet it.
constexpr double glanceFactor = 1.5, glanceMargin = 0.02;
// Costs by a few frames that differ by less than this are not told apart.
constexpr double nearlyAlike = 1.15;

// Each scene of a study, once loaded, with its views measured so far.
class Stages {
  public:
    Stages(const SweepStudy& study, const Folders& folders, const SweepPlan& plan,
           const std::function<void(const std::string&)>& tell)
        : study_(study), folders_(folders), plan_(plan), tell_(tell), hashes_(folders) {}

    MeasuredView& view(std::size_t i) {
        const View& view = study_.match.test[i];
        std::unique_ptr<MeasuredView>& known = views_[i];
        if (!known) {
            Stage& stage = stageOf(view);
            const auto start = std::chrono::steady_clock::now();
            known = std::make_unique<MeasuredView>(
                stage.subject, stage.tracer, study_, view, study_.sizes.front(), false, folders_,
                hashes_.of(view), plan_.cache,
                [&](double, const std::string& note) { tell_(note); });
            references_ +=
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        }
        return *known;
    }
    const Scene& scene(std::size_t i) { return stageOf(study_.match.test[i]).scene; }
    std::size_t count() const { return study_.match.test.size(); }
    double secondsForReferences() const { return references_; }

  private:
    struct Stage {
        explicit Stage(Scene loaded) : scene(std::move(loaded)), tracer(scene), subject(scene) {}
        Scene scene;
        LazyTracer tracer;
        Subject subject;
    };
    Stage& stageOf(const View& view) {
        std::unique_ptr<Stage>& known = stages_[sceneOf(view)];
        if (!known)
            known = std::make_unique<Stage>(loadSceneOf(view, folders_));
        return *known;
    }

    const SweepStudy& study_;
    const Folders& folders_;
    const SweepPlan& plan_;
    const std::function<void(const std::string&)>& tell_;
    SceneHashes hashes_;
    std::map<std::string, std::unique_ptr<Stage>> stages_;
    std::map<std::size_t, std::unique_ptr<MeasuredView>> views_;
    double references_ = 0;
};

class Choosing {
  public:
    Choosing(const SweepStudy& study, const Budget& budget, const Folders& folders,
             const SweepPlan& plan, const gl::Driver& driver, const SweepProgress& progress)
        : study_(study), budget_(budget), folders_(folders), plan_(plan), driver_(driver),
          progress_(progress), tell_([this](const std::string& note) { tell(note); }),
          stages_(study, folders, plan, tell_), timing_(gl::honestTiming().timing) {}

    Choice run();

  private:
    void glance();
    void timeAll();
    void measure(Candidate& candidate);
    std::vector<std::size_t> finalists(std::size_t& next);
    void timeAtLength(std::span<const std::size_t> finalists);
    void testSteadiness(std::span<const std::size_t> finalists);
    std::map<std::string, MatchedTechnique> fits(const MatchStudy& study,
                                                 const std::string& folder);
    std::vector<Milliseconds> milliseconds(std::size_t view, const std::vector<Settings>& settings,
                                           int frames, double seconds, bool last);
    void tell(const std::string& note) {
        const auto all = static_cast<double>(3 * study_.match.techniques.size());
        progress_(std::min(done_, all), all, note);
    }

    const SweepStudy& study_;
    const Budget& budget_;
    const Folders& folders_;
    const SweepPlan& plan_;
    const gl::Driver& driver_;
    const SweepProgress& progress_;
    const std::function<void(const std::string&)> tell_;
    Stages stages_;
    gl::Timing timing_;
    Choice choice_;
    double done_ = 0; // in candidates, each rung counting alike
};

std::vector<Milliseconds> Choosing::milliseconds(std::size_t view,
                                                 const std::vector<Settings>& settings, int frames,
                                                 double seconds, bool last) {
    TimingPlan plan;
    plan.frames = frames;
    plan.seconds = seconds;
    plan.seed = study_.match.seed;
    plan.timing = timing_;
    const double before = done_;
    MeasuredView& seen = stages_.view(view);
    const auto times =
        timeTechniques(seen.probe(), settings, seen.view().radius, plan, [&](double share) {
            if (!last)
                done_ = before + share * static_cast<double>(settings.size());
            tell("timing");
        });
    std::vector<Milliseconds> result;
    result.reserve(times.size());
    for (const TechniqueTime& time : times)
        result.push_back(time.total);
    return result;
}

std::map<std::string, MatchedTechnique> Choosing::fits(const MatchStudy& study,
                                                       const std::string& folder) {
    const double before = done_;
    const auto candidates = static_cast<double>(study.techniques.size());
    const MatchResult result =
        obscura::match(study, folders_, plan_.folder / folder, plan_.cache, driver_,
                       [&](double done, double total, const std::string& note) {
                           done_ = before + (total > 0 ? done / total * candidates : 0);
                           tell("matching " + note);
                       });
    done_ = before + candidates;
    std::map<std::string, MatchedTechnique> byName;
    for (const MatchedTechnique& technique : result.techniques)
        byName[technique.setting.name] = technique;
    return byName;
}

void Choosing::glance() {
    MatchStudy study = study_.match;
    study.train.resize(1);
    study.test.resize(1);
    study.training = study.image = glanceSize;
    study.rays = std::min(study.rays, glanceRays);
    study.scores.clear();
    const auto fitted = fits(study, "glance");
    for (const TechniqueSetting& technique : study_.match.techniques) {
        const MatchedTechnique& matched = fitted.at(technique.name);
        Candidate candidate;
        candidate.configuration = {technique, matched.fitted};
        candidate.glanceRmse = summaryOf(matched.rows, nameOf(study.truth), "matched").rmse;
        candidate.rmse = candidate.milliseconds = std::numeric_limits<double>::quiet_NaN();
        if (budget_.rmse && candidate.glanceRmse > *budget_.rmse * glanceFactor + glanceMargin)
            candidate.verdict = fmt::format("RMSE {:.3f} at a glance, budget {:.3f}",
                                            candidate.glanceRmse, *budget_.rmse);
        choice_.candidates.push_back(std::move(candidate));
    }
}

// As matched at a glance, for a radius changes the cost.
void Choosing::timeAll() {
    const double radius = study_.match.test.front().radius;
    std::vector<Settings> settings;
    for (const Candidate& candidate : choice_.candidates)
        settings.push_back(settingsAt(candidate.configuration, radius, true));
    const auto times =
        milliseconds(0, settings, glanceFrames, std::numeric_limits<double>::infinity(), false);
    for (std::size_t i = 0; i < times.size(); ++i) {
        Candidate& candidate = choice_.candidates[i];
        candidate.glanceMilliseconds = times[i].median;
        if (candidate.verdict.empty() && budget_.milliseconds &&
            candidate.glanceMilliseconds > *budget_.milliseconds * glanceFactor)
            candidate.verdict = fmt::format("{:.3g} ms at a glance, budget {:.3g}",
                                            candidate.glanceMilliseconds, *budget_.milliseconds);
    }
    std::stable_sort(choice_.candidates.begin(), choice_.candidates.end(),
                     [](const Candidate& a, const Candidate& b) {
                         return a.glanceMilliseconds < b.glanceMilliseconds;
                     });
}

// Fits the candidate on all training views, and measures it on all others at full size.
void Choosing::measure(Candidate& candidate) {
    MatchStudy study = study_.match;
    study.test.resize(1); // the fit alone is wanted
    study.scores.clear();
    std::erase_if(study.techniques, [&](const TechniqueSetting& each) {
        return each.name != candidate.configuration.setting.name;
    });
    candidate.configuration.fitted = fits(study, "match").begin()->second.fitted;
    candidate.rung = Rung::held_out;
    candidate.rmse = 0;
    for (std::size_t i = 0; i < stages_.count(); ++i) {
        MeasuredView& seen = stages_.view(i);
        const Image image =
            seen.probe().visibility(settingsAt(candidate.configuration, seen.view().radius, true));
        const ViewErrors errors = seen.errorsOf(image);
        candidate.views.push_back({errors.full.rmse, errors.full.flip, errors.lit.flip, 0,
                                   0}); // the rest is not known yet
        candidate.rmse += errors.full.rmse / static_cast<double>(stages_.count());
        tell("measuring " + candidate.configuration.setting.name);
    }
}

// Looks at candidates from `next` on and returns the first that meets the limits on errors, and
// those of nearly the same cost that meet them too. Afterwards `next` is the first candidate that
// was not looked at.
std::vector<std::size_t> Choosing::finalists(std::size_t& next) {
    std::vector<std::size_t> found;
    for (; next < choice_.candidates.size(); ++next) {
        Candidate& candidate = choice_.candidates[next];
        if (!found.empty() &&
            candidate.glanceMilliseconds >
                nearlyAlike * choice_.candidates[found.front()].glanceMilliseconds)
            break;
        if (!candidate.verdict.empty())
            continue;
        measure(candidate);
        candidate.verdict = excess(budget_, candidate.views);
        if (candidate.verdict.empty())
            found.push_back(next);
    }
    return found;
}

// Times the finalists on every view for as long as a sweep would, and puts them into their new
// order.
void Choosing::timeAtLength(std::span<const std::size_t> finalists) {
    for (const std::size_t f : finalists)
        choice_.candidates[f].milliseconds = 0;
    for (std::size_t i = 0; i < stages_.count(); ++i) {
        std::vector<Settings> settings;
        for (const std::size_t f : finalists)
            settings.push_back(settingsAt(choice_.candidates[f].configuration,
                                          stages_.view(i).view().radius, true));
        const auto times = milliseconds(i, settings, study_.frames, study_.seconds, true);
        for (std::size_t k = 0; k < finalists.size(); ++k) {
            Candidate& candidate = choice_.candidates[finalists[k]];
            candidate.views[i].milliseconds = times[k].high;
            candidate.milliseconds += times[k].median / static_cast<double>(stages_.count());
        }
    }
    std::vector<Candidate> order;
    for (const std::size_t f : finalists)
        order.push_back(std::move(choice_.candidates[f]));
    std::stable_sort(order.begin(), order.end(), [](const Candidate& a, const Candidate& b) {
        return a.milliseconds < b.milliseconds;
    });
    for (std::size_t k = 0; k < finalists.size(); ++k)
        choice_.candidates[finalists[k]] = std::move(order[k]);
}

// First the failure tests, which are quick; then motion from every view, for all finalists at once,
// because what takes long is the truth of each frame.
void Choosing::testSteadiness(std::span<const std::size_t> finalists) {
    std::vector<std::size_t> left;
    for (const std::size_t f : finalists) {
        Candidate& candidate = choice_.candidates[f];
        candidate.verdict = excess(budget_, candidate.views);
        if (candidate.verdict.empty() && !budget_.failures.empty()) {
            tell("failure tests of " + candidate.configuration.setting.name);
            candidate.verdict = failuresOf(
                settingsAt(candidate.configuration, study_.match.test.front().radius, true),
                budget_.failures, plan_.folder / "failures");
        }
        if (candidate.verdict.empty())
            left.push_back(f);
    }
    if (!budget_.flicker || left.empty())
        return;
    for (std::size_t i = 0; i < stages_.count(); ++i) {
        const View& view = study_.match.test[i];
        tell("flicker from " + view.name);
        std::vector<NamedSettings> named;
        for (const std::size_t f : left) {
            const Configuration& configuration = choice_.candidates[f].configuration;
            named.push_back(
                {configuration.setting.name, settingsAt(configuration, view.radius, true)});
        }
        const auto flicker =
            flickerOf(stages_.scene(i), view, named, plan_.folder / "flicker" / view.name);
        for (std::size_t k = 0; k < left.size(); ++k)
            choice_.candidates[left[k]].views[i].flicker = flicker[k];
    }
    for (const std::size_t f : left)
        choice_.candidates[f].verdict = excess(budget_, choice_.candidates[f].views);
}

Choice Choosing::run() {
    const auto start = std::chrono::steady_clock::now();
    glance();
    timeAll();
    for (std::size_t next = 0; next < choice_.candidates.size() && !choice_.chosen;) {
        const std::vector<std::size_t> final = finalists(next);
        if (final.empty())
            break;
        timeAtLength(final);
        testSteadiness(final);
        const auto first = std::find_if(final.begin(), final.end(), [&](std::size_t f) {
            return choice_.candidates[f].verdict.empty();
        });
        if (first == final.end())
            continue;
        choice_.chosen = *first;
        choice_.candidates[*first].rung = Rung::chosen;
    }
    choice_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() -
        stages_.secondsForReferences();
    return std::move(choice_);
}

} // namespace

Choice choose(const SweepStudy& study, const Budget& budget, const Folders& folders,
              const SweepPlan& plan, const gl::Driver& driver, const SweepProgress& progress) {
    if (budget.litFlip && !study.light)
        throw Error("expected a study with [light] for a limit on litFlip, found one without");
    if ((budget.rmse || budget.flip || budget.litFlip || budget.flicker) &&
        study.match.test.size() < 2)
        throw Error(
            fmt::format("expected at least two test views, for a limit on errors or flicker "
                        "is met with confidence over views, found {}",
                        study.match.test.size()));
    requireMeasurable(study,
                      static_cast<double>(study.match.test.size()) *
                          truthCost(study.sizes.front(), study.match.rays),
                      plan.hours);
    return Choosing(study, budget, folders, plan, driver, progress).run();
}

std::string chosenFrom(const Sweep& sweep, const Budget& budget) {
    struct Measured {
        double milliseconds = 0; // sum over views
        std::vector<ViewResult> views;
    };
    std::map<std::string, Measured> all;
    std::size_t most = 0;
    for (const SweepRow& row : atTypicalSpeed(sweep.rows)) {
        Measured& measured = all[row.configuration];
        measured.milliseconds += row.total.median;
        measured.views.push_back(
            {row.matched.rmse, row.matched.flip, row.litMatched.flip, row.total.high, 0});
        most = std::max(most, measured.views.size());
    }
    std::string best;
    for (const auto& [name, measured] : all)
        if (measured.views.size() == most && excess(budget, measured.views).empty() &&
            (best.empty() || measured.milliseconds < all[best].milliseconds))
            best = name;
    return best;
}

} // namespace obscura
