#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace obscura {

// What a sweep measures, as it stands in sweep.csv: one row per configuration, view and resolution.
// A configuration is a technique with one choice of every setting that the study varies. Errors and
// times are measured apart, so that a row may have either without the other.

// Milliseconds over the frames that were timed.
struct Milliseconds {
    double median = 0, low = 0, high = 0; // 5th and 95th percentile
};

inline constexpr double notMeasured = std::numeric_limits<double>::quiet_NaN();

// Of one picture against its truth.
struct PictureError {
    double rmse = notMeasured, bias = notMeasured, ssim = notMeasured, flip = notMeasured;
    double jod = notMeasured; // predicted, of lit images alone
};

struct SweepTimes {
    int frames = 0; // timed, as matched: a radius changes the cost
    Milliseconds total{notMeasured, notMeasured, notMeasured}; // all passes of the technique
    // Medians by kind of work, in the order of workNames() (renderer/techniques/technique.h); parts
    // of total.
    std::array<double, 4> work{notMeasured, notMeasured, notMeasured, notMeasured};
    double gbuffer = notMeasured; // median of the same run: depth, and the normals that it reads
    // Ratios of medians in the same run; the latter to `starcraft` with 16 samples, blurred.
    double toGbuffer = notMeasured, toStarcraft = notMeasured;
    double starcraftRepeat = notMeasured; // the latter's median in odd rounds over that in even
};

// Against rays through the whole scene, and against the same integral over the depth buffer alone:
// visibility as the technique leaves it, and after matching (fitted on training views).
struct SweepErrors {
    PictureError raw, matched, depthRaw, depthMatched; // flip: of visibility shown as sRGB grey
    PictureError litRaw, litMatched;                   // of the lit image; ssim of its luma
    // File in the sweep's folder, or "": matched visibility, its error beside it.
    std::string thumbnail;
};

struct SweepRow : SweepTimes, SweepErrors {
    std::string configuration; // "hbao steps=8 blur=0"; unique in the study
    std::string technique;     // id in the table
    std::string name;          // of the study's technique that it varies
    std::string settings;      // complete, "name=value" in the table's order, spaces between
    std::string fitted;        // settings that matching changed, alike
    std::string scene, view;   // file or built-in name; view's name
    double radius = 0;         // metres
    int width = 0, height = 0;

    double bytes = 0; // of GPU memory per pixel that the technique adds
    // Of textures per pixel of the image, as declared (renderer/techniques/fetches.h).
    double fetches = 0;

    bool hasTimes() const { return !std::isnan(total.median); }
    bool hasErrors() const { return !std::isnan(matched.rmse); }
};

// How cost grows: one configuration's median at one value of one axis.
struct GrowthRow {
    std::string configuration;
    std::string axis; // "samples", "radius", "pixels", "silhouettes"
    double value = 0; // on that axis: count, metres, megapixels, share of pixels at a depth edge
    double milliseconds = 0;
};

// What times were measured on, and how; all empty where nothing was timed.
struct TimedOn {
    std::string vendor, renderer, glVersion, processor;
    std::string method; // "timer queries" or "glFinish and steady clock", and why
    std::string clocks; // "" when unknown
    std::string date;
};

// A sweep as it stands in sweep.json.
struct SweepMachine : TimedOn {
    std::string program, study;
    std::string display;   // in words, on which JOD is predicted; "" of folders before version 3
    std::string errorsBy;  // renderers that errors were measured with; "" before version 4
    std::string notes;     // sentences on what was left out; "" of all others
    int rows = 0;          // that all configurations give on all views at all sizes; 0: not known
    int formatVersion = 4; // of the folder that was read
};

struct Sweep {
    SweepMachine machine;
    std::vector<SweepRow> rows;
    std::vector<GrowthRow> growth;
};

} // namespace obscura
