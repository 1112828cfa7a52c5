#include "bench/sweep/units.h"

#include "base/files.h"
#include "base/random.h"
#include "bench/measure/measured_view.h"
#include "bench/sweep/cost_growth.h"
#include "matching/fitting.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace obscura {

namespace {

constexpr std::size_t groupSize = 12; // configurations that are timed in turn

using Kind = SweepUnit::Kind;

std::vector<std::vector<std::size_t>> groupsOf(const SweepStudy& study) {
    std::vector<std::size_t> lot(study.match.techniques.size());
    std::iota(lot.begin(), lot.end(), std::size_t{0});
    Random(study.match.seed, "groups").shuffle(lot);
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < lot.size(); ++i) {
        if (i % groupSize == 0)
            groups.emplace_back();
        groups.back().push_back(lot[i]);
    }
    return groups;
}

// Views of one scene beside each other.
std::vector<std::size_t> byScene(const std::vector<View>& views) {
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < views.size(); ++i)
        first.emplace(sceneOf(views[i]), i);
    std::vector<std::size_t> order(views.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return first.at(sceneOf(views[a])) < first.at(sceneOf(views[b]));
    });
    return order;
}

// Seconds that a configuration's errors on one view take, roughly.
double errorsCost(const ImageSize& size) { return 0.8 + 4e-6 * size.width * size.height; }

class Planning {
  public:
    Planning(const SweepStudy& study, const SweepShare& share, const std::string& machine)
        : study_(study), share_(share), tag_(tagOf(machine)), groups_(groupsOf(study)) {}

    std::vector<SweepUnit> run();

  private:
    void drawErrors();
    void drawTimes();
    void addFits();
    void addErrors();
    void addTimes();
    void addFiles(const std::string& of);
    void add(Kind kind, const std::string& name, const std::string& group, double cost,
             std::size_t view = 0, const ImageSize& size = {},
             const std::vector<std::size_t>& configurations = {});
    // "left 0.2 m 64x36"
    std::string placeOf(std::size_t view, const ImageSize& size) const;
    std::vector<SweepUnit> partOf(std::vector<SweepUnit> whole) const;
    std::vector<SweepUnit> ordered(const std::vector<SweepUnit>& units) const;

    const SweepStudy& study_;
    const SweepShare& share_;
    const std::string tag_;
    const std::vector<std::vector<std::size_t>> groups_;
    int stage_ = 0;
    std::vector<SweepUnit> errors_, times_; // of this part
    std::vector<SweepUnit> units_;
};

std::string Planning::placeOf(std::size_t view, const ImageSize& size) const {
    const View& at = study_.match.test[view];
    return fmt::format("{} {:g} m {}x{}", at.name, at.radius, size.width, size.height);
}

void Planning::add(Kind kind, const std::string& name, const std::string& group, double cost,
                   std::size_t view, const ImageSize& size,
                   const std::vector<std::size_t>& configurations) {
    units_.push_back({kind, {name, group, cost}, stage_, view, size, configurations});
}

std::vector<SweepUnit> Planning::partOf(std::vector<SweepUnit> whole) const {
    const auto edge = [&](int part) {
        return whole.begin() +
               static_cast<std::ptrdiff_t>(whole.size() * static_cast<std::size_t>(part) /
                                           static_cast<std::size_t>(share_.parts));
    };
    return {edge(share_.part - 1), edge(share_.part)};
}

// Configuration by configuration, in the order of the lot, so that a part has few of them: each
// takes a fit, which is dear. So both kinds of units come from the same configurations.
void Planning::drawErrors() {
    std::vector<SweepUnit> whole;
    for (const std::vector<std::size_t>& group : groups_)
        for (const std::size_t i : group)
            for (const std::size_t view : byScene(study_.match.test))
                for (const ImageSize& size : study_.sizes) {
                    const std::string place = placeOf(view, size);
                    whole.push_back(
                        {Kind::errors,
                         {fmt::format("errors of {} on {}", study_.match.techniques[i].name, place),
                          place, errorsCost(size)},
                         0,
                         view,
                         size,
                         {i}});
                }
    errors_ = partOf(std::move(whole));
}

void Planning::drawTimes() {
    std::vector<SweepUnit> whole;
    for (std::size_t g = 0; g < groups_.size(); ++g)
        for (const std::size_t view : byScene(study_.match.test))
            for (const ImageSize& size : study_.sizes) {
                const std::string place = placeOf(view, size);
                whole.push_back({Kind::times,
                                 {fmt::format("times {} of group {} on {}", tag_, g + 1, place),
                                  place, static_cast<double>(groups_[g].size()) * study_.seconds},
                                 0,
                                 view,
                                 size,
                                 groups_[g]});
            }
    times_ = partOf(std::move(whole));
}

void Planning::addFits() {
    std::set<std::size_t> fitted;
    for (const auto* units : {&errors_, &times_})
        for (const SweepUnit& unit : *units)
            fitted.insert(unit.configurations.begin(), unit.configurations.end());
    if (fitted.empty())
        return;
    for (const std::size_t i : byScene(study_.match.train)) {
        const View& view = study_.match.train[i];
        add(Kind::training,
            fmt::format("reference of training view {} {:g} m", view.name, view.radius),
            sceneOf(view), truthCost(study_.match.training, study_.match.rays), i,
            study_.match.training);
    }
    ++stage_;
    MatchStudy trained = study_.match;
    trained.test.clear();
    for (const std::size_t i : fitted)
        add(Kind::fit, "fit of " + study_.match.techniques[i].name, "",
            fitCost(trained, study_.match.techniques[i]), 0, {}, {i});
    ++stage_;
}

// View by view, and so scene by scene.
std::vector<SweepUnit> Planning::ordered(const std::vector<SweepUnit>& units) const {
    std::map<std::string, std::vector<SweepUnit>> byPlace;
    for (const SweepUnit& unit : units)
        byPlace[unit.unit.group].push_back(unit);
    std::vector<SweepUnit> result;
    for (const std::size_t view : byScene(study_.match.test))
        for (const ImageSize& size : study_.sizes)
            for (SweepUnit& unit : byPlace[placeOf(view, size)])
                result.push_back(std::move(unit));
    return result;
}

void Planning::addErrors() {
    std::string place;
    for (SweepUnit& unit : ordered(errors_)) {
        if (unit.unit.group != place) {
            place = unit.unit.group;
            add(Kind::references, "references of " + place, place,
                2 * truthCost(unit.size, study_.match.rays), unit.view, unit.size);
        }
        unit.stage = stage_;
        units_.push_back(std::move(unit));
    }
    ++stage_;
    addFiles("errors");
}

void Planning::addTimes() {
    for (SweepUnit& unit : ordered(times_)) {
        unit.stage = stage_;
        units_.push_back(std::move(unit));
    }
    if (study_.growth && share_.part == 1)
        add(Kind::growth, fmt::format("growth {}", tag_), "growth",
            growthSteps(*study_.growth) * static_cast<double>(study_.growth->techniques.size()) *
                study_.seconds);
    ++stage_;
    addFiles("times " + tag_);
}

void Planning::addFiles(const std::string& of) {
    const std::string part =
        share_.parts > 1 ? fmt::format(", part {} of {}", share_.part, share_.parts) : "";
    add(Kind::files, fmt::format("files with {}{}", of, part), "", 5);
    ++stage_;
}

std::vector<SweepUnit> Planning::run() {
    if (share_.measured != Measured::times)
        drawErrors();
    if (share_.measured != Measured::errors)
        drawTimes();
    addFits();
    if (share_.measured != Measured::times)
        addErrors();
    if (share_.measured != Measured::errors)
        addTimes();
    return std::move(units_);
}

} // namespace

std::vector<SweepUnit> sweepUnits(const SweepStudy& study, const SweepShare& share,
                                  const std::string& machine) {
    return Planning(study, share, machine).run();
}

std::string tagOf(const std::string& kind) { return sha256(kind).substr(0, 8); }

} // namespace obscura
