#pragma once

#include "bench/motion/temporal_study.h"
#include "bench/motion/temporal_tests.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace obscura {

// Steadiness from frame to frame: one test per camera path (temporal_tests.h), measured as in
// temporal_measures.h. Noise is used as in a game without temporal filtering: it keeps to its
// pixels while the camera moves. Only in the test "still" does its seed change with every frame.
// A configuration that accumulates frames (`accumulate`) is a game with such filtering: its noise
// cycles in all tests, and before the first frame it has looked at the start for as many frames as
// it accumulates. What it shows late, or of what hid a point before, is an error against the truth
// where points are newly seen.
//
// The headline is reference-relative change, motion-compensated. Its plain form, pixel by pixel, is
// given too, but it mostly shows how far a technique is from the truth, not how much it flickers:
// `none` lies in the middle of all techniques, because a constant picture lacks the truth's change
// at every edge that passes a pixel.
//
// The truth is traced with rays that are the same for all pixels and frames, so that their error
// sticks to the surfaces. How much of this error is left can be read from a configuration of
// `ray_traced`, which has other rays, as many as its settings say. What bilinear fetching adds can
// be read from `none`, whose unreal change is the truth's warped change. A technique whose values
// are below those two cannot be told from a perfect one.

TemporalEffort fullTemporalEffort();
TemporalEffort quickTemporalEffort(); // smaller, fewer frames and rays, and two paths

// What one test finds.
struct TemporalFinding {
    std::vector<StabilityCell> cells;
    std::vector<double> truthfulness; // of each configuration (MotionRecord); of moving cameras
};

// One test after the other, of all configurations of a study: frames are drawn once for all, and
// shaders are compiled once for all tests. A study's configurations can be measured apart as well,
// and tests too: nothing depends on the others. A GL context must be current.
class TemporalMeasurement {
  public:
    // Fewer frames than 3 are an Error.
    explicit TemporalMeasurement(TemporalStudy study);
    ~TemporalMeasurement();
    TemporalMeasurement(const TemporalMeasurement&) = delete;
    TemporalMeasurement& operator=(const TemporalMeasurement&) = delete;

    using Tell = std::function<void()>; // called before each frame

    // The ray-traced truth of each frame that shows something else than the one before it; none for
    // a test without motion. It has nothing to do with the configurations.
    std::vector<Image> truths(const TemporalTest& test, const Tell& tell = {}) const;
    // `truths` are those of the test. Writes pictures.
    TemporalFinding measure(const TemporalTest& test, const std::vector<Image>& truths,
                            const Tell& tell = {}) const;

  private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

// The animation (temporal_animation.h) of tests that were measured; `findings` and `truths` are
// theirs, in the order of the study's.
std::optional<StabilityCell> animationOf(const TemporalStudy& study,
                                         const std::vector<TemporalFinding>& findings,
                                         const std::vector<std::vector<Image>>& truths);

// Told the share done, 0 ... 1, and the test at hand.
using TemporalProgress = std::function<void(double, const std::string&)>;

// All tests of a study, and the animation. A GL context must be current. Fewer frames than 3, an
// unknown test or a file that cannot be written is an Error.
std::vector<StabilityCell> measureTemporal(const TemporalStudy& study,
                                           const TemporalProgress& progress = {});

} // namespace obscura
