#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace obscura {

// What a sweep measures, as it stands in sweep.csv: one row per configuration, view and resolution.
// A configuration is a technique with one choice of every setting that the study varies.

// Milliseconds over the frames that were timed.
struct Milliseconds {
    double median = 0, low = 0, high = 0; // 5th and 95th percentile
};

// Of one picture against its truth. NaN: not measured.
struct PictureError {
    double rmse = 0, bias = 0, ssim = 0, flip = 0;
    double jod = std::numeric_limits<double>::quiet_NaN(); // predicted, of lit images alone
};

struct SweepRow {
    std::string configuration; // "hbao steps=8 blur=0"; unique in the study
    std::string technique;     // id in the table
    std::string name;          // of the study's technique that it varies
    std::string settings;      // complete, "name=value" in the table's order, spaces between
    std::string fitted;        // settings that matching changed, alike
    std::string scene, view;   // file or built-in name; view's name
    double radius = 0;         // metres
    int width = 0, height = 0;

    int frames = 0;               // timed, as matched: a radius changes the cost
    Milliseconds total;           // all passes of the technique
    std::array<double, 4> work{}; // medians by kind of work, in the order of workNames()
                                  // (renderer/techniques/technique.h); parts of total
    double gbuffer = 0;           // median of the same run: depth, and the normals that it reads
    double toGbuffer = 0, toStarcraft = 0; // ratios of medians in the same run; the latter to
                                           // `starcraft` with 16 samples, blurred
    double starcraftRepeat = 1; // the latter's median in odd rounds over that in even ones; NaN:
                                // not measured
    double bytes = 0;           // of GPU memory per pixel that the technique adds
    double fetches =
        0; // of textures per pixel of the image, as declared (renderer/techniques/fetches.h)

    // Against rays through the whole scene, and against the same integral over the depth buffer
    // alone: visibility as the technique leaves it, and after matching (fitted on training views).
    PictureError raw, matched, depthRaw, depthMatched; // flip: of visibility shown as sRGB grey
    PictureError litRaw, litMatched;                   // of the lit image; ssim of its luma
    std::string
        thumbnail; // file in the sweep's folder, or "": matched visibility, its error beside it
};

// How cost grows: one configuration's median at one value of one axis.
struct GrowthRow {
    std::string configuration;
    std::string axis; // "samples", "radius", "pixels", "silhouettes"
    double value = 0; // on that axis: count, metres, megapixels, share of pixels at a depth edge
    double milliseconds = 0;
};

// What the times were measured on, and how, as it stands in sweep.json.
struct SweepMachine {
    std::string vendor, renderer, glVersion, processor, clocks; // clocks: "" when unknown
    std::string method; // "timer queries" or "glFinish and steady clock", and why
    std::string program, study, date;
    std::string display;   // in words, on which JOD is predicted; "" of folders before version 3
    int rows = 0;          // that all configurations give on all views at all sizes; 0: not known
    int formatVersion = 3; // of the folder that was read
};

struct Sweep {
    SweepMachine machine;
    std::vector<SweepRow> rows;
    std::vector<GrowthRow> growth;
};

} // namespace obscura
