#pragma once

#include "bench/sweep/pareto.h"
#include "bench/sweep/speed.h"
#include "report/scatter.h"

#include <map>
#include <span>

namespace obscura {

// What charts and tables show of a sweep.

// One configuration at one scene, resolution and radius, all views taken together. Times, fetches,
// bytes and ratios are medians over views, so that the percentiles are those of the frames of a
// typical view. RMSE is the root of the mean square; bias is the mean size with the sign of the
// mean, so that views do not cancel out; other errors and predicted JOD are means. An error is NaN
// as soon as one view has none. Frames are summed, `view` lists the names, and text and thumbnail
// are the first view's.
SweepRow overViews(std::span<const SweepRow> rows);

// The configurations of one scene, resolution and radius, by rising milliseconds at typical speed.
struct SweepGroup {
    std::string scene;
    int width = 0, height = 0;
    double radius = 0; // metres
    std::vector<SweepRow> points;
    Straying straying; // of the rows that the points are made of
};
// "atrium, 960×540, R 0.5 m"
std::string titleOf(const SweepGroup& group);
// In the order in which scenes first appear; of a scene, the smallest picture first.
std::vector<SweepGroup> groupsOf(const std::vector<SweepRow>& rows);

// Points of the group that lack views which other points have, so that their medians are of other
// pictures.
std::vector<std::string> lackingViews(const SweepGroup& group);

// An error that charts can show; less is better.
struct ErrorMeasure {
    std::string name;      // "RMSE, matched"
    std::string reference; // "full" or "depth buffer"
    double (*of)(const SweepRow&);
    bool always = false;     // tables show it beside any other
    std::string figure = {}; // how the file of its figure for papers begins; "": it has none
};
std::span<const ErrorMeasure> errorMeasures(); // the first is the default

std::vector<ParetoPoint> paretoPoints(const SweepGroup& group, const ErrorMeasure& measure);

// How far the group's times are trusted, each way, as a share; 0 where the machine strayed little,
// and fronts have no interval.
double uncertaintyOf(const SweepGroup& group);

// The group as a chart shows it; `techniques` are the series.
Scatter scatterOf(const SweepGroup& group, const ErrorMeasure& measure,
                  const std::vector<std::string>& techniques);

// Ids of techniques in alphabetical order. A technique's place in it decides its colour and mark.
std::vector<std::string> techniquesOf(const std::vector<SweepRow>& rows);

std::size_t indexOf(const std::vector<std::string>& techniques, const std::string& technique);

// Where the technique of each configuration, also of those that only grew, and of each name stands
// among techniquesOf(); their number for one that is not there.
std::map<std::string, std::size_t> techniquesByConfiguration(const Sweep& sweep);

// "samples=8 blur=1" as names and values.
std::map<std::string, std::string> settingsIn(const std::string& settings);

} // namespace obscura
