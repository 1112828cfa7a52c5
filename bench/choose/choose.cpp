#include "bench/choose/choose.h"

#include "bench/choose/results.h"
#include "bench/choose/stages.h"
#include "bench/measure/machine.h"
#include "bench/measure/timing.h"
#include "bench/motion/steadiness.h"
#include "bench/sweep/summary.h"
#include "matching/match.h"
#include "matching/match_files.h"
#include "matching/truths.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

namespace obscura {

namespace {

constexpr ImageSize glanceSize{160, 90};
constexpr int glanceRays = 64, glanceFrames = 5;
// Errors on a few small views that differ by less than this are not told apart.
constexpr double rmseAlike = 0.03;
// Candidates that are asked at once about what takes long: their truth is the same.
constexpr std::size_t together = 3;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const std::string& nameOf(const Candidate& candidate) {
    return candidate.configuration.setting.name;
}

ViewResult resultOn(MeasuredView& seen, const Configuration& configuration) {
    const ViewErrors errors =
        seen.errorsOf(seen.probe().visibility(settingsAt(configuration, seen.view().radius, true)));
    return resultOf(errors.full, errors.lit);
}

class Choosing {
  public:
    Choosing(const SweepStudy& study, const Budget& budget, const Folders& folders,
             const SweepPlan& plan, const gl::Driver& driver, const SweepProgress& progress)
        : study_(study), budget_(budget), folders_(folders), plan_(plan), driver_(driver),
          progress_(progress), tell_([this](const std::string& note) { tell(note); }),
          stages_(study, folders, plan, tell_), timing_(gl::honestTiming()) {}

    Choice run();

  private:
    using Candidates = std::vector<Candidate*>;

    void glance();
    void timeAll();
    void dropDominated();
    std::pair<Candidates, Candidates> contenders();
    Candidates nearestAtAGlance();
    void fit(const Candidates& contenders);
    void measure(Candidate& candidate);
    void walk(Candidates contenders);
    void timeAtLength();
    void pick();
    void testSteadiness(std::span<Candidate*> some);
    void compareWithChosen();
    Candidates withinBudget();
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
    gl::TimingChoice timing_;
    Choice choice_;
    std::map<std::string, std::vector<double>> glances_; // RMSE on each view, by name
    std::set<std::string> dominated_;                    // names
    int failures_ = 0;                                   // of candidates on held-out views
    double done_ = 0;                                    // in candidates, each rung counting alike
};

std::vector<Milliseconds> Choosing::milliseconds(std::size_t view,
                                                 const std::vector<Settings>& settings, int frames,
                                                 double seconds, bool last) {
    TimingPlan plan;
    plan.frames = frames;
    plan.seconds = seconds;
    plan.seed = study_.match.seed;
    plan.timing = timing_.timing;
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

// On training views alone, so that what is left out here is no choice by the views that judge.
void Choosing::glance() {
    MatchStudy study = study_.match;
    study.test = study.train;
    study.train.resize(1);
    study.training = study.image = glanceSize;
    study.rays = std::min(study.rays, glanceRays);
    study.scores.clear();
    const auto fitted = fits(study, "glance");
    for (const TechniqueSetting& technique : study_.match.techniques) {
        const MatchedTechnique& matched = fitted.at(technique.name);
        Candidate candidate;
        candidate.configuration = {technique, matched.fitted};
        candidate.glanceRmse = summaryOf(matched.rows, nameOf(study.truth), "matched").rmse;
        for (const MatchRow& row : matched.rows)
            if (!row.train && row.stage == "matched" && row.reference == nameOf(study.truth))
                glances_[technique.name].push_back(row.error.rmse);
        candidate.rmse = candidate.milliseconds = candidate.training = nan;
        if (budget_.rmse && candidate.glanceRmse > farOver(*budget_.rmse))
            candidate.verdict = "RMSE far over the limit at a glance";
        choice_.candidates.push_back(std::move(candidate));
    }
}

// As matched at a glance, for a radius changes the cost; the fastest of few frames, because what
// else the machine does only adds to their times.
void Choosing::timeAll() {
    const double radius = study_.match.test.front().radius;
    std::vector<Settings> settings;
    for (const Candidate& candidate : choice_.candidates)
        settings.push_back(settingsAt(candidate.configuration, radius, true));
    const auto times =
        milliseconds(0, settings, glanceFrames, std::numeric_limits<double>::infinity(), false);
    for (std::size_t i = 0; i < times.size(); ++i) {
        Candidate& candidate = choice_.candidates[i];
        candidate.glanceMilliseconds = times[i].low;
        if (candidate.verdict.empty() && budget_.milliseconds &&
            candidate.glanceMilliseconds > *budget_.milliseconds * glanceFactor)
            candidate.verdict = "milliseconds far over the limit at a glance";
    }
}

// By one that is clearly better, and on every view, and clearly cheaper or, asked for the best
// within a time, clearly within it.
void Choosing::dropDominated() {
    const auto isBetter = [&](const Candidate& other, const Candidate& candidate) {
        const std::vector<double>&a = glances_[nameOf(other)], &b = glances_[nameOf(candidate)];
        return other.glanceRmse + rmseAlike <= candidate.glanceRmse &&
               std::equal(a.begin(), a.end(), b.begin(), b.end(), std::less<>());
    };
    for (Candidate& candidate : choice_.candidates)
        for (const Candidate& other : choice_.candidates) {
            const double most = budget_.best ? *budget_.milliseconds : candidate.glanceMilliseconds;
            if (candidate.verdict.empty() && other.glanceMilliseconds * glanceFactor <= most &&
                isBetter(other, candidate)) {
                dominated_.insert(nameOf(candidate));
                candidate.verdict =
                    fmt::format("{} ({:.3g} ms, RMSE {:.3f}) is preferable at a glance",
                                nameOf(other), other.glanceMilliseconds, other.glanceRmse);
            }
        }
}

// First those that may be the answer. Then those that wait until none of these will do: dearer than
// one that is as far within the limit as those that fell out are over it or, asked for the best,
// not preferable to one that will after all not do.
std::pair<Choosing::Candidates, Choosing::Candidates> Choosing::contenders() {
    double enough = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : choice_.candidates)
        if (budget_.rmse && !budget_.best && candidate.verdict.empty() &&
            farOver(candidate.glanceRmse) <= *budget_.rmse)
            enough = std::min(enough, candidate.glanceMilliseconds * glanceFactor);
    std::pair<Candidates, Candidates> result;
    for (Candidate& candidate : choice_.candidates)
        if (candidate.verdict.empty())
            (candidate.glanceMilliseconds <= enough ? result.first : result.second)
                .push_back(&candidate);
        else if (budget_.best && dominated_.contains(nameOf(candidate)))
            result.second.push_back(&candidate);
    if (result.first.empty())
        result.first = nearestAtAGlance();
    return result;
}

// Nothing is near the limits; so that it can be said what came nearest, and how near.
Choosing::Candidates Choosing::nearestAtAGlance() {
    const auto excessOf = [&](const Candidate* candidate) {
        return std::max(budget_.rmse ? candidate->glanceRmse / *budget_.rmse : 0,
                        budget_.milliseconds ? candidate->glanceMilliseconds / *budget_.milliseconds
                                             : 0);
    };
    Candidates nearest;
    for (Candidate& candidate : choice_.candidates)
        nearest.push_back(&candidate);
    std::stable_sort(nearest.begin(), nearest.end(), [&](const Candidate* a, const Candidate* b) {
        return excessOf(a) < excessOf(b);
    });
    nearest.resize(std::min<std::size_t>(nearest.size(), failuresAllowed));
    return nearest;
}

void Choosing::fit(const Candidates& contenders) {
    MatchStudy study = study_.match;
    study.test.resize(1); // the fit alone is wanted
    study.scores.clear();
    study.techniques.clear();
    for (const Candidate* candidate : contenders)
        study.techniques.push_back(candidate->configuration.setting);
    const auto fitted = fits(study, "match");
    for (Candidate* candidate : contenders) {
        candidate->configuration.fitted = fitted.at(nameOf(*candidate)).fitted;
        std::vector<ViewResult> results;
        for (std::size_t i = 0; i < study.train.size(); ++i)
            results.push_back(resultOn(stages_.trainingView(i), candidate->configuration));
        candidate->training = promise(budget_, results);
        tell("looking at " + nameOf(*candidate));
    }
}

// On all held-out views at full size.
void Choosing::measure(Candidate& candidate) {
    candidate.rung = Rung::held_out;
    for (std::size_t i = 0; i < stages_.count(); ++i) {
        MeasuredView& seen = stages_.view(i);
        const ViewErrors errors = seen.errorsOf(
            seen.probe().visibility(settingsAt(candidate.configuration, seen.view().radius, true)));
        candidate.views.push_back(resultOf(errors.full, errors.lit));
        tell("measuring " + nameOf(candidate));
    }
    candidate.rmse = meanOf(candidate.views, &ViewResult::rmse);
}

void Choosing::walk(Candidates contenders) {
    std::stable_sort(
        contenders.begin(), contenders.end(),
        [](const Candidate* a, const Candidate* b) { return a->training < b->training; });
    for (Candidate* candidate : contenders) {
        if (failures_ == failuresAllowed) {
            candidate->verdict = fmt::format(
                "not tried, for {} that were better on training views failed", failures_);
            continue;
        }
        measure(*candidate);
        candidate->verdict = excess(budget_, candidate->views);
        failures_ += !candidate->verdict.empty();
    }
}

// All that was measured, on every view, for as long as a sweep would.
void Choosing::timeAtLength() {
    Candidates measured;
    for (Candidate& candidate : choice_.candidates)
        if (candidate.rung == Rung::held_out)
            measured.push_back(&candidate);
    for (Candidate* candidate : measured)
        candidate->milliseconds = 0;
    for (std::size_t i = 0; i < stages_.count() && !measured.empty(); ++i) {
        std::vector<Settings> settings;
        for (const Candidate* candidate : measured)
            settings.push_back(
                settingsAt(candidate->configuration, stages_.view(i).view().radius, true));
        const auto times = milliseconds(i, settings, study_.frames, study_.seconds, true);
        for (std::size_t k = 0; k < measured.size(); ++k) {
            measured[k]->views[i].milliseconds = times[k].high;
            measured[k]->milliseconds += times[k].median / static_cast<double>(stages_.count());
        }
    }
    for (Candidate* candidate : measured)
        candidate->verdict = excess(budget_, candidate->views);
}

// Measured and within all limits known so far, the preferable first.
Choosing::Candidates Choosing::withinBudget() {
    Candidates found;
    for (Candidate& candidate : choice_.candidates)
        if (candidate.rung >= Rung::held_out && candidate.verdict.empty())
            found.push_back(&candidate);
    std::stable_sort(found.begin(), found.end(), [&](const Candidate* a, const Candidate* b) {
        return worth(budget_, *a) < worth(budget_, *b);
    });
    return found;
}

// First the failure tests, which are quick; then motion from every view, for some at once, because
// what takes long is the truth of each frame.
void Choosing::testSteadiness(std::span<Candidate*> some) {
    Candidates left;
    for (Candidate* candidate : some) {
        if (!budget_.failures.empty()) {
            tell("failure tests of " + nameOf(*candidate));
            candidate->verdict = failuresOf(
                settingsAt(candidate->configuration, study_.match.test.front().radius, true),
                budget_.failures, plan_.folder / "failures");
        }
        if (candidate->verdict.empty())
            left.push_back(candidate);
    }
    if (!budget_.flicker || left.empty())
        return;
    for (std::size_t i = 0; i < stages_.count(); ++i) {
        const View& view = study_.match.test[i];
        tell("flicker from " + view.name);
        std::vector<NamedSettings> named;
        for (const Candidate* candidate : left)
            named.push_back(
                {nameOf(*candidate), settingsAt(candidate->configuration, view.radius, true)});
        const auto flicker =
            flickerOf(stages_.scene(i), view, named, plan_.folder / "flicker" / view.name);
        for (std::size_t k = 0; k < left.size(); ++k)
            left[k]->views[i].flicker = flicker[k];
    }
    for (Candidate* candidate : left)
        candidate->verdict = excess(budget_, candidate->views);
}

void Choosing::pick() {
    std::stable_sort(choice_.candidates.begin(), choice_.candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return costOf(a) < costOf(b); });
    const Candidates order = withinBudget();
    for (std::size_t first = 0; first < order.size() && !choice_.chosen; first += together) {
        Candidates some(order.begin() + static_cast<std::ptrdiff_t>(first),
                        order.begin() +
                            static_cast<std::ptrdiff_t>(std::min(first + together, order.size())));
        testSteadiness(some);
        const auto found = std::find_if(some.begin(), some.end(), [](const Candidate* candidate) {
            return candidate->verdict.empty();
        });
        if (found == some.end())
            continue;
        (*found)->rung = Rung::chosen;
        choice_.chosen = static_cast<std::size_t>(*found - choice_.candidates.data());
    }
}

// View by view, for what is hard is hard for all; in the order of errors on training views, from
// the worst on, until failuresAllowed are not told apart: budget.h says why.
void Choosing::compareWithChosen() {
    if (!budget_.best || !choice_.chosen || stages_.count() < 2)
        return;
    const Candidate& chosen = choice_.candidates[*choice_.chosen];
    Candidates others = withinBudget();
    std::erase(others, &chosen);
    std::stable_sort(others.begin(), others.end(), [](const Candidate* a, const Candidate* b) {
        return a->training > b->training;
    });
    for (const Candidate* other : others) {
        std::vector<double> gains; // of the chosen one
        for (std::size_t i = 0; i < chosen.views.size(); ++i)
            gains.push_back(budget_.best->distance(chosen.views[i].*budget_.best->value) -
                            budget_.best->distance(other->views[i].*budget_.best->value));
        if (choice_.alike.size() >= failuresAllowed || upperBound(gains) >= 0)
            choice_.alike.push_back(static_cast<std::size_t>(other - choice_.candidates.data()));
    }
    std::sort(choice_.alike.begin(), choice_.alike.end());
}

Choice Choosing::run() {
    const auto start = std::chrono::steady_clock::now();
    SceneHashes hashes(folders_);
    choice_.machine = machineOf(driver_, timing_, identityOf(study_, hashes));
    glance();
    timeAll();
    dropDominated();
    const auto [near, waiting] = contenders();
    std::vector<std::string> names; // places change as candidates are put into order
    for (const Candidate* candidate : waiting)
        names.push_back(nameOf(*candidate));
    const auto tryOut = [&](const Candidates& some) {
        if (some.empty() || choice_.chosen || failures_ == failuresAllowed)
            return;
        fit(some);
        walk(some);
        timeAtLength();
        pick();
    };
    tryOut(near);
    Candidates rest;
    for (Candidate& candidate : choice_.candidates)
        if (std::find(names.begin(), names.end(), nameOf(candidate)) != names.end())
            rest.push_back(&candidate);
    tryOut(rest);
    for (Candidate* candidate : rest)
        if (candidate->rung == Rung::glance && candidate->verdict.empty())
            candidate->verdict = "dearer at a glance than others that would do";
    compareWithChosen();
    choice_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() -
        stages_.secondsForReferences();
    return std::move(choice_);
}

} // namespace

Choice choose(const SweepStudy& study, const Budget& budget, const Folders& folders,
              const SweepPlan& plan, const gl::Driver& driver, const SweepProgress& progress) {
    for (const Measure& measure : measures()) {
        const bool limited = (budget.*measure.limit).has_value();
        if (limited && !study.light && measure.lit)
            throw Error(fmt::format("expected a study with [light] for a limit on {}, found one "
                                    "without",
                                    measure.name));
        if (limited && study.match.test.size() < 2)
            throw Error(
                fmt::format("expected at least two test views, for a limit on errors or flicker "
                            "is met with confidence over views, found {}",
                            study.match.test.size()));
    }
    requireMeasurable(study,
                      static_cast<double>(study.match.test.size()) *
                          truthCost(study.sizes.front(), study.match.rays),
                      plan.hours);
    return Choosing(study, budget, folders, plan, driver, progress).run();
}

double worth(const Budget& budget, const Candidate& candidate) {
    return budget.best ? budget.best->distance(meanOf(candidate.views, budget.best->value))
                       : candidate.milliseconds;
}

double costOf(const Candidate& candidate) {
    return std::isnan(candidate.milliseconds) ? candidate.glanceMilliseconds
                                              : candidate.milliseconds;
}

std::string chosenFrom(const Sweep& sweep, const Budget& budget) {
    std::map<std::string, Candidate> all;
    std::size_t most = 0;
    for (const SweepRow& row : atTypicalSpeed(sweep.rows)) {
        Candidate& candidate = all[row.configuration];
        candidate.milliseconds += row.total.median;
        candidate.views.push_back(resultOf(row.matched, row.litMatched));
        candidate.views.back().milliseconds = row.total.high;
        most = std::max(most, candidate.views.size());
    }
    std::string best;
    for (const auto& [name, candidate] : all)
        if (candidate.views.size() == most && excess(budget, candidate.views).empty() &&
            (best.empty() || worth(budget, candidate) < worth(budget, all[best])))
            best = name;
    return best;
}

} // namespace obscura
