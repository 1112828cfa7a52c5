#pragma once

#include "bench/motion/reprojection.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace obscura {

// How steady visibility is from frame to frame, fed frame by frame (fact sheet, section C). Numbers
// are in units of visibility.

// Values in [0, 2], rounded to 1/32768.
class Magnitudes {
  public:
    void add(double value);
    std::uint64_t count() const { return count_; }
    // NaN without any value.
    double mean() const;
    // The smallest value that at least this share of all values do not exceed.
    double percentile(double share) const;

  private:
    std::vector<std::uint32_t> counts_ = std::vector<std::uint32_t>(2 * 32768 + 1);
    std::uint64_t count_ = 0;
    double sum_ = 0;
};

// Measure 1: the camera keeps still while the noise cycles.
class StillNoise {
  public:
    void add(const Image& visibility);
    // Each pixel's standard deviation over the frames added, which must be two or more: the root of
    // the unbiased estimate of variance.
    Image deviation() const;

  private:
    Image mean_;
    std::vector<double> squares_; // of differences to the mean, summed (Welford 1962)
    int frames_ = 0;
};

// What happened between two frames of a moving camera, whatever the technique.
struct FrameStep {
    std::vector<bool> shown; // whether the pixel shows a surface in either frame
    Reprojection back;       // this frame's points in the frame before
    Reprojection ahead;      // the frame before's points in this frame
    Image change;            // of the truth at each pixel: G_t - G_t-1
    Image warpedChange;      // of the truth at each point of a surface: G_t - G_t-1 o w
};

// A_t - A_t-1 o w, where "o w" fetches bilinearly from where the pixel's point was in the frame
// before; 0 where it was not visible there.
Image warpedChange(const Image& now, const Image& before, const Reprojection& back);

// Measures 2 to 4: the camera moves while the noise keeps to its pixels.
class MotionError {
  public:
    void start(const Image& visibility);
    // `before` is the step before this one, null at the first.
    void step(const Image& visibility, const FrameStep& step, const FrameStep* before);

    // |(A_t - A_t-1 o w) - (G_t - G_t-1 o w)| of all points that both frames show: reference-
    // relative change, motion-compensated.
    const Magnitudes& unreal() const { return unreal_; }
    // |(A_t - A_t-1) - (G_t - G_t-1)| of all pixels that show a surface: the same, plain.
    const Magnitudes& unrealAtPixels() const { return unrealAtPixels_; }
    // |A_t-2 o w - 2 A_t-1 + A_t o w'| of all points that three frames show.
    const Magnitudes& second() const { return second_; }
    // E_w: the mean of (A_t - A_t-1 o w)^2. NaN where no two frames show the same point.
    double warpingError() const;

    // Each pixel's mean of unreal() over the steps.
    Image unrealPicture() const;
    // The frame with the most unreal change, 1 being that of the first step, and its visibility.
    int worstFrame() const { return worstFrame_; }
    const Image& worst() const { return worst_; }

  private:
    void addUnreal(const Image& visibility, const FrameStep& step);
    void addUnrealAtPixels(const Image& visibility, const FrameStep& step);
    void addSecond(const Image& visibility, const FrameStep& step, const FrameStep& before);

    Image before_, beforeThat_;
    Magnitudes unreal_, unrealAtPixels_, second_;
    double warpedSquares_ = 0;
    Image unrealSums_;
    int steps_ = 0, worstFrame_ = 0;
    double worstSum_ = -1;
    Image worst_;
};

// Which points came into sight not long ago, from behind an edge or the border: in one of the last
// `frames` frames, this one included, no pixel near the point's place in the frame before showed
// its surface.
class NewlySeen {
  public:
    static constexpr int frames = 8;

    // At first all has been seen for long.
    explicit NewlySeen(std::size_t pixels) : ages_(pixels, frames) {}
    void step(const Reprojection& back);

    bool operator[](std::size_t pixel) const { return ages_[pixel] < frames; }

  private:
    std::vector<int> ages_; // frames since it came into sight, at most `frames`
};

// Visibility against the truth, over all pixels of all frames that were added.
class TruthError {
  public:
    void add(float visibility, float truth) {
        squares_ += std::pow(static_cast<double>(visibility) - static_cast<double>(truth), 2);
        ++count_;
    }
    double rmse() const; // NaN where there was nothing
    std::uint64_t count() const { return count_; }

  private:
    double squares_ = 0;
    std::uint64_t count_ = 0;
};

} // namespace obscura
